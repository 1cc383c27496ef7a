// The order of calls as a whole: what a view adds, what a decision gives, what is forgotten.
#include "engine/slad/slad.h"

#include <gtest/gtest.h>

#include "engine/slad/terrain/terrain_points.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::CameraPose;
using testing::Flat;
using testing::MakeMap;
using testing::SeeWorld;
using testing::WithBox;

SladInput View(const testing::Height& world, std::uint64_t seed, double height_m = 15.24) {
  SladInput input;
  input.view.range =
      std::make_shared<const RangeMap>(SeeWorld(world, CameraPose(height_m, Rad(60)), 0.03, seed));
  input.p_WB = {0, 0, -height_m};
  return input;
}

TEST(Slad, TheSameViewsGiveTheSameMapsAndForgettingIsStartingAfresh) {
  const auto world = WithBox(Flat(), 9, 0, 1.0, 0.6);
  const Settings settings;
  const auto maps = [&](Slad& slad) {
    std::vector<std::uint64_t> hashes;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      slad.Add(View(world, seed), settings.slad);
      hashes.push_back(slad.Decide(settings, Letters::kOfRecord)->map_hash);
    }
    return hashes;
  };
  Slad one, other;
  const auto first = maps(one);
  EXPECT_EQ(maps(other), first);
  EXPECT_NE(maps(one), first) << "views are fused";
  const std::uint64_t last_id = one.Decide(settings, Letters::kOfCopy)->selection.sites[0].id;
  one.Forget(SiteNames::kAnew);
  EXPECT_FALSE(one.has_map());
  EXPECT_EQ(maps(one), first);
  EXPECT_GT(one.Decide(settings, Letters::kOfCopy)->selection.sites[0].id, last_id)
      << "ids are not used again";
}

TEST(Slad, ACopyOfTheLettersGivesNoneAway) {
  Slad slad;
  Settings settings;
  slad.Add(View(Flat(), 1), settings.slad);
  Settings stricter = settings;
  stricter.slad.choice.spacing_m = 5;
  const auto previewed = slad.Decide(stricter, Letters::kOfCopy);
  const auto decided = slad.Decide(settings, Letters::kOfRecord);
  ASSERT_FALSE(previewed->selection.sites.empty());
  ASSERT_FALSE(decided->selection.sites.empty());
  EXPECT_EQ(decided->selection.sites[0].letter, "A");
  EXPECT_EQ(decided->selection.sites[0].id, 1u);
  EXPECT_EQ(previewed->settings, stricter.slad);
  EXPECT_NE(previewed->settings_hash, decided->settings_hash);
}

TEST(Slad, ASurveyIsJudgedWithoutPictureAndVehicle) {
  Slad slad;
  slad.Add(View(Flat(), 1), SladSettings{});
  slad.Take(MakeMap(60, 60, 0.15, Flat(3)));
  const auto decision = slad.Decide(Settings{}, Letters::kOfRecord);
  ASSERT_FALSE(decision->selection.sites.empty());
  const LandingSite& site = decision->selection.sites[0];
  EXPECT_NEAR(site.height_m.value, 3, 1e-6);
  EXPECT_TRUE(std::isnan(site.distance_m));
  EXPECT_EQ(decision->verdict, nullptr);
  EXPECT_EQ(site.letter, "A");
}

/// Sigmas come with the pose: one that is known worse makes slopes less sure, and one whose place
/// wanders is believed less where the ground is steep.
TEST(Slad, AWorsePoseIsBelievedLess) {
  const auto slope_sigma_rad = [](double attitude_rad) {
    Slad slad;
    SladInput input = View(Flat(), 1);
    auto range = std::make_shared<RangeMap>(*input.view.range);
    range->pose->sigmas.attitude_rad = attitude_rad;
    input.view.range = range;
    slad.Add(input, SladSettings{});
    EXPECT_EQ(slad.elevation()->attitude_sigma_rad, attitude_rad);
    const TerrainFigures figures = MeasureTerrain(*slad.elevation(), SladSettings{});
    return double(figures.slope_sigma_rad.at(50, 50));
  };
  const double standard = slope_sigma_rad(PoseSigmas{}.attitude_rad);
  EXPECT_GE(standard, Rad(0.1));
  EXPECT_GT(slope_sigma_rad(Rad(1)), Rad(1));
  EXPECT_LT(standard, Rad(1));
  // A wall that the second view sees 0.4 m nearer: with a good pose the cells contradict the
  // first, with a bad one they are averaged.
  const auto frames = [](double position_m) {
    TerrainFusion fusion;
    const auto world = WithBox(Flat(), 9, 0, 2.0, 0.6), moved = WithBox(Flat(), 8.6, 0, 2.0, 0.6);
    std::shared_ptr<const ElevationMap> map;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      RangeMap range = SeeWorld(seed <= 2 ? world : moved, CameraPose(15.24, Rad(60)), 0.03, seed);
      range.pose->sigmas.position_m = position_m;
      map = fusion.Add(range, SladSettings{});
    }
    return int(map->frame_count.at(*map->geometry.CellFromPoint(7.75, 0)));
  };
  EXPECT_LT(frames(0.03), 4);
  EXPECT_EQ(frames(1.0), 4);
}

