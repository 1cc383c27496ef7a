// The vocabulary at the bottom: frames, random streams, results.
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/core/frames.h"
#include "engine/core/hash.h"
#include "engine/core/random.h"
#include "engine/core/result.h"
#include "engine/core/time.h"

namespace palace {
namespace {

constexpr std::uint64_t kSeed = 7;

RigidTransform RandomTransform(RandomStream& random) {
  return {
      RotationFromEuler({random.Uniform(-3, 3), random.Uniform(-1.5, 1.5), random.Uniform(-3, 3)}),
      {random.Normal(), random.Normal(), random.Normal()}};
}

TEST(Frames, InverseUndoesAndCompositionChains) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  RandomStream random(kSeed);
  for (int i = 0; i < 200; ++i) {
    const RigidTransform X_AB = RandomTransform(random), X_BC = RandomTransform(random);
    const Eigen::Vector3d p_CQ(random.Normal(), random.Normal(), random.Normal());
    EXPECT_NEAR(((X_AB * X_BC) * p_CQ - X_AB * (X_BC * p_CQ)).norm(), 0, 1e-12);
    EXPECT_NEAR((X_AB.Inverse() * (X_AB * p_CQ) - p_CQ).norm(), 0, 1e-12);
  }
}

TEST(Frames, EulerAnglesComeBack) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  RandomStream random(kSeed);
  for (int i = 0; i < 200; ++i) {
    const EulerAngles given{random.Uniform(-3, 3), random.Uniform(-1.5, 1.5),
                            random.Uniform(-3, 3)};
    const EulerAngles back = EulerFromRotation(RotationFromEuler(given));
    EXPECT_NEAR(back.roll_rad, given.roll_rad, 1e-9);
    EXPECT_NEAR(back.pitch_rad, given.pitch_rad, 1e-9);
    EXPECT_NEAR(back.yaw_rad, given.yaw_rad, 1e-9);
  }
}

TEST(Frames, ATiltedCameraLooksDown) {
  struct Row {
    double tilt_deg;
    Eigen::Vector3d forward_B;  // of the optical axis
  };
  const double h = std::sqrt(0.5);
  for (const Row& row : {Row{0, {1, 0, 0}}, Row{-45, {h, 0, h}}, Row{-90, {0, 0, 1}}}) {
    const Eigen::Matrix3d R_BC = CameraRotationFromTilt(row.tilt_deg * std::numbers::pi / 180);
    EXPECT_NEAR((R_BC.col(2) - row.forward_B).norm(), 0, 1e-12) << row.tilt_deg << " deg";
    EXPECT_NEAR((R_BC.col(0) - Eigen::Vector3d::UnitY()).norm(), 0, 1e-12);  // right stays right
    EXPECT_NEAR(R_BC.determinant(), 1, 1e-12);
  }
}

TEST(Frames, WrappedAnglesLieInTheHalfOpenTurn) {
  for (const double angle :
       {0.0, 3.0, -3.0, 4.0, -4.0, 100.0, std::numbers::pi, -std::numbers::pi}) {
    const double wrapped = WrapAngle(angle);
    EXPECT_GT(wrapped, -std::numbers::pi);
    EXPECT_LE(wrapped, std::numbers::pi);
    EXPECT_NEAR(std::remainder(wrapped - angle, 2 * std::numbers::pi), 0, 1e-9);
  }
}

TEST(Random, StreamsRepeatAndAreApart) {
  RandomStream a(1, "gps"), b(1, "gps"), c(1, "imu"), d(2, "gps");
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t bits = a.NextBits();
    EXPECT_EQ(bits, b.NextBits());
    EXPECT_NE(bits, c.NextBits());
    EXPECT_NE(bits, d.NextBits());
  }
}

TEST(Random, NormalHasItsMoments) {
  RandomStream random(kSeed);
  double sum = 0, square = 0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.Normal();
    sum += x;
    square += x * x;
  }
  EXPECT_NEAR(sum / kCount, 0, 0.02);
  EXPECT_NEAR(square / kCount, 1, 0.02);
}

TEST(ResultDeathTest, TakingTheValueOfAnErrorIsABugOfOurs) {
  const Result<int> failed = InvalidError("no number");
  EXPECT_DEATH((void)failed.value(), "no number");
}

TEST(Time, SecondsAddBothWays) {
  const Timestamp t{1'000'000};
  EXPECT_EQ(AddSeconds(t, 0.25).us, 1'250'000);
  EXPECT_EQ(AddSeconds(t, -0.25).us, 750'000);
  EXPECT_DOUBLE_EQ(SecondsBetween(t, AddSeconds(t, 1.5)), 1.5);
}

// Stamps come from strangers: no difference or sum of them wraps (UBSan would tell).
TEST(Time, HostileStampsSaturate) {
  using Range = std::numeric_limits<std::int64_t>;
  const Timestamp least{Range::min()}, most{Range::max()};
  EXPECT_DOUBLE_EQ(SecondsBetween(least, most), 1e-6 * static_cast<double>(Range::max()));
  EXPECT_DOUBLE_EQ(SecondsBetween(most, least), 1e-6 * static_cast<double>(Range::min()));
  EXPECT_EQ(AddSeconds(most, 1), most);
  EXPECT_EQ(AddSeconds(least, -1), least);
  EXPECT_EQ(AddSeconds({5}, 1e300), most);
  EXPECT_EQ(AddSeconds({-5}, -1e300), least);
  EXPECT_EQ(AddSeconds({5}, NAN), Timestamp{5});
  EXPECT_EQ(Microseconds(-0.0000004), 0);
  EXPECT_EQ(Microseconds(-0.0000006), -1);
}

TEST(Hash, NamesContent) {
  ContentHash a, b, c;
  a.Add(std::string_view("site"));
  b.Add(std::string_view("site"));
  c.Add(std::string_view("sitf"));
  EXPECT_EQ(a.value(), b.value());
  EXPECT_NE(a.value(), c.value());
  EXPECT_EQ(ShortHash(0x4F2A9C0000000000ULL), "4f2a9c");
}

}  // namespace
}  // namespace palace
