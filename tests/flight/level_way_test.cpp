// What the map shows under a way flown level: the highest top in the corridor, and what was not
// seen.
#include "engine/flight/level_way.h"

#include <limits>

#include <gtest/gtest.h>

namespace palace {
namespace {

/// 40 x 40 m around W at 0.5 m a cell, flat, with sigma 1 cm; a box 3 m high 10 m north; the
/// southern 5 m were never seen.
ElevationMap Field() {
  ElevationMap map;
  map.geometry = {80, 80, 0.5, -20, -20};
  map.height_m = GridF(80, 80, 0.0F);
  map.variance_m2 = GridF(80, 80, 1e-4F);
  map.state = Grid<CellState>(80, 80, CellState::kMeasured);
  map.frame_count = Grid<std::uint16_t>(80, 80, 1);
  for (int row = 0; row < 80; ++row) {
    for (int col = 0; col < 80; ++col) {
      const double north_m = map.geometry.NorthOfRow(row), east_m = map.geometry.EastOfCol(col);
      if (std::abs(north_m - 10) < 1 && std::abs(east_m) < 1) {
        map.height_m.at(row, col) = 3;
      }
      if (north_m < -15) {
        map.state.at(row, col) = CellState::kUnknown;
        map.height_m.at(row, col) = NAN;
      }
    }
  }
  return map;
}

TEST(LevelWay, TheHighestTopInTheCorridorIsTold) {
  const ElevationMap map = Field();
  struct Row {
    const char* name;
    Eigen::Vector2d from, to;
    double highest_m;
  };
  for (const Row& row :
       {Row{"over the box", {0, 0}, {19, 0}, 3.03}, Row{"ends before it", {0, 0}, {7, 0}, 0.03},
        Row{"ends so near that the rotor reaches it", {0, 0}, {8, 0}, 3.03},
        Row{"passes 1 m beside it", {0, 2}, {19, 2}, 3.03},
        Row{"passes 2 m beside it", {0, 3.5}, {19, 3.5}, 0.03},
        Row{"goes nowhere, beside it", {10, 2}, {10, 2}, 3.03}}) {
    EXPECT_NEAR(HighestBelow(map, row.from, row.to, 1.5), row.highest_m, 1e-6) << row.name;
  }
}

TEST(LevelWay, AWireCountsAsHighAsItHangs) {
  ElevationMap map = Field();
  map.thin_top_m = GridF(80, 80, kUnknownValue);
  const auto cell = map.geometry.CellFromPoint(4, 0);
  map.thin_top_m.at(*cell) = 7;
  EXPECT_NEAR(HighestBelow(map, {0, 0}, {8, 0}, 1.5), 7, 1e-6);
  map.thin_top_m.at(*cell) = std::numeric_limits<float>::infinity();  // at a height nobody knows
  EXPECT_TRUE(std::isinf(HighestBelow(map, {0, 0}, {8, 0}, 1.5)));
}

TEST(LevelWay, WhatWasNotSeenIsMeasuredAlongTheWay) {
  const ElevationMap map = Field();
  EXPECT_NEAR(UnseenBelow(map, {0, 0}, {10, 5}), 0, 1e-9);
  EXPECT_NEAR(UnseenBelow(map, {-10, 0}, {-19, 0}), 4, 0.5);
  EXPECT_NEAR(UnseenBelow(map, {-10, 0}, {-30, 0}), 15, 0.5) << "off the map, too";
  EXPECT_TRUE(std::isnan(HighestBelow({}, {0, 0}, {10, 0}, 1.5)));
  EXPECT_NEAR(UnseenBelow({}, {0, 0}, {10, 0}), 10, 1e-9);
}

}  // namespace
}  // namespace palace
