// Stereo pairs of textured level ground with boxes on it, and their exact depths.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/camera/pinhole.h"
#include "engine/world/ray_pictures.h"

namespace palace::synthetic {

/// A box standing on the ground, sides along north and east. Metres.
struct Box {
  double north_m = 0;
  double east_m = 0;
  double side_m = 0.5;
  double height_m = 0.1524;
};

struct World {
  std::vector<Box> boxes;
  double slope_north = 0;  ///< rise of the ground per metre north
  std::uint64_t texture_seed = 7;
  double contrast = 1;  ///< 0: no texture at all
};

struct Pair {
  PinholeCamera camera;
  RigidTransform X_WC;
  double baseline_m = 1;
  ImageU8 left;
  ImageU8 right;
  ImageF depth_m;  ///< of the left picture, along the axis
};

/// Camera `height_m` over the origin, tilted (negative down), heading north; 45 degrees wide.
inline Pair MakePair(const World& world, double height_m, double tilt_rad, double noise_grey = 2,
                     double right_gain = 1, double right_offset = 0, int width = 640,
                     int height = 480) {
  palace::World scene;
  scene.ground.texture_seed = world.texture_seed;
  scene.ground.contrast = world.contrast;
  scene.ground.rise_north = world.slope_north;
  for (const Box& box : world.boxes) {
    scene.solids.push_back(MakeBox(box.north_m, box.east_m, box.side_m, box.side_m, box.height_m));
  }
  const StereoView view =
      ViewFrom(scene, PinholeFromFov(width, height, 0.785398163397448), height_m, tilt_rad, 2);
  return {view.camera,
          view.X_WC,
          view.baseline_m,
          Expose(view.left_grey, {noise_grey}, 11),
          Expose(view.right_grey, {noise_grey, right_gain, right_offset}, 12),
          view.depth_m};
}

}  // namespace palace::synthetic
