#include "engine/slad/sites/site_selection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/slad/map_hash.h"
#include "engine/slad/sites/verdict_image.h"
#include "engine/slad/slad.h"
#include "tests/slad/seen_from_the_south.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::CameraPose;
using testing::Context;
using testing::Flat;
using testing::MakeMap;
using testing::SeeWorld;
using testing::Select;
using testing::ThatShow;
using testing::ThesisCamera;
using testing::WithBox;
using testing::WithMode;

TEST(SiteSelection, FlatFieldIsWonByItsMiddle) {
  for (const SladMode mode : {SladMode::kThesis, SladMode::kModern}) {
    const SiteSelection selection = Select(MakeMap(101, 101, 0.15, Flat(2)), WithMode(mode));
    ASSERT_FALSE(selection.sites.empty());
    const LandingSite& site = selection.sites.front();
    EXPECT_EQ(site.cell, (Cell{50, 50}));
    // To the middle of the cell beyond the rim, or to its side.
    const double rim_m = (mode == SladMode::kThesis ? 51 : 50.5) * 0.15;
    EXPECT_NEAR(site.safe_distance_m, rim_m, 1e-5);
    EXPECT_NEAR(site.clearance_m, rim_m - 2.3, 1e-5);
    EXPECT_NEAR((site.p_WS - Eigen::Vector3d(0, 0, -2)).norm(), 0, 1e-5);
    EXPECT_NEAR((site.normal_W + Eigen::Vector3d::UnitZ()).norm(), 0, 1e-6);
    EXPECT_EQ(site.reason, "Widest: 2.3 m more clear than B");
    EXPECT_EQ(site.unknown_cells, 0);
    EXPECT_TRUE(site.confirmed);
    EXPECT_TRUE(site.corridor_clear);
    EXPECT_EQ(site.clear_approaches, 0xFF);
    EXPECT_EQ(site.age_s, 0);
    EXPECT_NEAR(site.distance_m, 15, 1e-6);
  }
}

// Nobody knows where the vehicle is: any wall on the map may stand in its way.
TEST(SiteSelection, WithoutAVehicleAShaftHasNoApproach) {
  SiteContext context;
  context.p_WB.setConstant(std::nan(""));
  const auto shaft = [](double n, double e) {
    return std::max(std::abs(n), std::abs(e)) < 4 ? 0.0 : 30.0;
  };
  const SiteSelection walled = Select(MakeMap(81, 81, 0.15, shaft), {}, context);
  ASSERT_FALSE(walled.sites.empty());
  EXPECT_EQ(walled.sites.front().clear_approaches, 0);
  const SiteSelection open = Select(MakeMap(81, 81, 0.15, Flat()), {}, context);
  ASSERT_FALSE(open.sites.empty());
  EXPECT_EQ(open.sites.front().clear_approaches, 0xFF);
}

TEST(SiteSelection, OnlyCellsThatCanBearTheLanderAreOffered) {
  const SladSettings settings;
  const ElevationMap map = MakeMap(81, 81, 0.15, WithBox(Flat(), 1, 1, 1, 0.5));
  const HazardMaps hazards = EvaluateHazards(map, settings);
  int can_bear = 0;
  for (int r = 0; r < 81; ++r) {
    for (int c = 0; c < 81; ++c) {
      can_bear += CanBearLander(hazards, {r, c}) ? 1 : 0;
    }
  }
  EXPECT_EQ(can_bear, hazards.safe_cells);
  EXPECT_GT(can_bear, 100);
}

// Along the middle of a lane many places are equal but for how the walls fall into cells.
TEST(SiteSelection, ALaneIsWonByItsMiddle) {
  SiteContext context = Context();
  context.camera.width = 0;
  for (int turn_deg = 0; turn_deg < 180; turn_deg += 7) {
    const double turn = Rad(turn_deg);
    const auto lane = [turn](double n, double e) {
      const double along = n * std::cos(turn) + e * std::sin(turn);
      const double across = e * std::cos(turn) - n * std::sin(turn);
      return std::abs(along) > 4 || std::abs(across) > 3 ? 1.5 : 0.0;
    };
    const SiteSelection selection = Select(MakeMap(81, 81, 0.15, lane, 0.004, 3), {}, context);
    ASSERT_FALSE(selection.sites.empty()) << turn_deg;
    EXPECT_LT(selection.sites.front().p_WS.head<2>().norm(), 0.3) << turn_deg;
  }
}

