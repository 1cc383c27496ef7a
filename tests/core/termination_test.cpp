// Signals as wishes: taken in order, told once, and the second one does not wait.
#include "engine/core/termination.h"

#include <sys/sysinfo.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <latch>
#include <thread>

#include <gtest/gtest.h>

#include "engine/core/address_space.h"

namespace palace {
namespace {

/// Runs `body` in a child, alone with its signals. Its exit code, or minus the signal that killed
/// it.
template <typename Body>
int InChild(Body&& body) {
  const pid_t child = fork();
  if (child == 0) {
    _exit(body());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(Termination, EachSignalAsksAndNothingDies) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    SCOPED_TRACE(number);
    EXPECT_EQ(InChild([&] {
                std::signal(number, SIG_DFL);  // nohup has SIGHUP ignored
                std::latch asked(1);
                const Termination termination([&] { asked.count_down(); });
                kill(getpid(), number);
                asked.wait();
                return termination.signal() == number ? termination.exit_code() : 1;
              }),
              128 + number);
  }
}

TEST(Termination, TheSecondSignalEndsAtOnce) {
  EXPECT_EQ(InChild([] {
              std::signal(SIGINT, SIG_DFL);  // a job in the background has it ignored
              std::latch asked(1);
              const Termination termination([&] { asked.count_down(); });
              kill(getpid(), SIGTERM);
              asked.wait();
              kill(getpid(), SIGINT);
              while (true) {
                pause();
              }
              return 0;
            }),
            128 + SIGINT);
}

TEST(Termination, WhatIsIgnoredStaysIgnored) {
  EXPECT_EQ(InChild([] {
              signal(SIGHUP, SIG_IGN);
              std::latch asked(1);
              const Termination termination([&] { asked.count_down(); });
              kill(getpid(), SIGHUP);
              kill(getpid(), SIGTERM);
              asked.wait();
              return termination.signal() == SIGTERM ? 7 : 1;
            }),
            7);
}

TEST(Termination, AfterwardsASignalKillsAsBefore) {
  EXPECT_EQ(InChild([] {
              { const Termination termination; }
              kill(getpid(), SIGTERM);
              return 0;
            }),
            -SIGTERM);
}

TEST(AddressSpace, MoreThanThereIsIsRefusedWithTheRemedy) {
  EXPECT_TRUE(EnoughMemory(1));
  const Status refused = EnoughMemory(std::size_t{1} << 40);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("ulimit -v"), std::string::npos);
  // The kernel would promise more than the machine has, and kill for it later.
  struct sysinfo machine {};
  ASSERT_EQ(sysinfo(&machine), 0);
  const std::size_t there_MiB =
      (std::size_t{machine.totalram} + machine.totalswap) * machine.mem_unit >> 20;
  const Status promised = EnoughMemory(there_MiB + 1024);
  ASSERT_FALSE(promised);
  EXPECT_NE(promised.error().message.find("out of memory"), std::string::npos);
}

}  // namespace
}  // namespace palace
