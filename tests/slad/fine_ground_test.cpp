// The ground's posterior height: what noise says is no bump, what bumps say stays.
#include "engine/slad/terrain/fine_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slad/fine_field.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::FineField;
using testing::Flat;
using testing::Height;
using testing::MakeMap;
using testing::Slope;
using testing::WithBox;

/// What stereo said, with that noise, after the pictures were asked.
ElevationMap Asked(const Height& ground, double stereo_m, double place_m) {
  ElevationMap map = MakeMap(60, 60, 0.15, ground, stereo_m);
  map.measured_m = map.height_m;
  TakeFineGround(FineField(map.geometry, ground, place_m, 2), map);
  return map;
}

/// Sixteen waves 0.5 to 0.8 m long, of that standard deviation together.
class WavyGround {
 public:
  explicit WavyGround(double sigma_m) : each_m_(sigma_m * std::sqrt(2.0 / kWaves)) {
    RandomStream random(5, "waves");
    for (Wave& w : waves_) {
      const double direction = random.Uniform(0, M_PI), per_m = 2 * M_PI / random.Uniform(0.5, 0.8);
      w = {per_m * std::cos(direction), per_m * std::sin(direction), random.Uniform(0, 2 * M_PI)};
    }
  }
  double operator()(double n, double e) const {
    double sum = 0;
    for (const Wave& w : waves_) {
      sum += std::sin(w.north * n + w.east * e + w.phase);
    }
    return each_m_ * sum;
  }

 private:
  static constexpr int kWaves = 16;
  struct Wave {
    double north, east, phase;
  };
  double each_m_;
  std::array<Wave, kWaves> waves_{};
};

double RmsError(const ElevationMap& map, const Height& ground) {
  double sum = 0;
  int cells = 0;
  for (int r = 8; r < 52; ++r) {
    for (int c = 8; c < 52; ++c) {
      const double truth_m = ground(map.geometry.NorthOfRow(r), map.geometry.EastOfCol(c));
      sum += std::pow(static_cast<double>(map.measured_m.at(r, c)) - truth_m, 2);
      ++cells;
    }
  }
  return std::sqrt(sum / cells);
}

double MeanSigma(const ElevationMap& map) {
  double sum = 0;
  for (int r = 8; r < 52; ++r) {
    for (int c = 8; c < 52; ++c) {
      sum += static_cast<double>(map.variance_m2.at(r, c));
    }
  }
  return std::sqrt(sum / (44 * 44));
}

TEST(FineGround, LevelAndSlopingGroundIsAPlaneWhateverTheNoise) {
  for (const Height& ground : {Flat(0.4), Slope(Rad(12), 0.7)}) {
    const ElevationMap map = Asked(ground, 0.03, 0.05);
    EXPECT_LT(RmsError(map, ground), 0.008) << "stereo was off by 3 cm";
    EXPECT_LT(MeanSigma(map), 0.012);
    EXPECT_GT(MeanSigma(map), 0.5 * RmsError(map, ground));
  }
}

TEST(FineGround, RoughGroundStaysRoughAndItsErrorIsTheOneItStates) {
  // Waves about 0.6 m long, 2 cm (sigma) high: how rough is known, each bump only in part.
  const WavyGround bumpy(0.02);
  for (const double place_m : {0.01, 0.02, 0.05}) {
    const ElevationMap map = Asked(bumpy, 0.05, place_m);
    EXPECT_LT(RmsError(map, bumpy), 0.03) << place_m;
    EXPECT_GT(MeanSigma(map), 0.5 * RmsError(map, bumpy)) << place_m;
    EXPECT_LT(MeanSigma(map), 2.5 * RmsError(map, bumpy)) << place_m;
  }
}

TEST(FineGround, AKerbAndAMoundStandAsHighAsTheyAre) {
  const auto kerb = [](double, double e) { return std::abs(e) < 0.15 ? 0.15 : 0.0; };
  const auto mound = [](double n, double e) { return 0.15 * std::exp(-(n * n + e * e) / 0.18); };
  for (const Height& ground : {Height(kerb), Height(mound)}) {
    const ElevationMap map = Asked(ground, 0.03, 0.02);
    const Cell middle = *map.geometry.CellFromPoint(0.01, 0.01);
    EXPECT_NEAR(static_cast<double>(map.measured_m.at(middle)), 0.14, 0.04);
  }
}

TEST(FineGround, WhereStereoKnowsBetterOrThePicturesDenyItItsHeightStays) {
  const ElevationMap sure = MakeMap(60, 60, 0.15, Flat(), 0.002);
  ElevationMap map = sure;
  map.measured_m = map.height_m;
  TakeFineGround(FineField(map.geometry, Flat(), 0.2), map);
  EXPECT_EQ(map.measured_m.cells(), sure.height_m.cells());
  EXPECT_EQ(map.variance_m2.cells(), sure.variance_m2.cells());
  // A wall that no linear step from the ground reaches.
  map = MakeMap(60, 60, 0.15, WithBox(Flat(), 0, 0, 0.6, 1.5), 0.01);
  map.measured_m = map.height_m;
  TakeFineGround(FineField(map.geometry, Flat(), 0.005), map);
  EXPECT_NEAR(map.measured_m.at(30, 30), 1.5, 0.05);
  EXPECT_NEAR(map.measured_m.at(10, 10), 0, 0.005);
}

TEST(FineGround, TheTopKeepsWhatItStandsAboveTheGroundAndUnknownStaysUnknown) {
  ElevationMap map = MakeMap(60, 60, 0.15, Flat(), 0.03);
  map.measured_m = map.height_m;
  map.height_m.at(20, 20) += 0.3F;
  map.state.at(40, 40) = CellState::kUnknown;
  map.height_m.at(40, 40) = map.measured_m.at(40, 40) = kUnknownValue;
  TakeFineGround(FineField(map.geometry, Flat(), 0.02), map);
  EXPECT_NEAR(map.height_m.at(20, 20) - map.measured_m.at(20, 20), 0.3, 1e-5);
  EXPECT_TRUE(std::isnan(map.measured_m.at(40, 40)));
}

}  // namespace
}  // namespace palace
