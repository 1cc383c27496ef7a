// The program that shows a report is one of its own: signals reach it, and it leaves no dead entry.
#include "gui/platform/open_file.h"

#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

/// An xdg-open that writes into the file it is given how it was started.
class OpenFileTest : public ::testing::Test {
 protected:
  OpenFileTest() : folder_(OwnPath()), path_(std::getenv("PATH")) {
    fs::create_directories(folder_);
    const fs::path program = folder_ / "xdg-open";
    std::ofstream(program) << "#!/bin/sh\ngrep ^Sig /proc/self/status > \"$1.part\"\n"
                              "mv \"$1.part\" \"$1\"\n";
    chmod(program.c_str(), 0700);
    setenv("PATH", (folder_.string() + ":" + path_).c_str(), 1);
  }
  ~OpenFileTest() override {
    setenv("PATH", path_.c_str(), 1);
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path folder_;
  std::string path_;
};

TEST_F(OpenFileTest, ObeysSignalsAndIsReaped) {
  sigset_t held, before;
  sigemptyset(&held);
  sigaddset(&held, SIGTERM);
  sigaddset(&held, SIGINT);
  pthread_sigmask(SIG_BLOCK, &held, &before);  // as the station does
  const fs::path seen = folder_ / "seen";
  const Status opened = OpenFile(seen.string());
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ASSERT_TRUE(opened) << opened.error().message;
  while (!fs::exists(seen)) {
    sched_yield();
  }
  std::ifstream file(seen);
  int masks = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("SigBlk:", 0) == 0 || line.rfind("SigIgn:", 0) == 0) {
      ++masks;
      const std::uint64_t mask = std::stoull(line.substr(7), nullptr, 16);
      for (const int number : {SIGINT, SIGTERM}) {
        EXPECT_EQ(mask >> (number - 1) & 1, 0u) << line << ", signal " << number;
      }
    }
  }
  EXPECT_EQ(masks, 2);
  // Somebody waits for it: in the end this program has no child left.
  while (waitid(P_ALL, 0, nullptr, WEXITED | WNOWAIT | WNOHANG) == 0) {
    sched_yield();
  }
  EXPECT_EQ(errno, ECHILD);
}

}  // namespace
}  // namespace palace
