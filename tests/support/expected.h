// What this machine must be able to do, so that a test which cannot run there is a failure and no
// skip: ./test installs drivers and fonts, and under CI everything that it installs is there.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace palace {

/// As config/setup.sh reads the variable.
inline bool InCi() {
  const char* ci = std::getenv("CI");
  const std::string word = ci == nullptr ? "" : ci;
  return !(word.empty() || word == "0" || word == "false" || word == "no");
}

/// OpenGL without a window: where a vendor of EGL has registered itself.
inline bool GlIsExpected() {
  std::error_code none;
  const char* folder = std::getenv("__EGL_VENDOR_LIBRARY_DIRS");
  for (const auto& entry : std::filesystem::directory_iterator(
           folder == nullptr ? "/usr/share/glvnd/egl_vendor.d" : folder, none)) {
    if (entry.path().extension() == ".json") {
      return true;
    }
  }
  return InCi();
}

/// The faces of the screen: where both packages have put theirs.
inline bool FontsAreExpected() {
  return InCi() || (std::filesystem::exists("/usr/share/fonts/truetype/roboto") &&
                    std::filesystem::exists("/usr/share/fonts/truetype/jetbrains-mono"));
}

}  // namespace palace

/// For a test, or its SetUp, that needs OpenGL: `opened` is the Result of opening it.
#define PALACE_REQUIRE_GL(opened)                                                \
  if (!(opened).ok()) {                                                          \
    ASSERT_FALSE(palace::GlIsExpected()) << (opened).error().message;            \
    GTEST_SKIP() << (opened).error().message << "; runs where EGL has a driver"; \
  }                                                                              \
  static_assert(true)
