// From where a closer look would settle a site, and whether its way down shows the air.
#include <cmath>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/model/site_standing.h"
#include "engine/slad/sites/site_selection.h"
#include "tests/slad/seen_from_the_south.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;
using testing::Select;
using testing::ThatShow;

TEST(LookHeight, ALookIsNamedWhereItsWayShowsTheAirOrItWasSeen) {
  const PinholeCamera wide = PinholeFromFov(640, 480, Rad(60));
  const PinholeCamera narrow = PinholeFromFov(640, 480, Rad(20));
  for (const auto& [camera, air_m, named] : {std::tuple{wide, 3.0F, true},
                                             {wide, 9.0F, true},
                                             {narrow, 3.0F, false},
                                             {narrow, 9.0F, true}}) {
    SiteContext context;
    context.p_WB = {-13, 0, -13};
    context.X_WC = {CameraRotationFromTilt(Rad(-45)), context.p_WB};
    context.camera = camera;
    ElevationMap map = MakeMap(101, 101, 0.15, Flat(), 0.02);
    map.air_seen_to_m = GridF(101, 101, air_m);
    map.narrow = ThatShow(map.geometry, 0, 0.02);
    const LandingSite site = Select(map, {}, context).sites.at(0);
    EXPECT_FALSE(site.confirmed);
    EXPECT_EQ(std::isfinite(site.look_height_m), named) << camera.fx_px << " px, " << air_m << " m";
    if (named) {
      EXPECT_GT(site.look_height_m, 6);
      EXPECT_LE(site.look_height_m, 11);
      EXPECT_EQ(site.look_height_m, std::floor(site.look_height_m));
    }
  }
}

// Straight down, 90 degrees across: in view is more than 5 m of the air from either height; 7 m off
// and farther, from 11 m only 4 m of it.
TEST(LookHeight, ALookStraightDownIsNamedWhereTheAirIsFarEnoughOff) {
  for (const auto& [height_m, named] : {std::pair{11.0, false}, std::pair{13.0, true}}) {
    SiteContext context;
    context.p_WB = {-2, 0, -height_m};
    context.X_WC = {CameraRotationFromTilt(Rad(-90)), context.p_WB};
    context.camera = PinholeFromFov(640, 480, Rad(90));
    context.glide_slope_rad = Rad(80);
    ElevationMap map = MakeMap(101, 101, 0.15, Flat(), 0.02);
    map.air_seen_to_m = GridF(101, 101, 3.0F);
    map.narrow = ThatShow(map.geometry, 0, 0.02);
    const LandingSite site = Select(map, {}, context).sites.at(0);
    EXPECT_EQ(std::isfinite(site.look_height_m), named) << height_m;
  }
}

// Of ground that hides nothing: the highest hover that is a way to go, for the slope shows the air.
TEST(LookHeight, WhereOnlyTheAirIsMissingALookIsNamedFromAsHighAsIsWorthIt) {
  SladSettings settings;
  SiteContext context;
  context.p_WB = {-13, 0, -13};
  context.X_WC = {CameraRotationFromTilt(Rad(-45)), context.p_WB};
  context.camera = PinholeFromFov(640, 480, Rad(60));
  for (const auto& [air_m, named] : {std::pair{3.0F, true}, std::pair{9.0F, false}}) {
    ElevationMap map = MakeMap(101, 101, 0.15, Flat());
    map.air_seen_to_m = GridF(101, 101, air_m);
    map.narrow = ThatShow(map.geometry, 0, 0.003);
    const LandingSite site = Select(map, settings, context).sites.at(0);
    EXPECT_EQ(site.confirmed, !named);
    EXPECT_GE(site.air_on_way_m, kLeastAirSeen_m);
    ASSERT_EQ(std::isfinite(site.look_height_m), named) << air_m;
    if (named) {
      const double highest_m = 13 - settings.lander.skid_centre_B().z() - kLeastWayToLook_m;
      EXPECT_NEAR(site.look_height_m, highest_m, 1);
      EXPECT_LE(site.look_height_m, highest_m);
    }
  }
}

// A nearer look may find what left a mark, or explain it: from where, nobody knows.
TEST(LookHeight, AMarkedPlaceHasNone) {
  SiteContext context;
  context.p_WB = {-13, 0, -13};
  context.X_WC = {CameraRotationFromTilt(Rad(-45)), context.p_WB};
  context.camera = PinholeFromFov(640, 480, Rad(60));
  for (const bool is_marked : {false, true}) {
    ElevationMap map = MakeMap(101, 101, 0.15, Flat(), 0.02);
    map.air_seen_to_m = GridF(101, 101, 9.0F);
    map.narrow = ThatShow(map.geometry, 0, 0.02);
    map.narrow.mark = map.narrow.mark_from_m = GridF(202, 202, is_marked ? 0.4F : 0.0F);
    const LandingSite site = Select(map, {}, context).sites.at(0);
    EXPECT_EQ(IsMarked(site), is_marked);
    EXPECT_EQ(std::isfinite(site.look_height_m), !is_marked);
  }
}

}  // namespace
}  // namespace palace
