#include "engine/navigation/handover.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

using State = Handover::State;
Timestamp At(double t) { return AddSeconds({}, t); }

/// Good fixes at 10 Hz over [from, to].
void Settle(Handover& handover, double from, double to, double nis = 2.5, double gap_mps = 0.05,
            double factor = 1) {
  for (int i = 0; from + 0.1 * i <= to + 1e-9; ++i) {
    handover.AddFix({At(from + 0.1 * i), true, nis, gap_mps, factor});
    handover.Advance(At(from + 0.1 * i));
  }
}

TEST(Handover, WaitsTwoSecondsThenForPermission) {
  Handover handover;
  EXPECT_EQ(handover.state(), State::kGps);
  handover.Start(At(10));
  EXPECT_EQ(handover.state(), State::kSettling);
  EXPECT_EQ(handover.reason(), "waiting for the first vision position");
  Settle(handover, 10.1, 11.9);
  EXPECT_EQ(handover.state(), State::kSettling);
  EXPECT_EQ(handover.reason(), "vision settling, 1.8 of 2.0 s");
  Settle(handover, 12.0, 12.1);
  EXPECT_EQ(handover.state(), State::kReady);
  handover.Allow(true);
  EXPECT_TRUE(handover.Advance(At(12.15)));
  EXPECT_EQ(handover.state(), State::kVision);
  EXPECT_FALSE(handover.Advance(At(12.2)));
  handover.Stop();
  EXPECT_EQ(handover.state(), State::kGps);
}

struct Obstacle {
  const char* name;
  double nis;
  double gap_mps;
  double factor;
  const char* reason;
};
class Blocks : public testing::TestWithParam<Obstacle> {};
TEST_P(Blocks, TheSwitch) {
  Handover handover;
  handover.Allow(true);
  handover.Start(At(0));
  Settle(handover, 0.1, 4, GetParam().nis, GetParam().gap_mps, GetParam().factor);
  EXPECT_EQ(handover.state(), State::kSettling);
  EXPECT_NE(handover.reason().find(GetParam().reason), std::string::npos) << handover.reason();
}
INSTANTIATE_TEST_SUITE_P(
    Obstacles, Blocks,
    testing::Values(Obstacle{"Residuals", 9, 0, 1, "residuals too large"},
                    Obstacle{"Scatter", 3, 0, 36, "scatters 6.0 times as stated, limit 5.0"},
                    Obstacle{"Velocity", 3, 0.4, 1, "velocity differ by 0.40"}),
    [](const auto& row) { return row.param.name; });

TEST(Handover, AGapStartsTheSettlingAnew) {
  Handover handover;
  handover.Start(At(0));
  Settle(handover, 0.1, 1.5);
  Settle(handover, 2.2, 3.5);
  EXPECT_EQ(handover.state(), State::kSettling);
  Settle(handover, 3.6, 4.3);
  EXPECT_EQ(handover.state(), State::kReady);
  handover.Advance(At(5.0));
  EXPECT_EQ(handover.state(), State::kSettling);
  EXPECT_EQ(handover.reason(), "no vision position for 0.7 s");
}

TEST(Handover, IsUnhealthyAfterSilenceOrRejections) {
  Handover handover;
  handover.Allow(true);
  handover.Start(At(0));
  EXPECT_FALSE(handover.Healthy(At(0)));
  Settle(handover, 0.1, 2.2);
  ASSERT_EQ(handover.state(), State::kVision);
  EXPECT_TRUE(handover.Healthy(At(2.6)));
  EXPECT_FALSE(handover.Healthy(At(2.8)));
  handover.AddFix({At(2.8), true, 3, 0});
  EXPECT_TRUE(handover.Healthy(At(2.8)));
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(handover.Healthy(At(2.8)));
    handover.AddFix({At(2.8), false, 40, 0});
  }
  EXPECT_FALSE(handover.Healthy(At(2.8)));
  handover.Advance(At(2.8));
  EXPECT_EQ(handover.state(), State::kVision) << "lost is not handed back";
  EXPECT_EQ(handover.reason(), "vision rejected 5 times in a row");
}

}  // namespace
}  // namespace palace
