// Frames that differ show relief: through fusion, as published.
#include <vector>

#include <gtest/gtest.h>

#include "engine/slad/terrain/fusion.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::CameraPose;
using testing::Flat;
using testing::SeeWorld;
using testing::WithBox;

struct Sightings {
  std::vector<bool> high;  ///< frame by frame: is it seen in the cell, or beside it?
  double at_least_m;
  double at_most_m;
};

class ReliefBetweenFrames : public ::testing::TestWithParam<Sightings> {};

// Pose noise puts what is narrower than a cell beside it in some frames, and a tall thing at the
// rim leans out of most pictures. k of n frames a metre up spread by sqrt(k (n - k)) / n about
// their mean k/n; the gate may keep the fused height on one side. A frame below all others adds
// nothing, and one above all others is a false match.
TEST_P(ReliefBetweenFrames, AMetreSeenInSomeFramesStands) {
  TerrainFusion fusion;
  const RigidTransform X_WC = CameraPose(15.24, Rad(60));
  const auto box = WithBox(Flat(), 9, 0, 1.2, 1.0);
  std::shared_ptr<const ElevationMap> map;
  std::uint64_t seed = 0;
  for (const bool high : GetParam().high) {
    map = fusion.Add(SeeWorld(high ? box : Flat(), X_WC, 0.05, ++seed), SladSettings{});
  }
  const auto cell = map->geometry.CellFromPoint(9, 0);
  const auto beside = map->geometry.CellFromPoint(9, 2);
  ASSERT_TRUE(cell && beside);
  EXPECT_GE(double(map->height_m.at(*cell)), GetParam().at_least_m);
  EXPECT_LE(double(map->height_m.at(*cell)), GetParam().at_most_m);
  EXPECT_NEAR(double(map->height_m.at(*beside)), 0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    Frames, ReliefBetweenFrames,
    ::testing::Values(Sightings{{0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, -0.05, 0.05},
                      Sightings{{0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, -0.05, 0.05},
                      Sightings{{0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, -0.05, 0.05},
                      Sightings{{1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, -0.05, 0.05},
                      Sightings{{0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 0.5, 0.7},  // (2 + 4)/10
                      Sightings{{0, 0, 1}, -0.05, 0.05},
                      Sightings{{1, 1, 1, 1, 1, 1, 1, 1, 1, 0}, 0.95, 1.05},
                      Sightings{{1, 1, 1, 1, 0, 1, 1, 1, 1, 1}, 0.95, 1.05},
                      Sightings{{0, 1, 0, 1, 0, 1, 0, 1, 0, 1}, 0.5, 1.1},
                      Sightings{{0, 0, 0, 0, 0, 0, 0, 0, 1, 1}, 0.95, 1.1},
                      Sightings{{1, 1, 1, 1, 1, 1, 1, 1, 1, 1}, 0.95, 1.05}));

TEST(TerrainFusion, WhatIsGoneFades) {
  TerrainFusion fusion;
  SladSettings settings;
  settings.fusion.frames_fused = 5;
  const RigidTransform X_WC = CameraPose(15.24, Rad(60));
  const auto box = WithBox(Flat(), 9, 0, 1.2, 1.0);
  std::vector<double> height_m;
  for (std::uint64_t i = 1; i <= 28; ++i) {
    const auto map = fusion.Add(SeeWorld(i <= 4 ? box : Flat(), X_WC, 0.05, i), settings);
    const auto cell = map->geometry.CellFromPoint(9, 0);
    ASSERT_TRUE(cell);
    height_m.push_back(double(map->height_m.at(*cell)));
  }
  EXPECT_GT(height_m[3], 0.95);
  EXPECT_GT(height_m[8], 0.15);
  for (std::size_t i = 6; i < height_m.size(); ++i) {
    EXPECT_LT(height_m[i], height_m[i - 1] + 0.01) << i;
  }
  EXPECT_LT(height_m.back(), 0.06);
}

}  // namespace
}  // namespace palace
