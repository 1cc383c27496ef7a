// The path keeps the site at the image centre, has one nearest point, and is timed by its speeds.
// That the built-in vehicle flies these times is shown in tests/simulation.
#include "engine/flight/flight_path.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"

namespace palace {
namespace {

const Eigen::Vector3d kSkids(0.1, 0, 0.9);  // in B
const FlightPath kPath{{12, -3, 0.4}, Rad(30), Rad(45), {0.9, 0, 0.3}, kSkids, {.settle_s = 3.8}};

FlightPath RandomPath(RandomStream& random) {
  FlightPath path;
  path.p_WS = {random.Uniform(-20, 20), random.Uniform(-20, 20), random.Uniform(-2, 2)};
  path.heading_rad = random.Uniform(-3, 3);
  path.slope_rad = random.Uniform(Rad(25), Rad(90));
  path.p_BC = {0.8, -0.5, 0.3};
  path.skid_centre_B = kSkids;
  path.speeds.sink_mps = random.Uniform(0.2, 1.5);
  return path;
}

TEST(FlightPath, SiteStaysAtTheImageCentreDownTheSlope) {
  RandomStream random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const FlightPath path = RandomPath(random);
    const double height = random.Uniform(kSettleHeight_m, 20);
    const RigidTransform X_WB{path.LevelRotation(), path.BodyAt(height)};
    const RigidTransform X_BC{CameraRotationFromTilt(-path.slope_rad), path.p_BC};
    const Eigen::Vector3d p_CS = (X_WB * X_BC).Inverse() * path.p_WS;
    EXPECT_GT(p_CS.z(), 0);
    EXPECT_NEAR(p_CS.x() / p_CS.z(), 0, 1e-9) << "trial " << trial;
    EXPECT_NEAR(p_CS.y() / p_CS.z(), 0, 1e-9) << "trial " << trial;
    EXPECT_NEAR(path.SkidHeight(X_WB.p), height, 1e-9);
    EXPECT_TRUE(path.Start(X_WB.p).isApprox(X_WB.p, 1e-9));
  }
}

TEST(FlightPath, AboveSiteMeansSkidsAboveSite) {
  FlightPath path;
  path.p_WS = {3, 4, -1};
  path.heading_rad = 1.1;
  path.skid_centre_B = kSkids;
  path.slope_rad = Rad(45);
  const RigidTransform X_WB{path.LevelRotation(), path.BodyAboveSite(2)};
  EXPECT_TRUE((X_WB * kSkids).isApprox(Eigen::Vector3d(3, 4, -3), 1e-12));
}

TEST(FlightPath, DistanceOffItIsFromTheWholePath) {
  const Eigen::Vector3d right = kPath.LevelRotation().col(1);
  const Eigen::Vector3d halfway =
      (kPath.BodyAt(kSettleHeight_m) + kPath.BodyAboveSite(kSettleHeight_m)) / 2;
  const struct {
    const char* where;
    PathLeg leg;
    Eigen::Vector3d p_WB;
    double height_m;
  } rows[] = {{"high on the slope", PathLeg::kSlope, kPath.BodyAt(20), 20},
              {"low on the slope", PathLeg::kSlope, kPath.BodyAt(5), 5},
              {"level leg", PathLeg::kLevel, halfway, kSettleHeight_m},
              {"sinking", PathLeg::kSink, kPath.BodyAboveSite(0.7), 0.7}};
  for (const auto& row : rows) {
    SCOPED_TRACE(row.where);
    const PathPoint on = kPath.Nearest(row.p_WB);
    EXPECT_EQ(on.leg, row.leg);
    EXPECT_NEAR((on.p_WB - row.p_WB).norm(), 0, 1e-9);
    EXPECT_NEAR(on.skid_height_m, row.height_m, 1e-9);
    const PathProgress off = ProgressOn(kPath, row.p_WB + 0.6 * right, Eigen::Vector3d::Zero());
    EXPECT_NEAR(off.off_path_m, 0.6, 1e-9);
    EXPECT_NEAR(off.plan_height_m, row.height_m, 1e-9);
  }
}

TEST(FlightPath, ThePlanAheadGoesDownFromHereToTheTouchdown) {
  RandomStream random(5);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE("seed 5 trial " + std::to_string(trial));
    const FlightPath path = RandomPath(random);
    const double from_m = random.Uniform(0.2, 15);
    const Eigen::Vector3d p_WB =
        from_m < kSettleHeight_m ? path.BodyAboveSite(from_m) : path.BodyAt(from_m);
    const PathProgress progress = ProgressOn(path, p_WB, Eigen::Vector3d::Zero());
    ASSERT_FALSE(progress.ahead.empty());
    EXPECT_NEAR(progress.ahead.front().height_m, from_m, 1e-6);
    EXPECT_EQ(progress.ahead.front().in_s, 0);
    for (std::size_t i = 1; i < progress.ahead.size(); ++i) {
      const PathProgress::Height &before = progress.ahead[i - 1], &now = progress.ahead[i];
      const double rate_mps = (before.height_m - now.height_m) / (now.in_s - before.in_s);
      EXPECT_GE(rate_mps, -1e-9);
      EXPECT_LE(rate_mps, std::max(path.speeds.sink_mps, path.speeds.touch_mps) + 1e-9);
    }
    const double left_s = TimeToTouchdown(path, p_WB, Eigen::Vector3d::Zero());
    EXPECT_TRUE(left_s > 60 || std::abs(progress.ahead.back().in_s - left_s) <= 0.5) << left_s;
  }
}