TEST(ViewCell, DoublesWhileTheViewIsTwiceTheMapAndComesBackWellInside) {
  struct Row {
    double height_m;
    double factor;
  };
  // 45 degrees across: the view is 0.83 of the depth; the map is 15 m.
  const Row rows[] = {{15, 1}, {35, 1}, {38, 2}, {31, 2}, {28, 1}, {80, 4}, {1, 1}, {1000, 16}};
  ViewCell cell;
  SladSettings settings;
  RangeMap range = SeeWorld(Flat(), CameraPose(10, Rad(90)), 0, 1, 2);
  for (const Row& row : rows) {
    for (float& depth_m : range.depth_m.pixels()) {
      depth_m = static_cast<float>(row.height_m);
    }
    EXPECT_EQ(cell.Fit(range, settings).grid.cell_m, row.factor * settings.grid.cell_m)
        << row.height_m;
  }
  settings.grid.bounds = BoundsMode::kGiven;
  EXPECT_EQ(cell.Fit(range, settings), settings);
}

// Straight down the view is 0.83 of the height wide and 0.62 high; rows run north, the picture's
// way up, in steps of 20 cells of 0.15 m.
TEST(ViewCell, HasTheRowsAndColumnsThatTheViewNeeds) {
  struct Row {
    double height_m;
    int rows, cols;
  };
  const Row rows[] = {{10, 100, 100}, {20, 100, 120}, {30, 140, 180},
                      {28, 140, 180}, {26, 120, 160}, {10, 100, 100}};
  ViewCell cell;
  const SladSettings settings;
  for (const Row& row : rows) {
    const RangeMap range = SeeWorld(Flat(), CameraPose(row.height_m, Rad(90)), 0, 1, 2);
    const GridSettings grid = cell.Fit(range, settings).grid;
    EXPECT_EQ(grid.rows, row.rows) << row.height_m;
    EXPECT_EQ(grid.cols, row.cols) << row.height_m;
    EXPECT_EQ(grid.cell_m, settings.grid.cell_m);
  }
  RangeMap nothing = SeeWorld(Flat(), CameraPose(30, Rad(90)), 0, 1, 2);
  nothing.depth_m = ImageF(nothing.depth_m.width(), nothing.depth_m.height(), NAN);
  EXPECT_EQ(cell.Fit(nothing, settings), settings);
}

// From 15 m at 45 degrees the ground in view is some 22 m long: what is near was left out by a map
// of 15 m about the middle.
TEST(Slad, TheMapHoldsTheGroundInViewNearAndFar) {
  Slad slad;
  const RangeMap range = SeeWorld(Flat(), CameraPose(15, Rad(45)), 0.01, 1);
  slad.Add({.view = {nullptr, nullptr, std::make_shared<const RangeMap>(range)}}, SladSettings{});
  const GroundBounds seen = BoundsOfData(PointsFromRange(range));
  const GridGeometry& g = slad.elevation()->geometry;
  EXPECT_GT(seen.north_max_m - seen.north_min_m, 16);
  EXPECT_TRUE(g.CellFromPoint(seen.north_min_m, (seen.east_min_m + seen.east_max_m) / 2));
  EXPECT_TRUE(g.CellFromPoint(seen.north_max_m, (seen.east_min_m + seen.east_max_m) / 2));
}

// A view that grows takes nothing of what the map knows.
TEST(TerrainFusion, RemembersItsGroundWhereTheMapGrows) {
  TerrainFusion fusion;
  SladSettings settings;
  fusion.Add(SeeWorld(Flat(), CameraPose(15.24, Rad(60)), 0.01, 1), settings);
  settings.grid.rows = settings.grid.cols = 160;
  const auto map = fusion.Add(SeeWorld(Flat(), CameraPose(15.24, Rad(60)), 0.01, 2), settings);
  EXPECT_EQ(map->geometry.rows, 160);
  EXPECT_EQ(int(map->frame_count.at(*map->geometry.CellFromPoint(8.8, 0))), 2);
}

}  // namespace
}  // namespace palace
