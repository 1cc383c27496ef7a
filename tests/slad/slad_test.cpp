// The order of calls as a whole: what a view adds, what a decision gives, what is forgotten.
#include "engine/slad/slad.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace palace