// Ground that is told well hides nothing; with more noise a rock of the limit's size would drown.
TEST(SiteSelection, ASiteIsConfirmedOnlyWhereNothingCanHide) {
  for (const auto& [noise_m, confirmed] : {std::pair{0.004, true}, std::pair{0.03, false}}) {
    SiteContext context;
    context.p_WB = {0, 0, -12};
    context.X_WC = {CameraRotationFromTilt(Rad(-90)), context.p_WB};
    context.camera = PinholeFromFov(640, 480, Rad(60));
    ElevationMap map = MakeMap(101, 101, 0.15, Flat(), 0.006);
    map.narrow = ThatShow(map.geometry, 0, noise_m);
    const SiteSelection selection = Select(map, {}, context);
    ASSERT_FALSE(selection.sites.empty());
    EXPECT_EQ(selection.sites.front().confirmed, confirmed) << noise_m;
    SladSettings larger;
    larger.limits.max_deviation_m = 0.3;
    EXPECT_TRUE(Select(map, larger, context).sites.at(0).confirmed);
  }
}

// From 13 m and 45 degrees down: with 60 degrees across the top of the picture looks 21.6 degrees
// down, 6.9 m over the far rim of the site from where the slope begins; with 20 degrees, 1.3 m.
TEST(SiteSelection, SeenGroundGoesBeforeWideAndBlindGround) {
  // The west is wide and blind; the east seen, with a box that leaves less room.
  ElevationMap map = MakeMap(101, 101, 0.15, WithBox(Flat(), 3.5, 3.5, 0.5, 0.6));
  EXPECT_LT(Select(map).sites.at(0).p_WS.y(), 0.5);
  map.narrow = ThatShow(map.geometry, 0, 0.003);
  EXPECT_LT(Select(map).sites.at(0).p_WS.y(), 0.5);
  for (int r = 0; r < 202; ++r) {
    for (int c = 0; c < 100; ++c) {
      map.narrow.sigma_m.at(r, c) = 0.05F;
    }
  }
  const LandingSite best = Select(map).sites.at(0);
  EXPECT_GT(best.p_WS.y(), 2.0);
  EXPECT_TRUE(best.confirmed);
}

TEST(SiteSelection, ASiteOfPicturesIsConfirmedByThreeFrames) {
  for (const int frames : {1, 2, 3, 10}) {
    ElevationMap map = MakeMap(101, 101, 0.15, Flat());
    std::fill(map.frame_count.cells().begin(), map.frame_count.cells().end(), frames);
    EXPECT_EQ(Select(map).sites.at(0).confirmed, frames >= 3) << frames;
    EXPECT_TRUE(Select(map, WithMode(SladMode::kThesis)).sites.at(0).confirmed);
    EXPECT_TRUE(Select(map, {}, SiteContext{}).sites.at(0).confirmed) << "a survey";
    SladSettings two;
    two.fusion.frames_fused = 2;
    EXPECT_EQ(Select(map, two).sites.at(0).confirmed, frames >= 2) << frames;
  }
}

TEST(SiteSelection, NewGroundAtTheRimOfASiteLeavesItProvisional) {
  for (const int new_columns : {0, 2, 12}) {
    ElevationMap map = MakeMap(101, 101, 0.15, Flat());
    std::fill(map.frame_count.cells().begin(), map.frame_count.cells().end(), 10);
    const Cell site = Select(map).sites.at(0).cell;
    const int rim = static_cast<int>(2.3 / 0.15);
    for (int r = 0; r < 101; ++r) {
      for (int k = 0; k < new_columns; ++k) {
        map.frame_count.at(r, site.col + rim - k) = 1;
      }
    }
    const LandingSite again = Select(map).sites.at(0);
    EXPECT_EQ(again.confirmed, new_columns < 12) << new_columns;
    EXPECT_EQ(again.frames_fused, new_columns < 12 ? 10 : 1) << new_columns;
  }
}

