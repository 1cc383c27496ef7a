// A GL context for one test. Where there should be one, its absence is a failure, else a skip.
#pragma once

#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "gui/platform/egl_context.h"
#include "tests/support/expected.h"

namespace palace {

class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Result<std::unique_ptr<EglContext>> opened = EglContext::Open();
    PALACE_REQUIRE_GL(opened);
    context_ = std::move(opened).value();
    ASSERT_TRUE(context_->MakeCurrent().ok());
  }

 private:
  std::unique_ptr<EglContext> context_;
};

}  // namespace palace
