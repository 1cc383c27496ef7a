// Grids, settings table and scene truth.
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/model/cell_explanation.h"
#include "engine/model/elevation_map.h"
#include "engine/model/grid.h"
#include "engine/model/settings/settings.h"
#include "engine/model/site_standing.h"
#include "engine/model/thinnest_seen.h"

namespace palace {
namespace {

TEST(GridGeometry, RowZeroIsNorthAndCellsHoldTheirCentres) {
  const GridGeometry g{4, 6, 0.5, 10, 20};
  EXPECT_DOUBLE_EQ(g.NorthOfRow(0), 11.75);
  EXPECT_DOUBLE_EQ(g.EastOfCol(0), 20.25);
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      EXPECT_EQ(g.CellFromPoint(g.NorthOfRow(r), g.EastOfCol(c)), (Cell{r, c}));
    }
  }
  EXPECT_FALSE(g.CellFromPoint(12.01, 20.2));
  EXPECT_FALSE(g.CellFromPoint(9.99, 20.2));
  EXPECT_FALSE(g.CellFromPoint(NAN, 20.2));
}

TEST(Grid, ALayerMovesWithItsMapAndKeepsWhatLiesInBoth) {
  const GridGeometry from{4, 6, 0.5, 10, 20};
  Grid<int> layer(4, 6);
  for (int i = 0; i < 24; ++i) {
    layer.cells()[static_cast<std::size_t>(i)] = i + 1;
  }
  for (const int north : {-5, -1, 0, 2}) {
    for (const int east : {-7, -2, 0, 3}) {
      const GridGeometry to{3, 7, 0.5, 10 + 0.5 * north, 20 + 0.5 * east};
      const Grid<int> moved = MovedTo(to, from, layer, -1);
      for (int r = 0; r < to.rows; ++r) {
        for (int c = 0; c < to.cols; ++c) {
          const auto was = from.CellFromPoint(to.NorthOfRow(r), to.EastOfCol(c));
          EXPECT_EQ(moved.at(r, c), was ? layer.at(*was) : -1) << north << " " << east;
        }
      }
    }
  }
  EXPECT_EQ(MovedTo({4, 6, 0.25, 10, 20}, from, layer, -1).cells(), std::vector<int>(24, -1))
      << "cells of another size";
  EXPECT_EQ(MovedTo(from, {}, Grid<int>(), -1).cells(), std::vector<int>(24, -1));
}

TEST(Settings, EveryRowIsConsistent) {
  const Settings defaults;
  for (const SettingInfo& info : SettingTable()) {
    EXPECT_LE(info.min, info.default_value) << info.name;
    EXPECT_GE(info.max, info.default_value) << info.name;
    EXPECT_LE(info.min, info.soft_min) << info.name;
    EXPECT_GE(info.max, info.soft_max) << info.name;
    EXPECT_EQ(GetSetting(defaults, info.name), info.default_value) << info.name;
    EXPECT_FALSE(info.label.empty() || info.description.empty()) << info.name;
    Settings copy = defaults;
    EXPECT_TRUE(SetSettingValue(copy, info.name, ClampSetting(info, info.max))) << info.name;
    EXPECT_TRUE(SetSettingValue(copy, info.name, ClampSetting(info, info.min))) << info.name;
    EXPECT_FALSE(SetSettingValue(copy, info.name, info.max + 1)) << info.name;
    EXPECT_FALSE(SetSettingValue(copy, info.name, NAN)) << info.name;
  }
}

TEST(Settings, HashFollowsEveryValue) {
  const Settings defaults;
  for (const SettingInfo& info : SettingTable()) {
    Settings changed = defaults;
    const double other = info.default_value == ClampSetting(info, info.max)
                             ? ClampSetting(info, info.min)
                             : ClampSetting(info, info.max);
    ASSERT_TRUE(SetSettingValue(changed, info.name, other)) << info.name;
    EXPECT_NE(HashOf(changed), HashOf(defaults)) << info.name;
  }
}

