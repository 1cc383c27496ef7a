// The watch over the station's estimates: noise and good flight pass, what moves away does not.
#include "engine/flight/estimate_watch.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr double kControl_s = 0.02;

/// A descent of `seconds` at 1.4 m/s; estimates ten times a second, 0.1 s old. `astray`: what the
/// estimates add to the truth at a time. Returns when the watch spoke, NaN: never.
struct Flown {
  double spoke_s = NAN;
  double astray_m = 0;  ///< of the newest estimate then
  std::string words;
};
template <typename Astray>
Flown Fly(std::uint64_t seed, double seconds, const Astray& astray) {
  RandomStream random(seed, "watch");
  const auto noise = [&](double sigma) {
    const double x = random.Normal(), y = random.Normal(), z = random.Normal();
    return Vector3d(sigma * x, sigma * y, sigma * z);
  };
  EstimateWatch watch;
  EXPECT_EQ(watch.Begin(Vector3d::Zero(), Vector3d::Zero()), "");
  const Vector3d v_W(1, 0, 1);
  Vector3d v_error = Vector3d::Zero();  // of the own velocity: 3 cm/s, correlated over 2 s
  for (int i = 0; i < static_cast<int>(seconds / kControl_s); ++i) {
    const double t = i * kControl_s;
    v_error += -kControl_s / 2 * v_error + noise(0.03 * std::sqrt(kControl_s));
    watch.Propagate({static_cast<std::int64_t>(1e6 * t)}, v_W + v_error);
    if (i % 5 != 0 || i < 10) {
      continue;
    }
    const double then = t - 0.1;
    PositionEstimate estimate;
    estimate.time = {static_cast<std::int64_t>(std::llround(1e6 * then))};
    estimate.p_WB = then * v_W + noise(0.03) + astray(then);
    const std::string words = watch.Judge(estimate);
    if (!words.empty()) {
      return {t, astray(then).norm(), words};
    }
  }
  return {};
}

TEST(EstimateWatch, IsSilentInGoodFlight) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Flown flown = Fly(seed, 60, [](double) { return Vector3d::Zero().eval(); });
    EXPECT_TRUE(std::isnan(flown.spoke_s)) << "seed " << seed << ": " << flown.words;
  }
}

TEST(EstimateWatch, SpeaksBeforeARampHasMovedMuch) {
  const struct {
    double rate_mps, most_s, most_m;
  } rows[] = {{2, 0.7, 1.0}, {0.5, 1.5, 0.65}, {0.3, 2.5, 0.7}, {0.2, 5, 0.9}};
  for (const auto& row : rows) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(row.rate_mps);
      const Flown flown = Fly(seed, 30, [&](double t) {
        return Vector3d(std::max(0.0, row.rate_mps * (t - 10)), 0, 0);
      });
      EXPECT_LE(flown.spoke_s - 10, row.most_s);
      EXPECT_GT(flown.spoke_s, 10);
      EXPECT_LE(flown.astray_m, row.most_m);
      EXPECT_NE(flown.words.find("limit 0."), std::string::npos) << flown.words;
    }
  }
}

TEST(EstimateWatch, BeginsAnewWithEachHandOver) {
  EstimateWatch watch;
  PositionEstimate estimate;
  watch.Propagate({0}, Vector3d::Zero());
  EXPECT_EQ(watch.Judge(estimate), "");
  estimate.p_WB.x() = 5;
  estimate.time = {1'000'000};
  watch.Propagate({1'000'000}, Vector3d::Zero());
  EXPECT_EQ(watch.Begin(estimate.p_WB, Vector3d::Zero()), "");
  EXPECT_EQ(watch.Judge(estimate), "");
}

// Slower than any span shows, for as long as a descent takes: the sum shows it.
TEST(EstimateWatch, BoundsWhatASlowDriftAddsUpTo) {
  for (const double rate_mps : {0.085, 0.06, 0.04}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(rate_mps);
      const Flown flown = Fly(seed, 120, [&](double t) { return Vector3d(0, rate_mps * t, 0); });
      EXPECT_LE(flown.astray_m, EstimateWatch::kSum_m + 1);
      EXPECT_FALSE(std::isnan(flown.spoke_s));
    }
  }
}

TEST(EstimateWatch, IsSilentInAGoodFlightOfTwoMinutes) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Flown flown = Fly(seed, 120, [](double) { return Vector3d::Zero().eval(); });
    EXPECT_TRUE(std::isnan(flown.spoke_s)) << "seed " << seed << ": " << flown.words;
  }
}

TEST(EstimateWatch, VisionMayNotTakeOverFarFromTheOwnSolution) {
  EstimateWatch watch;
  EXPECT_EQ(watch.Begin({9.9, 0, -15}, {0, 0, -15}), "");
  EXPECT_EQ(watch.Begin({0, 10.1, -15}, {0, 0, -15}),
            "The position estimate is 10.1 m from the vehicle's own, limit 10 m");
  EXPECT_NE(watch.Begin({NAN, 0, -15}, {0, 0, -15}), "");
}

}  // namespace
}  // namespace palace
