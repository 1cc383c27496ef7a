// Pictures of textured ground in closed form, for what is measured from pictures and heights
// together: a rig that looks straight down on ground of small relief.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/frames.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/model/image.h"
#include "engine/model/range_map.h"
#include "tests/slad/worlds.h"

namespace palace::testing {

/// Grey of the ground: a sum of waves 6 to 30 cm long, smooth, and known everywhere.
class WavyTexture {
 public:
  WavyTexture(double contrast_grey, std::uint64_t seed) {
    RandomStream random(seed, "texture");
    constexpr int kWaves = 20;
    for (int i = 0; i < kWaves; ++i) {
      const double direction = random.Uniform(0, 2 * std::numbers::pi);
      const double per_m = 2 * std::numbers::pi / random.Uniform(0.06, 0.30);
      waves_.push_back({per_m * std::cos(direction), per_m * std::sin(direction),
                        random.Uniform(0, 2 * std::numbers::pi),
                        contrast_grey * std::sqrt(2.0 / kWaves)});
    }
  }
  double Grey(double north_m, double east_m) const {
    double grey = 128;
    for (const Wave& w : waves_) {
      grey += w.grey * std::sin(w.north * north_m + w.east * east_m + w.phase);
    }
    return grey;
  }

 private:
  struct Wave {
    double north, east, phase, grey;
  };
  std::vector<Wave> waves_;
};

struct TexturedPair {
  ImageU8 left, right;
  RangeMap range;  ///< pose and disparities of the level ground at 0, whatever stands on it
};

/// Both pictures from `height_m` above the origin, `aside_m` east of it, baseline 1 m along the
/// picture's rows, noise of `noise_grey` in each, the right one `gain` times as bright plus
/// `offset`.
inline TexturedPair SeeTexture(const Height& ground, const WavyTexture& texture, double height_m,
                               double noise_grey, std::uint64_t seed, double aside_m = 0,
                               double gain = 1, double offset = 0) {
  constexpr int kWidth = 320, kHeight = 240;
  const PinholeCamera camera{kWidth, kHeight, 300, 300, (kWidth - 1) / 2.0, (kHeight - 1) / 2.0};
  const RigidTransform X_WC{CameraRotationFromTilt(Rad(-90)),
                            Eigen::Vector3d(0, aside_m, -height_m)};
  RandomStream random(seed, "sensor");
  const auto take = [&](double right_m, double by, double plus) {
    ImageU8 picture(kWidth, kHeight);
    const Eigen::Vector3d eye = X_WC.p + right_m * X_WC.R.col(0);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const Eigen::Vector3d ray_W =
            X_WC.R * Eigen::Vector3d((x - camera.cx_px) / camera.fx_px,
                                     (y - camera.cy_px) / camera.fy_px, 1);
        double n = 0, e = 0, depth_m = height_m;
        for (int k = 0; k < 3; ++k) {  // relief is small: the fixed point of looking it up
          n = eye.x() + depth_m * ray_W.x();
          e = eye.y() + depth_m * ray_W.y();
          depth_m = height_m - ground(n, e);
        }
        const double grey = by * texture.Grey(n, e) + plus + noise_grey * random.Normal();
        picture.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
      }
    }
    return picture;
  };
  TexturedPair pair;
  pair.left = take(0, 1, 0);
  pair.right = take(1, gain, offset);
  const double disparity_px = camera.fx_px / height_m;
  pair.range.camera = camera;
  pair.range.baseline_m = 1;
  pair.range.disparity_px = ImageF(kWidth, kHeight, static_cast<float>(disparity_px));
  pair.range.disparity_sigma_px = ImageF(kWidth, kHeight, 0.05F);
  pair.range.depth_m = ImageF(kWidth, kHeight, static_cast<float>(height_m));
  pair.range.depth_sigma_m =
      ImageF(kWidth, kHeight, static_cast<float>(0.05 * height_m / disparity_px));
  pair.range.pose = ViewPose{X_WC};
  return pair;
}

}  // namespace palace::testing
