// A GL context for one test, or a skip that says why there is none.
#pragma once

#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "gui/platform/egl_context.h"

namespace palace {

class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Result<std::unique_ptr<EglContext>> opened = EglContext::Open();
    if (!opened) {
      GTEST_SKIP() << opened.error().message;
    }
    context_ = std::move(opened).value();
    ASSERT_TRUE(context_->MakeCurrent().ok());
  }

 private:
  std::unique_ptr<EglContext> context_;
};

}  // namespace palace