// Flights recorded before a row existed keep the hash of their settings.
TEST(Settings, ARowLaterThanTheRecordsCountsOnlyWhenChanged) {
  EXPECT_EQ(HashOf(Settings{}), 0x3bf81316ed8497d8u);
  Settings other;
  other.slad.lander.gear_below_m = 0.3;
  EXPECT_NE(HashOf(other), HashOf(Settings{}));
  other.slad.lander.gear_below_m = 0.9;
  other.mission.max_wind_mps = 9;
  EXPECT_NE(HashOf(other), HashOf(Settings{}));
}

TEST(Settings, ShownWithTheirUnit) {
  EXPECT_EQ(FormatSetting(*FindSetting("slad.max_slope_deg"), 10), "10.0°");
  EXPECT_EQ(FormatSetting(*FindSetting("slad.max_deviation_m"), 0.08), "8.0 cm");
  EXPECT_EQ(FormatSetting(*FindSetting("slad.mode"), 0), "thesis");
}

TEST(SiteStanding, AProvisionalSiteSaysWhy) {
  Settings settings;
  LandingSite site;
  site.safe_probability = 0.95;
  site.height_m.three_sigma = 0.03;
  site.confirmed = true;
  EXPECT_EQ(WhyProvisional(site, settings.slad), "");
  site.confirmed = false;
  site.frames_fused = 1;
  EXPECT_EQ(WhyProvisional(site, settings.slad), "seen in 1 of the 3 frames that it takes");
  site.frames_fused = 3;
  EXPECT_EQ(WhyProvisional(site, settings.slad), "rocks or holes over 10 cm may be hidden");
  site.pixel.setConstant(std::nan(""));  // a survey
  site.frames_fused = 1;
  EXPECT_EQ(WhyProvisional(site, settings.slad), "rocks or holes over 10 cm may be hidden");
  site.safe_probability = 0.8;
  EXPECT_EQ(WhyProvisional(site, settings.slad), "safe probability 0.800, sure from 0.900 on");
  // What heights do not tell comes first: nothing else is known then.
  site.height_m.three_sigma = 0.12;
  for (const SladMode mode : {SladMode::kModern, SladMode::kThesis}) {
    settings.slad.mode = mode;
    EXPECT_EQ(WhyProvisional(site, settings.slad),
              "height noise 12.0 cm (3 sigma), sure below 10.0 cm");
  }
  site.look_height_m = 8;
  EXPECT_EQ(WhyProvisional(site, settings.slad),
            "height noise 12.0 cm (3 sigma), sure from 8 m above it");
  LandingSite marked = site;
  marked.look_height_m = std::nan("");
  marked.flags = kFlagUnexplained;
  EXPECT_EQ(WhyProvisional(marked, settings.slad),
            "height noise 12.0 cm (3 sigma), sure below 10.0 cm; an unexplained mark");
  site.height_m.three_sigma = 0.03;
  site.hidden_things = 0.154;
  EXPECT_EQ(WhyProvisional(site, settings.slad),
            "0.15 hidden rocks or holes expected, sure from 8 m above it");
  site.look_height_m = std::nan("");
  EXPECT_EQ(WhyProvisional(site, settings.slad), "0.15 hidden rocks or holes expected, limit 0.01");
  site.flags = kFlagUnexplained;
  EXPECT_EQ(WhyProvisional(site, settings.slad),
            "0.15 hidden things expected (unexplained mark), limit 0.01");
  site.flags = kFlagNone;
  site.hidden_things = 0.0103;
  EXPECT_EQ(WhyProvisional(site, settings.slad),
            "0.011 hidden rocks or holes expected, limit 0.010");
}

