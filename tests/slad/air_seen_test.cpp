// How far up over the ground the cameras have looked: closed form, slow reference, what is kept.
#include "engine/slad/terrain/air_seen.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/slad/terrain/fusion.h"
#include "tests/slad/seen_from_the_south.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::CameraPose;
using testing::Flat;
using testing::MakeMap;
using testing::ThesisCamera;

GridF AirOver(const ElevationMap& map, const RigidTransform& X_WC) {
  GridF air(map.geometry.rows, map.geometry.cols, kUnknownValue);
  AddAirSeen(ThesisCamera(), X_WC, map, air);
  return air;
}

// The upper edge of the picture is half the field of view above the axis; up the line over where
// the axis meets the ground the depth falls by the sine of the tilt a metre.
TEST(AirSeen, OnTheMiddleLineItIsWhatTheUpperEdgeOrTheNearestDepthLeaves) {
  const PinholeCamera camera = ThesisCamera();
  const double half_rad = std::atan((camera.cy_px + 0.5) / camera.fy_px);
  const ElevationMap map = MakeMap(201, 201, 0.15, Flat());
  for (const double height_m : {4.0, 6.0, 15.24}) {
    for (const double tilt_deg : {30.0, 45.0, 60.0}) {
      const double back_m = -height_m / std::tan(Rad(tilt_deg));
      const RigidTransform X_WC = CameraPose(height_m, Rad(tilt_deg), back_m);
      // The axis meets the ground in the middle of the map.
      const GridF air = AirOver(map, X_WC);
      const double edge_rad = Rad(tilt_deg) - half_rad, sine = std::sin(Rad(tilt_deg));
      const double in_view_m = height_m + back_m * std::tan(edge_rad);
      const double not_near_m = (height_m / sine - kNearestThin_m) / sine;
      EXPECT_NEAR(static_cast<double>(air.at(100, 100)), std::min(in_view_m, not_near_m), 1e-3)
          << height_m << " m, " << tilt_deg << " deg";
    }
  }
}

// Slow reference: up the line over a cell, a centimetre at a time, while it stays in the picture.
TEST(AirSeen, IsWhereTheLineOverACellLeavesThePicture) {
  const std::uint64_t seed = 11;
  RandomStream random(seed, "air seen");
  const PinholeCamera camera = ThesisCamera();
  const ElevationMap map = MakeMap(41, 41, 0.5, testing::Slope(Rad(8), 0.7));
  int compared = 0;
  for (int view = 0; view < 12; ++view) {
    const EulerAngles turned{random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2),
                             random.Uniform(-3, 3)};
    const RigidTransform X_WC =
        CameraPose(random.Uniform(5, 20), random.Uniform(0.5, 1.5), random.Uniform(-9, 0), turned);
    const GridF air = AirOver(map, X_WC);
    const auto in_view = [&](const Eigen::Vector3d& p_W) {
      const Eigen::Vector3d p_C = X_WC.Inverse() * p_W;
      const double x = camera.fx_px * p_C.x() / p_C.z() + camera.cx_px;
      const double y = camera.fy_px * p_C.y() / p_C.z() + camera.cy_px;
      return p_C.z() >= kNearestThin_m && x >= -0.5 && x <= camera.width - 0.5 && y >= -0.5 &&
             y <= camera.height - 0.5;
    };
    for (int r = 0; r < 41; ++r) {
      for (int c = 0; c < 41; ++c) {
        Eigen::Vector3d p_W(map.geometry.NorthOfRow(r), map.geometry.EastOfCol(c),
                            -static_cast<double>(map.height_m.at(r, c)));
        if (!in_view(p_W)) {
          continue;
        }
        while (in_view(p_W) && p_W.z() > X_WC.p.z()) {
          p_W.z() -= 0.01;
        }
        EXPECT_NEAR(static_cast<double>(air.at(r, c)), -p_W.z(), 0.011)
            << "seed " << seed << " view " << view << " cell " << r << " " << c;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1000) << "of 12 views of 1681 cells";
}

// Straight down the whole picture may be too near for a wire.
TEST(AirSeen, WhatComesNearerThanThinThingsAreLookedForWasNotSeen) {
  const ElevationMap map = MakeMap(21, 21, 0.15, Flat());
  for (const double height_m : {5.0, 8.0, 11.0, 15.0}) {
    const GridF air = AirOver(map, CameraPose(height_m, Rad(90), 0));
    EXPECT_NEAR(static_cast<double>(air.at(10, 10)), height_m - kNearestThin_m, 1e-3) << height_m;
  }
}

TEST(AirSeen, TheHighestLookIsKept) {
  const ElevationMap map = MakeMap(101, 101, 0.15, Flat());
  GridF air(101, 101, kUnknownValue);
  const auto look = [&](double height_m) {
    AddAirSeen(ThesisCamera(), CameraPose(height_m, Rad(45), -height_m), map, air);
    return static_cast<double>(air.at(50, 50));
  };
  const double low = look(6);
  const double high = look(15);
  EXPECT_GT(high, low + 3);
  EXPECT_EQ(look(6), high);
}

// Two looks through the whole way of a map: from above, then from 6 m.
TEST(AirSeen, AMapRemembersTheLookFromAbove) {
  const auto air_of_site = [](const std::vector<double>& heights_m) {
    TerrainFusion fusion;
    const SladSettings settings;
    std::shared_ptr<const ElevationMap> map;
    for (const double height_m : heights_m) {
      for (int frame = 0; frame < 3; ++frame) {
        map = fusion.Add(testing::SeeWorld(Flat(), CameraPose(height_m, Rad(45), -height_m), 0.05,
                                           static_cast<std::uint64_t>(frame + 1)),
                         settings, Eigen::Vector2d(0, 0));
      }
    }
    const auto site = RecheckSite(*map, EvaluateHazards(*map, settings), settings, LandingSite{},
                                  testing::Context());
    return site ? site->air_seen_m : NAN;
  };
  // Nine tenths of the disc lie 4.2 m ahead or farther: 7 m deep 0.3 m over the ground there.
  EXPECT_NEAR(air_of_site({6}), 0.3, 0.2);
  EXPECT_GT(air_of_site({15, 6}), 6);
}

TEST(AirSeen, NobodyAskedASurvey) {
  const ElevationMap map = MakeMap(101, 101, 0.15, Flat());
  const SladSettings settings;
  const auto site =
      RecheckSite(map, EvaluateHazards(map, settings), settings, LandingSite{}, testing::Context());
  ASSERT_TRUE(site);
  EXPECT_TRUE(std::isnan(site->air_seen_m));
}

}  // namespace
}  // namespace palace
