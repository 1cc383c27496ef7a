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
  points.emplace_back(500003, -1e30, 100);
  std::vector<std::string> warnings;
  const ElevationMap map = MapOf(points, warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("4 of 14404 points"), std::string::npos) << warnings[0];
  EXPECT_NEAR(map.height_m.at(5, 5), 100, 1e-4);
}

/// Gauss-Kruger eastings have the number of their zone in front: Pulkovo's 32, at most 120.
TEST(CloudElevation, ZonesInFrontOfEastingsAreNoFarPlaces) {
  for (const double zone : {32, 60, 120}) {
    Points points = Meadow(0);
    for (Eigen::Vector3d& p : points) {
      p.x() += zone * 1e6;
    }
    std::vector<std::string> warnings;
    const ElevationMap map = MapOf(points, warnings);
    EXPECT_TRUE(warnings.empty()) << warnings[0];
    EXPECT_NEAR(map.geometry.east_min_m, zone * 1e6 + 500000, 1);
    EXPECT_NEAR(map.height_m.at(5, 5), 100, 1e-4);
  }
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

/// Level ground, 16 m a side, points scattered over it at random.
Points Scattered(double points_m2, std::uint64_t seed) {
  RandomStream random(seed, "scattered");
  Points points;
  for (int i = 0; i < static_cast<int>(256 * points_m2); ++i) {
    points.emplace_back(random.Uniform(0, 16), random.Uniform(0, 16), 100 + 0.01 * random.Normal());
  }
  return points;
}

/// Unknown or filled: what the points do not tell, without the rim, where cells hold a part.
double UnmeasuredInALander(const ElevationMap& map) {
  const GridGeometry& g = map.geometry;
  int unmeasured = 0;
  for (int r = 1; r < g.rows - 1; ++r) {
    for (int c = 1; c < g.cols - 1; ++c) {
      unmeasured += map.state.at(r, c) == CellState::kMeasured ? 0 : 1;
    }
  }
  const double radius_m = SladSettings{}.lander.clear_radius_m();
  return unmeasured * M_PI * radius_m * radius_m /
         ((g.rows - 2) * (g.cols - 2) * g.cell_m * g.cell_m);
}

std::string Only(const std::vector<std::string>& warnings, const char* part) {
  std::string found;
  for (const std::string& warning : warnings) {
    found += warning.find(part) != std::string::npos ? warning : "";
  }
  return found;
}

TEST(CloudElevation, CellsGrowUntilScatteredPointsLeaveRoomForALander) {
  for (const double points_m2 : {50.0, 100.0, 150.0}) {
    SCOPED_TRACE(points_m2);
    const Points points = Scattered(points_m2, 5);
    std::vector<std::string> warnings;
    const auto map = MapOfCloud(points, std::nullopt, SladSettings{}, warnings);
    ASSERT_TRUE(map.ok());
    EXPECT_LT(UnmeasuredInALander(*map), 2) << map->geometry.cell_m;
    EXPECT_LT(map->geometry.cell_m, 0.4);
    EXPECT_NE(Only(warnings, "--cell-m overrides"), "");
    // The size that is asked for stays, and the gaps are told.
    std::vector<std::string> asked;
    const ElevationMap small = MapOf(points, asked, std::sqrt(3 / points_m2));
    EXPECT_EQ(small.geometry.cell_m, std::sqrt(3 / points_m2));
    EXPECT_GT(UnmeasuredInALander(small), 3);
    EXPECT_NE(Only(asked, "cells lie single without a point among others, "), "");
  }
}

TEST(CloudElevation, CellsOfARegularSurveyStayAsTheyAre) {
  for (const double spacing_m : {0.1, 0.15, 0.25, 0.5}) {
    SCOPED_TRACE(spacing_m);
    Points points;
    const int side = static_cast<int>(15 / spacing_m);
    for (int i = 0; i < side * side; ++i) {
      const bool pond = i % side > side / 2 && i / side > side / 2;  // a gap, and no chance
      if (!pond) {
        points.emplace_back(spacing_m * (i % side), spacing_m * (i / side), 100);
      }
    }
    std::vector<std::string> warnings;
    const auto map = MapOfCloud(points, std::nullopt, SladSettings{}, warnings);
    ASSERT_TRUE(map.ok());
    EXPECT_EQ(Only(warnings, "single"), "");
    const double extent_m = spacing_m * (side - 1);
    EXPECT_NEAR(map->geometry.cell_m,
                std::max(0.15, std::sqrt(3 * extent_m * extent_m / double(points.size()))), 1e-9);
  }
}

TEST(CloudElevation, ACloudSmallerThanALanderNeedsIsDoubted) {
  Points degrees;
  for (const Eigen::Vector3d& p : Meadow(0)) {
    degrees.emplace_back(-92 + (p.x() - 500000) / 76000, 46.8 + (p.y() - 4000000) / 111000, p.z());
  }
  std::vector<std::string> warnings;
  ASSERT_TRUE(MapOfCloud(degrees, std::nullopt, SladSettings{}, warnings).ok());
  EXPECT_NE(Only(warnings, "degrees of longitude and latitude look like this: give metres"), "");
  warnings.clear();
  ASSERT_TRUE(MapOfCloud(Points(500, {7, 8, 9}), std::nullopt, SladSettings{}, warnings).ok());
  const std::string told = Only(warnings, "the points span 0 m north and 0 m east, a lander needs");
  EXPECT_NE(told, "");
  EXPECT_EQ(told.find("degrees"), std::string::npos) << told;
}

TEST(CloudElevation, APointFarFromAllOthersIsNamed) {
  Points points = Meadow(0);
  std::vector<std::string> warnings;
  ASSERT_TRUE(MapOfCloud(points, std::nullopt, SladSettings{}, warnings).ok());
  EXPECT_EQ(Only(warnings, "far from"), "");
  points.emplace_back(1.5e6, 5e6, 100);
  ASSERT_TRUE(MapOfCloud(points, std::nullopt, SladSettings{}, warnings).ok());
  EXPECT_NE(Only(warnings, "1 of 14401 points lies far from all others, which span 5.95 x 5.95 m"),
            "");
  const auto refused = MapOfCloud(points, 1.0, SladSettings{}, warnings);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("1 of 14401 points lies far"), std::string::npos);
}

}  // namespace
}  // namespace palace