// Why no look is offered, too: from lower even less of the air would be in view.
TEST(SiteStanding, WhereTheAirWasNotSeenItSaysWhatShowsIt) {
  const SladSettings settings;
  const struct {
    double way_m, look_m;
    const char* words;
    bool shown;
  } table[] = {{6, 8, "air over it seen up to 4.6 m, sure from 8 m above it", true},
               {5, NAN, "air over it seen up to 4.6 m, 5 m is seen on the way down", true},
               {4.9, NAN, "air over it seen up to 4.6 m, 5 m takes a look from higher up", false},
               {NAN, NAN, "air over it seen up to 4.6 m, 5 m takes a look from higher up", false}};
  for (const auto& row : table) {
    LandingSite site;
    site.height_m.three_sigma = 0.03;
    site.air_seen_m = 4.66;
    site.air_on_way_m = row.way_m;
    site.look_height_m = row.look_m;
    EXPECT_EQ(WhyProvisional(site, settings), row.words);
    EXPECT_EQ(IsAirShown(site), row.shown) << row.way_m;
    // What may stand there speaks louder than air that the way down shows.
    LandingSite blind = site;
    blind.hidden_things = 0.14;
    const std::string why = WhyProvisional(blind, settings);
    EXPECT_EQ(why.rfind("0.14 hidden rocks or holes expected", 0) == 0, row.shown) << why;
    site.air_seen_m = 5;
    EXPECT_TRUE(IsAirShown(site));
    site.air_seen_m = NAN;  // nobody asked
    EXPECT_TRUE(IsAirShown(site));
  }
}

TEST(SiteStanding, APlaceInWhoseNoiseOrAirAThingCouldHideIsOnlyLookedAt) {
  const SladSettings settings;  // roughness 10 cm
  const struct {
    double three_sigma_m, air_seen_m;
    bool confirmed;
    const char *word, *words;
  } table[] = {{0.03, 9, true, "Confirmed", "Confirmed"},
               {0.03, 9, false, "Provisional", "Provisional"},
               {0.03, NAN, false, "Provisional", "Provisional"},  // a survey
               {0.03, 5, false, "Provisional", "Provisional"},
               {0.03, 4.9, false, "Look first", "Look from 7 m"},
               {0.03, 4.9, true, "Confirmed", "Confirmed"},  // by an earlier look
               {0.099, 9, false, "Provisional", "Provisional"},
               {0.10, 9, false, "Look first", "Look from 7 m"},
               {NAN, 9, false, "Look first", "Look from 7 m"}};
  for (const auto& row : table) {
    LandingSite site;
    site.height_m.three_sigma = row.three_sigma_m;
    site.confirmed = row.confirmed;
    site.air_seen_m = row.air_seen_m;
    site.look_height_m = 7;
    EXPECT_STREQ(StandingWord(StandingOf(site, settings)), row.word) << row.three_sigma_m;
    EXPECT_EQ(StandingWords(site, settings), row.words) << row.three_sigma_m;
  }
}

TEST(RequiredSafeProbability, FallsWithNoiseAndWithWhatHidesAsFarAsGroundThatIsBlind) {
  const struct {
    double sigma_m, hidden, required;
  } table[] = {{0, NAN, 0.9},           {0, 0.1, 0.9 * std::exp(-0.1)},
               {0.03, 0, 0.64},         {0.03, 0.1, 0.64 * std::exp(-0.1)},
               {0.03, 0.5, 0.64 * 0.8}, {0.06, 0.2, 0},
               {NAN, 0.3, 0.9 * 0.8}};
  SladSettings settings;
  for (const auto& row : table) {
    SCOPED_TRACE(row.sigma_m);
    EXPECT_NEAR(RequiredSafeProbability(settings, row.sigma_m, row.hidden), row.required, 1e-12);
  }
  settings.limits.min_safe_probability = 0;
  for (const auto& row : table) {
    EXPECT_EQ(RequiredSafeProbability(settings, row.sigma_m, row.hidden), 0) << "nothing is asked";
  }
}

// 12 m below a camera that looks straight down, two pixels of 600 px focal length.
TEST(ThinnestSeen, IsTwoPixelsAtThatDepth) {
  const PinholeCamera camera{640, 480, 600, 600, 319.5, 239.5};
  const RigidTransform X_WC{Eigen::Matrix3d::Identity(), {5, -3, -12}};
  EXPECT_NEAR(ThinnestSeen_m(camera, X_WC, {7, 1, 0}), 0.04, 1e-12);
  EXPECT_TRUE(std::isnan(ThinnestSeen_m(camera, X_WC, {7, 1, -13}))) << "behind it";
  EXPECT_TRUE(std::isnan(ThinnestSeen_m({}, X_WC, {7, 1, 0}))) << "no camera";
}

}  // namespace
}  // namespace palace
