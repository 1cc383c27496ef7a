// The grid of one frame: its bounds, its cells, and the holes that are filled.
#include "engine/slad/terrain/elevation_map_builder.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::CameraPose;
using testing::Flat;
using testing::SeeWorld;
using testing::Slope;

TEST(ElevationMapBuilder, ThesisGridCoversTheDataWithFixedRows) {
  SladSettings settings;
  settings.mode = SladMode::kThesis;
  const RigidTransform X_WC = CameraPose(15.24, Rad(90));
  const ElevationMap map = ElevationFromRange(SeeWorld(Slope(Rad(5), 0), X_WC, 0, 1), settings);
  EXPECT_EQ(map.geometry.rows, 100);
  EXPECT_EQ(map.geometry.cols, 100);
  // 45 degrees across at 15.24 m: h = 2 R tan(f/2) = 12.6 m, of which 98 % percentiles remain.
  EXPECT_NEAR(map.geometry.cell_m, 0.126, 0.006);
  EXPECT_NEAR(double(map.height_m.at(50, 50)), std::tan(Rad(5)) * map.geometry.NorthOfRow(50),
              0.02);
}

TEST(ElevationMapBuilder, FieldOfViewAtNadirIsThesis44) {
  SladSettings settings;
  settings.mode = SladMode::kThesis;
  settings.grid.bounds = BoundsMode::kFieldOfView;
  const RigidTransform X_WC = CameraPose(15.24, Rad(90));
  const ElevationMap map = ElevationFromRange(SeeWorld(Flat(), X_WC, 0, 1), settings);
  EXPECT_NEAR(map.geometry.cell_m * 100, 2 * 15.24 * std::tan(Rad(22.5)), 0.03);
}

TEST(ElevationMapBuilder, GivenBoundsAreRelativeToTheMedian) {
  SladSettings settings;
  settings.grid.bounds = BoundsMode::kGiven;
  settings.grid.x_min_m = -3;
  settings.grid.x_max_m = 4.5;
  settings.grid.y_min_m = -1.5;
  settings.grid.y_max_m = 1.5;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 400; ++i) {
    points.push_back({1000 + 0.05 * i - 10, 2000 + 0.05 * (i * 7 % 400) - 10, -5});
  }
  const ElevationMap map = ElevationFromPoints(points, nullptr, settings, {});
  EXPECT_EQ(map.geometry.rows, 50);
  EXPECT_EQ(map.geometry.cols, 20);
  EXPECT_NEAR(map.geometry.north_min_m, 997, 0.25);
  EXPECT_NEAR(map.geometry.east_max_m(), 2001.5, 0.25);
}

TEST(ElevationMapBuilder, HolesUpToDataSizeAreFilledAndLargerStayUnknown) {
  SladSettings settings;
  settings.grid.cell_m = 1;
  settings.grid.rows = settings.grid.cols = 20;
  settings.grid.data_size_cells = 2;
  settings.grid.border_size_cells = 1;
  std::vector<Eigen::Vector3d> points;
  for (int n = 0; n < 12; ++n) {
    for (int e = 0; e < 12; ++e) {
      const bool small_hole = n >= 3 && n < 5 && e >= 3 && e < 5;
      const bool large_hole = n >= 6 && n < 9 && e >= 6 && e < 9;
      if (!small_hole && !large_hole) {
        points.push_back({n + 0.5, e + 0.5, -7});
      }
    }
  }
  const ElevationMap map = ElevationFromPoints(points, nullptr, settings, {});
  const auto state = [&](double n, double e) {
    return map.state.at(*map.geometry.CellFromPoint(n, e));
  };
  EXPECT_EQ(state(4.5, 4.5), CellState::kFilled);
  EXPECT_EQ(map.height_m.at(*map.geometry.CellFromPoint(4.5, 4.5)), 7.0F);
  EXPECT_EQ(state(7.5, 7.5), CellState::kUnknown);
  EXPECT_EQ(state(12.5, 5.5), CellState::kBorder);
  EXPECT_EQ(state(13.5, 5.5), CellState::kUnknown);
}

}  // namespace
}  // namespace palace
