// config/setup.sh: when warnings stop a build, and what ./test says of skipped tests. A stand-in
// for cmake writes down how it was called; nothing is built.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"
#include "tests/support/process.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

class SetupScript : public testing::Test {
 protected:
  SetupScript() {
    folder_ = OwnPath();
    fs::create_directories(folder_ / "bin");
    Write("bin/cmake",
          "#!/bin/sh\n"
          "echo \"$*\" >>calls\n"
          "case \"$1\" in --preset)\n"
          "  touch \"build/$2/build.ninja\"\n"
          "  echo \"${3#-D}\" | sed 's/=/:BOOL=/' >\"build/$2/CMakeCache.txt\"\n"
          "esac\n");
    fs::permissions(folder_ / "bin/cmake", fs::perms::owner_all);
  }
  ~SetupScript() override { fs::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  /// Runs lines of shell after the script was read; CI as given, "" unset.
  ProcessResult Run(const std::string& lines, const std::string& ci) const {
    ProcessOptions options;
    options.command = {"bash", "-euo", "pipefail", "-c",
                       ". " PALACE_SOURCE_DIR "/config/setup.sh\n" + lines};
    options.environment = {{"PATH", (folder_ / "bin").string() + ":" + std::getenv("PATH")}};
    if (ci.empty()) {
      options.without = {"CI"};
    } else {
      options.environment.push_back({"CI", ci});
    }
    options.folder = folder_;
    return RunProcess(options, 20);
  }
  std::string Calls() const {
    std::ostringstream text;
    text << std::ifstream(folder_ / "calls").rdbuf();
    return text.str();
  }

  fs::path folder_;
};

TEST_F(SetupScript, AUsersBuildDoesNotStopAtWarnings) {
  for (const char* ci : {"", "false", "0"}) {
    fs::remove(folder_ / "calls");
    fs::remove_all(folder_ / "build");
    const ProcessResult built = Run("build release palace; build release palace", ci);
    ASSERT_EQ(built.exit_code, 0) << built.err;
    EXPECT_EQ(Calls(),
              "--preset release\n"
              "--build --preset release --target palace\n"
              "--build --preset release --target palace\n");
  }
}

TEST_F(SetupScript, ContinuousIntegrationStopsAtWarningsInAnOlderBuildToo) {
  ASSERT_EQ(Run("build release", "").exit_code, 0);
  fs::remove(folder_ / "calls");
  const ProcessResult built = Run("build release; build release", "true");
  ASSERT_EQ(built.exit_code, 0) << built.err;
  EXPECT_EQ(Calls(),
            "--preset release -DPALACE_WARNINGS_AS_ERRORS=ON\n"
            "--build --preset release\n"
            "--build --preset release\n");
}

TEST_F(SetupScript, AFailedBuildEndsTheScript) {
  Write("bin/cmake", "#!/bin/sh\necho 'x.cpp:1: error: no'\nexit 1\n");
  fs::create_directories(folder_ / "build/release");
  Write("build/release/build.ninja", "");
  const ProcessResult built = Run("build release\necho 'went on'", "");
  EXPECT_EQ(built.exit_code, 1);
  EXPECT_EQ(built.out, "");
  EXPECT_NE(built.err.find("x.cpp:1: error: no"), std::string::npos) << built.err;
}

constexpr char kLogOfTests[] =
    "Start testing: Nov 22 17:00 UTC\n"
    "----------------------------------------------------------\n"
    "1/4 Testing: camera/CameraFiles.RealFilesParse\n"
    "1/4 Test: camera/CameraFiles.RealFilesParse\n"
    "Output:\n"
    "[ RUN      ] CameraFiles.RealFilesParse\n"
    "tests/camera/camera_files_test.cpp:250: Skipped\n"
    "runs with reference data in /home/me/shared/data/mrcal_reference\n"
    "\n"
    "2/4 Testing: stereo/Aloe.Beats\n"
    "tests/stereo/aloe_test.cpp:180: Skipped\n"
    "runs with reference data in /home/me/shared/data/opencv_aloe\n"
    "tests/stereo/aloe_test.cpp:181: Skipped\n"
    "runs with reference data in /home/me/shared/data/opencv_aloe\n"
    "3/4 Testing: capture/CameraAddress.Unreadable\n"
    "tests/capture/camera_address_test.cpp:89: Skipped\n"
    "root may read everything\n"
    "4/4 Testing: core/Passes\n"
    "[       OK ] Passes\n";

TEST_F(SetupScript, SkippedTestsAreSaidOnceAtTheEnd) {
  Write("LastTest.log", kLogOfTests);
  const ProcessResult said = Run("say_skipped LastTest.log", "");
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_EQ(said.err,
            "palace: skipped capture/CameraAddress.Unreadable: root may read everything\n"
            "palace: skipped 2 tests for want of reference data, which would lie in "
            "/home/me/shared/data\n");
  Write("LastTest.log", "1/1 Testing: core/Passes\n[       OK ] Passes\n");
  EXPECT_EQ(Run("say_skipped LastTest.log", "").err, "");
}

TEST_F(SetupScript, SkippedTestsAreSaidBeforeAFailureEndsTheScript) {
  Write("bin/ctest",
        "#!/bin/sh\n"
        "mkdir -p build/release/Testing/Temporary\n"
        "cp LastTest.log build/release/Testing/Temporary/\n"
        "exit 8\n");
  fs::permissions(folder_ / "bin/ctest", fs::perms::owner_all);
  Write("LastTest.log", kLogOfTests);
  const ProcessResult ran = Run("run_tests release\necho 'went on'", "");
  EXPECT_EQ(ran.exit_code, 8);
  EXPECT_EQ(ran.out, "");
  EXPECT_NE(ran.err.find("skipped 2 tests"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace palace
