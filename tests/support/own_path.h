// A path of its own for each test: tests of one program run side by side.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace palace {

/// In the folder for temporary files, named after the running test and its process; not made.
inline std::filesystem::path OwnPath(const std::string& ending = {}) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  std::replace(name.begin(), name.end(), '/', '_');
  return std::filesystem::path(::testing::TempDir()) /
         (name + "." + std::to_string(::getpid()) + ending);
}

}  // namespace palace
