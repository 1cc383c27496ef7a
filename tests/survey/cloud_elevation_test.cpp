// Maps of point clouds: what a cell keeps of its points, and how large the map gets.
#include "engine/survey/cloud_elevation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

using Points = std::vector<Eigen::Vector3d>;  // x east, y north, z up

/// Level ground at 100 m, 6 m a side, a point every 5 cm with noise.
Points Meadow(double sigma_m, std::uint64_t seed = 3) {
  RandomStream random(seed, "meadow");
  Points points;
  for (int i = 0; i < 120 * 120; ++i) {
    points.emplace_back(500000 + 0.05 * (i % 120), 4000000 + 0.05 * (i / 120),
                        100 + sigma_m * random.Normal());
  }
  return points;
}

ElevationMap MapOf(const Points& points, std::vector<std::string>& warnings, double cell_m = 0.5) {
  auto map = MapOfCloud(points, cell_m, SladSettings{}, warnings);
  EXPECT_TRUE(map.ok()) << (map.ok() ? "" : map.error().message);
  return std::move(map).value();
}

TEST(CloudElevation, NoiseOfGroundIsAveraged) {
  std::vector<std::string> warnings;
  const ElevationMap map = MapOf(Meadow(0.02), warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_GE(map.geometry.rows * map.geometry.cell_m, 5.95);
  for (int r = 1; r < map.geometry.rows - 1; ++r) {
    for (int c = 1; c < map.geometry.cols - 1; ++c) {
      ASSERT_EQ(map.state.at(r, c), CellState::kMeasured) << r << ',' << c;
      EXPECT_NEAR(map.height_m.at(r, c), 100, 0.01) << r << ',' << c;
    }
  }
}

TEST(CloudElevation, ThingsOverGroundAreNotAveragedDown) {
  Points points = Meadow(0.01);
  points.emplace_back(500003.1, 4000003.1, 104.0);  // one return of a branch
  std::vector<std::string> warnings;
  const ElevationMap map = MapOf(points, warnings);
  const auto cell = map.geometry.CellFromPoint(4000003.1, 500003.1);
  ASSERT_TRUE(cell.has_value());
  EXPECT_NEAR(map.height_m.at(*cell), 104, 1e-3);
}

TEST(CloudElevation, PointsOffThisEarthAreLeftOutWithAWarning) {
  Points points = Meadow(0);
  points.emplace_back(500003, 4000003, -9999);
  points.emplace_back(500003, 4000003, 1e38);
  points.emplace_back(NAN, 4000003, 100);
  std::vector<std::string> warnings;
  const ElevationMap map = MapOf(points, warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("3 of 14403 points"), std::string::npos) << warnings[0];
  EXPECT_NEAR(map.height_m.at(5, 5), 100, 1e-4);
}

TEST(CloudElevation, ANearlyExactCloudStillHasAMillimetreOfDoubt) {
  std::vector<std::string> warnings;
  const ElevationMap map = MapOf(Meadow(0), warnings, 1.0);
  const float points = 20 * 20;
  EXPECT_NEAR(map.variance_m2.at(3, 3), 1e-6F / points, 2e-10F);
}

TEST(CloudElevation, CellsGrowWithAWarningUntilTheMapHoldsAll) {
  std::vector<std::string> warnings;
  SladSettings slad;
  slad.grid.rows = slad.grid.cols = 20;
  const auto map = MapOfCloud(Meadow(0), std::nullopt, slad, warnings);
  ASSERT_TRUE(map.ok());
  EXPECT_NEAR(map->geometry.cell_m, 5.95 / 20, 1e-6);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("cell enlarged from"), std::string::npos) << warnings[0];
  const auto refused = MapOfCloud({{0, 0, 0}, {9000, 0, 0}}, 1.0, slad, warnings);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("4096"), std::string::npos);
}

}  // namespace
}  // namespace palace