TEST(SiteSelection, ASiteOfASurveyIsConfirmedOnlyWhereCellsAreNoWiderThanRocks) {
  for (const auto& [cell_m, confirmed] : {std::pair{0.4, true}, std::pair{0.5, false}}) {
    const SiteSelection selection = Select(MakeMap(101, 101, cell_m, Flat()), {}, SiteContext{});
    ASSERT_FALSE(selection.sites.empty());
    EXPECT_EQ(selection.sites.front().confirmed, confirmed) << cell_m;
  }
}

TEST(SiteSelection, PixelIsTheForwardProjection) {
  const SiteContext context = Context();
  for (const LandingSite& site : Select(MakeMap(101, 101, 0.15, Flat())).sites) {
    // Back along the pixel's ray to the ground.
    const PinholeCamera camera = ThesisCamera();
    const Eigen::Vector3d ray =
        context.X_WC.R * Eigen::Vector3d((site.pixel.x() - camera.cx_px) / camera.fx_px,
                                         (site.pixel.y() - camera.cy_px) / camera.fy_px, 1);
    const Eigen::Vector3d ground = context.X_WC.p + ray * (-context.X_WC.p.z() / ray.z());
    EXPECT_NEAR((ground - site.p_WS).norm(), 0, 1e-6);
  }
}

TEST(SiteSelection, SitesKeepTheirSpacingAndOrder) {
  const SiteSelection selection = Select(MakeMap(140, 140, 0.15, WithBox(Flat(), 2, 1, 0.6, 0.7)));
  ASSERT_EQ(selection.sites.size(), 6U);
  for (std::size_t i = 0; i < selection.sites.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE((selection.sites[i].p_WS - selection.sites[j].p_WS).head<2>().norm(), 3.1 - 1e-9);
    }
    if (i > 0) {
      EXPECT_LE(selection.sites[i].safe_distance_m, selection.sites[i - 1].safe_distance_m + 0.07);
    }
  }
}

TEST(SiteSelection, ShiftedWorldShiftsTheSite) {
  const auto world = WithBox(WithBox(Flat(), 2, 3, 0.9, 0.7), -3, -2, 0.9, 0.7);
  const ElevationMap map = MakeMap(100, 100, 0.15, world);
  ElevationMap shifted = map;
  shifted.geometry.north_min_m += 300;
  shifted.geometry.east_min_m -= 150;
  SiteContext context = Context();
  const LandingSite a = Select(map, {}, context).sites.at(0);
  context.p_WB += Eigen::Vector3d(300, -150, 0);
  context.X_WC.p = context.p_WB;
  const LandingSite b = Select(shifted, {}, context).sites.at(0);
  EXPECT_EQ(a.cell, b.cell);
  EXPECT_NEAR((b.p_WS - a.p_WS - Eigen::Vector3d(300, -150, 0)).norm(), 0, 1e-6);
}

TEST(SiteSelection, MirroredWorldMirrorsTheDistance) {
  const auto world = WithBox(WithBox(Flat(), 2, 3, 0.9, 0.7), -3, -2, 0.9, 0.7);
  const auto mirrored = [world](double n, double e) { return world(n, -e); };
  const LandingSite a = Select(MakeMap(100, 100, 0.15, world)).sites.at(0);
  const LandingSite b = Select(MakeMap(100, 100, 0.15, mirrored)).sites.at(0);
  EXPECT_NEAR(a.safe_distance_m, b.safe_distance_m, 1e-6);
}

