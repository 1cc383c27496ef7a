// Fast exact rays: what they meet is what single rays meet, and light falls as geometry says.
#include "engine/world/ray_scene.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core/utility.hpp>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/world/lattice_noise.h"
#include "engine/world/scene_library.h"

namespace palace {
namespace {

using Eigen::Vector3d;

World Yard() {
  World world;
  world.ground.material = Material{GroundTexture::kSoil, 3, NAN, 1, 1, 0};
  world.ground.patches = {StripPatch({4, -3}, {20, 3}, 0.2, {GroundTexture::kPaint, 5})};
  world.ground.rise_north = 0.03;
  world.ground.relief = std::make_shared<const HeightField>(
      HeightField::Place{-16, -32, 64, 9}, [](double n, double e) {
        const double hole = std::hypot(n - 14, e - 4) < 0.5 ? -0.4 : 0;
        return 0.05 * FractalNoise(n, e, 11, 6, 0.5, 0.8) + hole;
      });
  world.solids = {StandingOn(world.ground, Box{1.2, 0.8, 0.6}, 12, -2, 0.4),
                  StandingOn(world.ground, Cylinder{0.3, 1.0}, 16, 1)};
  for (Solid& solid : world.solids) {
    solid.albedo = 0.5;
  }
  return world;
}

RigidTransform Over(double height_m) {
  return {CameraRotationFromTilt(Rad(-45)), {0, 0, -height_m}};
}

TEST(RayScene, MeetsWhatSingleRaysMeet) {
  const World world = Yard();
  const RayScene scene(world, 0.1);
  RandomStream random(4);
  int on_solids = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d p(0, 0, -15);
    const Vector3d r(random.Uniform(0.6, 1.4), random.Uniform(-0.4, 0.4), 1);
    const Hit expected = CastRay(world, p, r);
    const RayScene::Meeting met = scene.Cast(p, r);
    on_solids += met.ground ? 0 : 1;
    // The cylinder is of 40 flat sides.
    ASSERT_NEAR(met.s, expected.s, 0.02) << r.transpose();
  }
  EXPECT_GT(on_solids, 20);
}

TEST(RayScene, AShadowFallsWhereTheSunSays) {
  World world;
  world.ground.material = Material{GroundTexture::kPaint, 5, 0.5, 0, 1, 0};
  world.sun.azimuth_rad = Rad(180);  // from the south: shadows to the north
  world.sun.elevation_rad = Rad(45);
  world.solids = {StandingOn(world.ground, Box{1, 1, 2}, 10, 0)};
  const RayScene scene(world, 0.05);
  const double in_sun = 127.5 * (0.5 + 0.7 * std::sin(Rad(45))), in_shade = 127.5 * 0.5;
  struct Place {
    double north_m, east_m, grey;
  };
  for (const Place& place :
       {Place{10.5 + 1.9, 0, in_shade}, Place{10.5 + 2.1, 0, in_sun}, Place{11.5, 0.4, in_shade},
        Place{11.5, 0.6, in_sun}, Place{9, 0, in_sun}}) {
    EXPECT_NEAR(scene.ground().Grey(place.north_m, place.east_m), place.grey, 1)
        << place.north_m << " " << place.east_m;
  }
}

TEST(RayScene, WhatMovesThrowsItsShadowWhereItIs) {
  World world;
  world.ground.material = Material{GroundTexture::kPaint, 5, 0.5, 0, 1, 0};
  world.sun.azimuth_rad = Rad(180);
  world.sun.elevation_rad = Rad(45);
  world.solids = {StandingOn(world.ground, Box{1, 1, 1}, 10, 0)};
  world.solids[0].v_WO = {0, 2, 0};
  const RayScene scene(world, 0.05);
  PinholeCamera camera;
  camera.width = camera.height = 1;
  camera.fx_px = camera.fy_px = 1000;
  // Straight down on the shadow of t = 0 and on that of t = 3 s.
  const auto grey = [&](double east_m, double time_s) {
    const RigidTransform X_WC{CameraRotationFromTilt(Rad(-90)), {11.2, east_m, -10}};
    return static_cast<double>(scene.Grey(camera, X_WC, 1, time_s).at(0, 0));
  };
  EXPECT_LT(grey(0, 0), 70);
  EXPECT_GT(grey(0, 3), 100);
  EXPECT_LT(grey(6, 3), 70);
  EXPECT_GT(grey(6, 0), 100);
}

TEST(RayScene, PicturesMeetWhatTheirRaysMeetAlone) {
  World world = Yard();
  world.solids.push_back(StandingOn(world.ground, Box{0.5, 0.5, 1.5}, 9, 1));
  world.solids.back().v_WO = {0.5, -1, 0};
  const RayScene scene(world, 0.1);
  PinholeCamera camera;
  camera.width = 93, camera.height = 61;  // the last bundles of pixels are narrower
  camera.fx_px = camera.fy_px = 70;
  camera.cx_px = 46, camera.cy_px = 30;
  for (const double tilt_deg : {-90.0, -45.0, -20.0}) {
    const RigidTransform X_WC{CameraRotationFromTilt(Rad(tilt_deg)), {8, 0, -7}};
    const ImageF depth_m = scene.Depth(camera, X_WC, 0.7);
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const Vector3d ray((x - camera.cx_px) / camera.fx_px, (y - camera.cy_px) / camera.fy_px, 1);
        const double alone = scene.Cast(X_WC.p, X_WC.R * ray, 0.7).s;
        ASSERT_EQ(depth_m.at(x, y), static_cast<float>(alone)) << tilt_deg << " " << x << " " << y;
      }
    }
  }
}

TEST(RayScene, PicturesAreTheSameOnOneThreadAndOnTwo) {
  const int before = cv::getNumThreads();
  const World world = Yard();
  PinholeCamera camera = DefaultRig().left.pinhole;
  camera.width = 160, camera.height = 120;
  camera.fx_px = camera.fy_px = 193;
  camera.cx_px = 79.5, camera.cy_px = 59.5;
  std::vector<ImageF> pictures;
  for (const int threads : {1, 2}) {
    cv::setNumThreads(threads);
    const RayScene scene(world, 0.05);
    pictures.push_back(scene.Grey(camera, Over(12), 2));
    pictures.push_back(scene.Depth(camera, Over(12)));
  }
  cv::setNumThreads(before);
  EXPECT_EQ(pictures[0].pixels(), pictures[2].pixels());
  EXPECT_EQ(pictures[1].pixels(), pictures[3].pixels());
}

TEST(Materials, HaveTheMeansThatAreSaid) {
  for (int i = 0; i < kGroundTextures; ++i) {
    const auto texture = static_cast<GroundTexture>(i);
    GroundPainter painter(texture, 12);
    double sum = 0;
    int count = 0;
    for (double u = 0; u < 12; u += 0.0371) {
      for (double v = 0; v < 12; v += 0.0413) {
        sum += painter.Grey(u, v);
        ++count;
      }
    }
    EXPECT_NEAR(sum / count, MeanGrey(texture), 3) << NameOf(texture);
  }
}

}  // namespace
}  // namespace palace
