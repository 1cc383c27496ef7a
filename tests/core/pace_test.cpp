// Pace: turns of 0.1 s of source time, each worked on for as long as a list says.
#include "engine/core/pace.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace palace {
namespace {

constexpr double kStep_s = 0.1;

/// When each turn begins, if the one before took so long; waits are exact.
std::vector<double> Begun(Pace& pace, const std::vector<double>& work_s, double speed,
                          double now_s = 100) {
  std::vector<double> begun;
  for (const double work : work_s) {
    const double due_s = pace.DueAt(now_s, kStep_s, speed);
    now_s = std::max(now_s, due_s);
    pace.Begin(now_s, due_s, kStep_s);
    begun.push_back(now_s - 100);
    now_s += work;
  }
  return begun;
}

std::vector<double> Repeated(std::vector<double> pattern, int times) {
  std::vector<double> all;
  for (int i = 0; i < times; ++i) {
    all.insert(all.end(), pattern.begin(), pattern.end());
  }
  return all;
}

TEST(Pace, QuickTurnsComeOnTheBeat) {
  Pace pace;
  const std::vector<double> begun = Begun(pace, Repeated({0.02}, 50), 1);
  EXPECT_NEAR(begun.back(), 49 * kStep_s, 1e-9);
  EXPECT_NEAR(pace.reached().value(), 1, 1e-6);
}

TEST(Pace, SlowTurnsAreCaughtUpOnByQuickOnes) {
  Pace pace;
  const std::vector<double> begun = Begun(pace, Repeated({0.15, 0.03}, 50), 1);
  // The mean turn takes 0.09 s, less than its step: no time is lost.
  EXPECT_NEAR(begun.back(), 99 * kStep_s + 0.05, 1e-9);
  EXPECT_NEAR(pace.reached().value(), 1, 0.05);
}

TEST(Pace, TurnsThatAllTakeLongerTellTheSpeedThatIsReached) {
  Pace pace;
  Begun(pace, Repeated({0.15, 0.25}, 100), 1);
  EXPECT_NEAR(pace.reached().value(), 0.5, 0.02);
}

TEST(Pace, AfterALongStopNoMoreThanHalfASecondIsCaughtUpOn) {
  Pace pace;
  std::vector<double> work(12, 0.0);
  work[0] = 5;
  const std::vector<double> begun = Begun(pace, work, 1);
  EXPECT_NEAR(begun[6], 5, 1e-9) << "five turns at once, and the one that was due";
  EXPECT_NEAR(begun[7], 5.1, 1e-9);
  EXPECT_NEAR(begun[11], 5.5, 1e-9);
}

TEST(Pace, AnotherSpeedOwesNothing) {
  Pace pace;
  Begun(pace, Repeated({0.2}, 20), 5);  // cannot be reached
  EXPECT_NEAR(pace.reached().value(), 0.5, 0.01);
  pace.Restart();
  EXPECT_FALSE(pace.reached().has_value());
  const std::vector<double> begun = Begun(pace, {0.0, 0.0, 0.0}, 1, 103.9);
  EXPECT_NEAR(begun[1] - begun[0], kStep_s, 1e-9);
  EXPECT_NEAR(begun[2] - begun[1], kStep_s, 1e-9);
}

TEST(Pace, WhatIsPausedIsNoSlowness) {
  Pace pace;
  Begun(pace, Repeated({0.0}, 10), 1);
  pace.Pause();
  const std::vector<double> begun = Begun(pace, Repeated({0.0}, 3), 1, 160);
  EXPECT_NEAR(begun[0], 60, 1e-9);
  EXPECT_NEAR(begun[1], 60.1, 1e-9);
  EXPECT_NEAR(pace.reached().value(), 1, 1e-6);
}

TEST(Pace, WithoutASpeedEachTurnIsDueAtOnce) {
  Pace pace;
  const std::vector<double> begun = Begun(pace, Repeated({0.01}, 4), 0);
  EXPECT_NEAR(begun.back(), 0.03, 1e-9);
  EXPECT_NEAR(pace.reached().value(), 10, 1e-6);
}

}  // namespace
}  // namespace palace