TEST(SiteSelection, AddingARockMakesNoPlaceSafer) {
  RandomStream random(21, "rocks");
  testing::Height world = Flat();
  HazardMaps before = EvaluateHazards(MakeMap(80, 80, 0.15, world), SladSettings{});
  for (int rock = 0; rock < 8; ++rock) {
    world = WithBox(world, random.Uniform(-5, 5), random.Uniform(-5, 5), 0.45, 0.6);
    const HazardMaps after = EvaluateHazards(MakeMap(80, 80, 0.15, world), SladSettings{});
    for (std::size_t i = 0; i < after.safe_distance_m.cells().size(); ++i) {
      ASSERT_LE(after.safe_distance_m.cells()[i], before.safe_distance_m.cells()[i] + 1e-6F)
          << "seed 21 rock " << rock;
    }
    before = after;
  }
}

TEST(SiteSelection, NoPlaceGivesTheSharesOfTheCauses) {
  const auto nothing = [](double, double) { return std::nan(""); };
  EXPECT_EQ(Select(MakeMap(0, 0, 0.15, nothing)).none_reason, "empty map");
  EXPECT_EQ(Select(MakeMap(30, 30, 0.15, nothing)).none_reason, "100 % unknown");
  EXPECT_EQ(Select(MakeMap(1, 1, 0.15, nothing)).none_reason, "100 % unknown");
  EXPECT_EQ(Select(MakeMap(60, 60, 0.15, testing::Slope(Rad(15), 0))).none_reason, "100 % slope");
  EXPECT_EQ(Select(MakeMap(20, 20, 0.15, Flat())).none_reason,
            "100 % too near a hazard; the map holds a disc 2.850 m across, the lander's clear one "
            "is 4.600 m");
  // One cell of thousands is not none.
  ElevationMap nearly = MakeMap(60, 60, 0.15, testing::Slope(Rad(15), 0));
  nearly.state.at(30, 30) = CellState::kUnknown;
  nearly.height_m.at(30, 30) = kUnknownValue;
  EXPECT_EQ(Select(nearly).none_reason, "100 % slope, under 1 % unknown");
}

TEST(SiteSelection, NoPlaceNamesTheFlagThatMostCellsHave) {
  ElevationMap map = MakeMap(60, 60, 0.15, Flat());
  map.flags = Grid<std::uint8_t>(60, 60, kFlagNoTexture);
  for (int c = 0; c < 60; ++c) {
    map.flags.at(0, c) = kFlagMotion | kFlagShadow;  // shadow forbids nothing
  }
  EXPECT_EQ(Select(map).none_reason, "100 % flagged (no texture)");
}

TEST(SiteSelection, WhereLinesOfUnknownHeightForbidAPlaceAnotherHeadingIsNamed) {
  for (const float top_m : {3.0F, HUGE_VALF}) {
    ElevationMap map = MakeMap(60, 60, 0.15, Flat());
    map.flags = Grid<std::uint8_t>(60, 60, 0);
    map.thin_top_m = GridF(60, 60, kUnknownValue);
    for (int c = 0; c < 60; ++c) {
      map.flags.at(30, c) = kFlagThinStructure;
      map.thin_top_m.at(30, c) = top_m;
    }
    const SiteSelection none = Select(map);
    ASSERT_TRUE(none.sites.empty());
    const std::string words = "another heading";
    EXPECT_EQ(none.none_reason.find(words) != std::string::npos, std::isinf(top_m))
        << none.none_reason;
  }
}

TEST(SiteSelection, NoiseOverTheLimitLeavesTheSiteProvisional) {
  ElevationMap map = MakeMap(100, 100, 0.15, Flat(), 0.04, 2);
  const SiteSelection noisy = Select(map);
  ASSERT_FALSE(noisy.sites.empty());
  EXPECT_FALSE(noisy.sites.front().confirmed);
  EXPECT_NEAR(noisy.sites.front().height_m.three_sigma, 0.12, 0.01);
  const SiteSelection quiet = Select(MakeMap(100, 100, 0.15, Flat(), 0.02, 2));
  ASSERT_FALSE(quiet.sites.empty());
  EXPECT_TRUE(quiet.sites.front().confirmed);
}

