#include "engine/navigation/position_filter.h"

#include <cstdio>
#include <deque>

#include <gtest/gtest.h>

#include "engine/navigation/attitude_history.h"
#include "tests/navigation/flight.h"

namespace palace {
namespace {

Timestamp At(double t) { return AddSeconds({}, t); }
const ProcessNoise kVisionNoise{};

FilterSeed SeedFrom(const Flight& flight, double t) {
  FilterSeed seed;
  seed.time = At(t);
  seed.p_WB = flight.Position(t);
  seed.v_WB = flight.Velocity(t);
  return seed;
}

PositionMeasurement Fix(const Eigen::Vector3d& p_WB, double t, double sigma) {
  PositionMeasurement fix;
  fix.time = At(t);
  fix.p_WB = p_WB;
  fix.p_covariance_m2 = sigma * sigma * Eigen::Matrix3d::Identity();
  return fix;
}

struct Outcome {
  double velocity_rms = 0;
  double position_rms = 0;
  double mean_nis = 0;
  int rejected = 0;
  int outliers = 0;
};

/// 100 Hz IMU with noise and bias, 10 Hz fixes of 8 cm, arriving `delay_s` late; `stamped` false
/// pretends they were taken when they arrived.
Outcome FlyFiltered(double delay_s, double outlier_share, bool stamped, std::uint64_t seed) {
  const Flight flight;
  RandomStream random(seed);
  const Eigen::Vector3d bias_B(0.05, -0.03, 0.04);
  PositionFilter filter;
  filter.Start(SeedFrom(flight, 0), kVisionNoise);
  std::deque<std::pair<double, PositionMeasurement>> waiting;
  Outcome outcome;
  double v2 = 0, p2 = 0, nis = 0;
  int samples = 0, fixes = 0;
  for (int k = 1; k <= 2400; ++k) {
    const double t = 0.01 * k;
    const double middle = t - 0.005;
    filter.AddImu(At(t), flight.SpecificForce(middle) + bias_B + NormalVector(random, 0.1),
                  flight.Attitude(middle));
    if (k % 10 == 0) {
      Eigen::Vector3d p_WB = flight.Position(t) + NormalVector(random, 0.08);
      if (random.Uniform() < outlier_share) {
        p_WB.x() += 2;
        ++outcome.outliers;
      }
      waiting.emplace_back(t + delay_s, Fix(p_WB, stamped ? t : t + delay_s, 0.08));
    }
    while (!waiting.empty() && waiting.front().first <= t + 1e-9) {
      const FixOutcome result = filter.AddFix(waiting.front().second);
      outcome.rejected += result == FixOutcome::kRejected ? 1 : 0;
      if (result == FixOutcome::kAccepted) {
        nis += filter.nis();
        ++fixes;
      }
      waiting.pop_front();
    }
    if (t > 5) {
      const FilterEstimate now = filter.EstimateAt(At(t));
      v2 += (now.v_WB - flight.Velocity(t)).squaredNorm() / 3;
      p2 += (now.p_WB - flight.Position(t)).squaredNorm() / 3;
      ++samples;
    }
  }
  outcome.velocity_rms = std::sqrt(v2 / samples);
  outcome.position_rms = std::sqrt(p2 / samples);
  outcome.mean_nis = nis / fixes;
  return outcome;
}

class Delay : public testing::TestWithParam<double> {};
TEST_P(Delay, IsCompensatedByTheStamp) {
  const Outcome good = FlyFiltered(GetParam(), 0, true, 1);
  std::printf("[ measured ] delay %.1f s: velocity %.3f m/s rms, position %.3f m rms, NIS %.2f\n",
              GetParam(), good.velocity_rms, good.position_rms, good.mean_nis);
  EXPECT_LT(good.velocity_rms, 0.05);
  EXPECT_LT(good.position_rms, 0.05);
  EXPECT_GT(good.mean_nis, 2.0);
  EXPECT_LT(good.mean_nis, 4.0);
  if (GetParam() >= 0.2) {
    const Outcome naive = FlyFiltered(GetParam(), 0, false, 1);
    EXPECT_GT(naive.velocity_rms, 1.5 * good.velocity_rms);
  }
}
INSTANTIATE_TEST_SUITE_P(Seconds, Delay, testing::Values(0.0, 0.1, 0.2, 0.3));

TEST(PositionFilter, OutliersAreGated) {
  const Outcome outcome = FlyFiltered(0.1, 0.1, true, 3);
  ASSERT_GT(outcome.outliers, 10);
  EXPECT_GE(outcome.rejected, outcome.outliers);
  EXPECT_LE(outcome.rejected, outcome.outliers + 5);
  EXPECT_LT(outcome.velocity_rms, 0.05);
}

TEST(PositionFilter, CountsRejectionsInARow) {
  const Flight flight;
  PositionFilter filter;
  filter.Start(SeedFrom(flight, 0), kVisionNoise);
  filter.AddImu(At(0.01), flight.SpecificForce(0), flight.Attitude(0));
  ASSERT_EQ(filter.AddFix(Fix(flight.Position(0.01), 0.01, 0.05)), FixOutcome::kAccepted);
  for (int i = 1; i <= 4; ++i) {
    const Eigen::Vector3d wrong = flight.Position(0.01) + Eigen::Vector3d(9, 0, 0);
    EXPECT_EQ(filter.AddFix(Fix(wrong, 0.01, 0.05)), FixOutcome::kRejected);
    EXPECT_EQ(filter.rejected_in_row(), i);
    EXPECT_GT(filter.residual_sigma(), 2);
  }
  EXPECT_EQ(filter.AddFix(Fix({NAN, 0, 0}, 0.01, 0.05)), FixOutcome::kRejected);
  filter.AddFix(Fix(flight.Position(0.01), 0.01, 0.05));
  EXPECT_EQ(filter.rejected_in_row(), 0);
}

// Inside the window the order of arrival does not matter.
TEST(PositionFilter, ArrivalOrderDoesNotMatter) {
  const Flight flight;
  RandomStream random(8);
  PositionFilter in_order;
  PositionFilter late;
  in_order.Start(SeedFrom(flight, 0), kVisionNoise);
  late.Start(SeedFrom(flight, 0), kVisionNoise);
  std::vector<PositionMeasurement> fixes;
  for (int k = 1; k <= 100; ++k) {
    const double t = 0.01 * k;
    const Eigen::Vector3d force = flight.SpecificForce(t);
    in_order.AddImu(At(t), force, flight.Attitude(t));
    late.AddImu(At(t), force, flight.Attitude(t));
    if (k % 15 == 0) {  // between two IMU samples
      fixes.push_back(
          Fix(flight.Position(t - 0.004) + NormalVector(random, 0.05), t - 0.004, 0.05));
      ASSERT_EQ(in_order.AddFix(fixes.back()), FixOutcome::kAccepted);
    }
  }
  for (const std::size_t i : {3U, 0U, 5U, 1U, 4U, 2U}) {
    ASSERT_EQ(late.AddFix(fixes[i]), FixOutcome::kAccepted) << i;
  }
  const FilterEstimate a = in_order.EstimateAt(At(1.0));
  const FilterEstimate b = late.EstimateAt(At(1.0));
  EXPECT_LT((a.p_WB - b.p_WB).norm(), 1e-9);
  EXPECT_LT((a.v_WB - b.v_WB).norm(), 1e-9);
  EXPECT_LT((a.sigma_p_m - b.sigma_p_m).norm(), 1e-9);
}

TEST(PositionFilter, RefusesWhatIsOlderThanItsMemory) {
  const Flight flight;
  PositionFilter filter;
  filter.Start(SeedFrom(flight, 0), kVisionNoise);
  for (int k = 1; k <= 300; ++k) {
    filter.AddImu(At(0.01 * k), flight.SpecificForce(0.01 * k), flight.Attitude(0.01 * k));
  }
  EXPECT_EQ(filter.AddFix(Fix(flight.Position(1.0), 1.0, 0.1)), FixOutcome::kTooOld);
  EXPECT_EQ(filter.AddFix(Fix(flight.Position(2.0), 2.0, 5.0)), FixOutcome::kAccepted);
}

TEST(PositionFilter, CoastsWithoutAnyImu) {
  PositionFilter filter;
  FilterSeed seed;
  seed.v_WB = {1, 0, 0};
  filter.Start(seed, kVisionNoise);
  for (int i = 1; i <= 50; ++i) {
    ASSERT_EQ(filter.AddFix(Fix({0.1 * i, 0, 0}, 0.1 * i, 0.05)), FixOutcome::kAccepted) << i;
  }
  const FilterEstimate ahead = filter.EstimateAt(At(5.5));
  EXPECT_NEAR(ahead.p_WB.x(), 5.5, 0.05);
  EXPECT_GT(ahead.sigma_p_m.x(), filter.EstimateAt(At(5.0)).sigma_p_m.x());
}

TEST(AttitudeHistory, InterpolatesAndTurnsOn) {
  const Flight flight;
  AttitudeHistory history;
  EXPECT_FALSE(history.At(At(0)));
  for (int i = 0; i <= 40; ++i) {
    history.Add(flight.Pose(0.05 * i));
  }
  for (const double t : {0.012, 0.5, 1.033, 1.999, 2.02}) {
    const auto pose = history.At(At(t));
    ASSERT_TRUE(pose);
    EXPECT_LT((pose->X_WB.R - flight.Attitude(t)).norm(), 1e-3) << t;
    EXPECT_LT((pose->X_WB.p - flight.Position(t)).norm(), 1e-3) << t;
  }
  VehiclePose bad = flight.Pose(2.1);
  bad.X_WB.p.x() = NAN;
  history.Add(bad);
  EXPECT_EQ(history.newest().time, At(2.0));
}

}  // namespace
}  // namespace palace