TEST(FlightPath, ASlowerDescentTakesLongerByItsSlope) {
  FlightPath slow = kPath, fast = kPath;
  slow.speeds.sink_mps = 0.5;
  fast.speeds.sink_mps = 1.0;
  const auto time = [](const FlightPath& path) {
    return TimeToTouchdown(path, path.BodyAt(24), Eigen::Vector3d::Zero());
  };
  // 20 m at half a metre a second more slowly; below 4 m both are equally slow.
  EXPECT_NEAR(time(slow) - time(fast), 20, 2);
}

// A look flies the same slope and ends on it: it is brought to rest there, not flown through.
TEST(FlightPath, ALookEndsInAHoverOnTheSlope) {
  Approval approval;
  approval.p_WS = kPath.p_WS;
  approval.approach_heading_rad = kPath.heading_rad;
  approval.glide_slope_rad = kPath.slope_rad;
  approval.descent_rate_mps = 1;
  const PathVehicle vehicle{kPath.p_BC, kSkids, 3.8};
  EXPECT_FALSE(PathOf(approval, vehicle).IsLook());
  approval.stop_height_m = 9;
  const FlightPath look = PathOf(approval, vehicle);
  ASSERT_TRUE(look.IsLook());
  EXPECT_TRUE(look.BodyAt(9).isApprox(kPath.BodyAt(9), 1e-9));
  const Eigen::Vector3d still = Eigen::Vector3d::Zero();
  const PathProgress progress = ProgressOn(look, look.BodyAt(20), still);
  EXPECT_GE(progress.ahead.back().height_m, 9);
  // 11 m at 1 m/s, to which it gathers speed and from which it brakes at 0.3 m/s2: 1.7 s each.
  const double left_s = TimeToTouchdown(look, look.BodyAt(20), still);
  EXPECT_NEAR(left_s, 11 + 1.7 + 1.7, 1.5);
  EXPECT_LT(left_s + 9, TimeToTouchdown(kPath, kPath.BodyAt(20), still));
  EXPECT_EQ(look.speeds.SinkRateAt(9), 0.1);
  EXPECT_EQ(look.speeds.SinkRateAt(19), 1);
}

TEST(FlightPath, TimeIsUnknownWhereTheVehicleIs) {
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Constant(NAN);
  EXPECT_TRUE(std::isnan(TimeToTouchdown(kPath, nowhere, Eigen::Vector3d::Zero())));
  EXPECT_TRUE(std::isnan(TimeToTouchdown(kPath, kPath.BodyAt(9), nowhere)));
  EXPECT_TRUE(std::isnan(TimeToAlign(kPath, nowhere, 0)));
  EXPECT_TRUE(std::isnan(TimeToAlign(kPath, kPath.BodyAt(9), NAN)));
}

TEST(StraightHeading, IsTheCourseFromTheSkidsToTheSite) {
  EXPECT_NEAR(StraightHeading({0, 0, -20}, {10, 0, 1}), 0, 1e-12);
  EXPECT_NEAR(StraightHeading({0, 0, -20}, {0, 10, 1}), Rad(90), 1e-12);
  EXPECT_NEAR(StraightHeading({3, 3, -20}, {2, 2, 1}), Rad(-135), 1e-12);
}

}  // namespace
}  // namespace palace