TEST(RecheckSite, RockOnTheSiteTakesItsClearance) {
  const SladSettings settings;
  const ElevationMap clear = MakeMap(100, 100, 0.15, Flat());
  const LandingSite site = Select(clear).sites.at(0);
  const ElevationMap rocky =
      MakeMap(100, 100, 0.15, WithBox(Flat(), site.p_WS.x() + 1, site.p_WS.y(), 0.45, 0.6));
  const auto again =
      RecheckSite(rocky, EvaluateHazards(rocky, settings), settings, site, Context());
  ASSERT_TRUE(again);
  EXPECT_LT(again->clearance_m, -1.0);
  EXPECT_NEAR(again->safe_distance_m, 0.8, 0.2);
  LandingSite elsewhere = site;
  elsewhere.p_WS.x() = 500;
  EXPECT_FALSE(
      RecheckSite(clear, EvaluateHazards(clear, settings), settings, elsewhere, Context()));
}

TEST(Slad, FieldOfTablesSeenFromFiftyFeet) {
  // Three tables 0.75 m high; one clear patch. Ten fused frames as at 50 ft, 45 degrees.
  const auto world =
      WithBox(WithBox(WithBox(Flat(), 13, 3, 1.2, 0.75), 18, -3, 1.2, 0.75), 12, -4, 1.2, 0.75);
  TerrainFusion fusion;
  std::shared_ptr<const ElevationMap> map;
  SiteContext context;
  context.p_WB = {0, 0, -15.24};
  context.X_WC = CameraPose(15.24, Rad(45));
  context.camera = ThesisCamera();
  RangeMap range;
  for (std::uint64_t frame = 1; frame <= 10; ++frame) {
    range = SeeWorld(world, context.X_WC, 0.1, frame);
    map = fusion.Add(range, SladSettings{});
  }
  const SladSettings settings;
  const HazardMaps hazards = EvaluateHazards(*map, settings);
  const SiteSelection selection = SelectSites(*map, hazards, settings, context);
  ASSERT_FALSE(selection.sites.empty()) << selection.none_reason;
  for (const LandingSite& site : selection.sites) {
    for (const auto& [n, e] : {std::pair{13.0, 3.0}, {18.0, -3.0}, {12.0, -4.0}}) {
      EXPECT_GT(std::max(std::abs(site.p_WS.x() - n), std::abs(site.p_WS.y() - e)), 0.6 + 1.6);
    }
    EXPECT_LT(Deg(site.slope_rad.value), 1.0);
  }
  // The newest picture has no depth in its left half: what older ones measured stands there.
  for (int y = 0; y < range.depth_m.height(); ++y) {
    for (int x = 0; x < range.depth_m.width() / 2; ++x) {
      range.depth_m.at(x, y) = kUnknownValue;
    }
  }
  const ImageU8 verdict = VerdictImage(range, *map, hazards, 4);
  EXPECT_EQ(verdict.width(), 160);
  const auto verdict_at = [&](const Eigen::Vector3d& p_W) {
    const Eigen::Vector3d p = context.X_WC.Inverse() * p_W;
    return int(verdict.at(int((context.camera.fx_px * p.x() / p.z() + 319.5) / 4),
                          int((context.camera.fy_px * p.y() / p.z() + 239.5) / 4)));
  };
  EXPECT_EQ(verdict_at({13, 3, -0.75}), 2);
  EXPECT_EQ(verdict_at({18, -3, -0.75}), 2);
  EXPECT_EQ(verdict_at({12, -4, -0.75}), 2);
  EXPECT_EQ(verdict_at({15, -1, 0}), 1);
  EXPECT_EQ(verdict_at({16, 1, 0}), 1);
  EXPECT_EQ(verdict_at(selection.sites[0].p_WS), 1);
  EXPECT_EQ(HashOfMaps(*map, hazards), HashOfMaps(*map, EvaluateHazards(*map, settings)));
}

}  // namespace
}  // namespace palace
