// A level, textured plane seen by a pinhole camera: pictures with a known truth for tracker tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/frames.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"
#include "engine/tracking/view_geometry.h"

namespace palace {

/// Value noise in three tiles of 4 cm, 1 cm and 2.5 mm cells, each repeating after 1024 cells.
/// Detail finer than a pixel's footprint fades out, as a real lens and sensor would have it.
class GroundWorld {
 public:
  explicit GroundWorld(std::uint64_t seed) : random_(seed, "ground") {
    for (std::size_t i = 0; i < kTiles; ++i) {
      tiles_[i] = MakeTile(i == 0 ? 6 : 2);
    }
    noise_.resize(kNoise);
    for (float& value : noise_) {
      value = static_cast<float>(random_.Normal());
    }
  }

  ImageU8 Render(const PinholeCamera& camera, const RigidTransform& X_WC, float noise_grey) {
    ImageU8 picture(camera.width, camera.height);
    const std::size_t shift = static_cast<std::size_t>(random_.Index(kNoise));
    const Eigen::Matrix3f R = X_WC.R.cast<float>();
    const Eigen::Vector3f p = X_WC.p.cast<float>();
    std::size_t k = shift;
    for (int y = 0; y < camera.height; ++y) {
      const Eigen::Vector3f left = R * RayFromPixel(camera, Eigen::Vector2d(0, y)).cast<float>();
      const Eigen::Vector3f step = R.col(0) / static_cast<float>(camera.fx_px);
      std::uint8_t* row = picture.row(y);
      for (int x = 0; x < camera.width; ++x, ++k) {
        const Eigen::Vector3f ray = left + static_cast<float>(x) * step;
        float grey = 200;
        if (ray.z() > 0.02F) {
          const float depth_m = -p.z() / ray.z();
          const float footprint_m = depth_m / (static_cast<float>(camera.fx_px) * ray.z());
          grey = 120 + Texture(p.x() + depth_m * ray.x(), p.y() + depth_m * ray.y(), footprint_m);
        }
        grey += noise_grey * noise_[(k + 7919 * (k >> 6)) & (kNoise - 1)];
        row[x] = static_cast<std::uint8_t>(std::min(std::max(grey, 0.0F), 255.0F) + 0.5F);
      }
    }
    return picture;
  }

 private:
  static constexpr int kSide = 1024;
  static constexpr std::size_t kTiles = 3;
  static constexpr std::size_t kNoise = 1 << 18;
  static constexpr float kCell_m[kTiles] = {0.04F, 0.01F, 0.0025F};

  /// Octaves of 4, 8, ... cells; periodic.
  std::vector<float> MakeTile(int octaves) {
    std::vector<float> tile(kSide * kSide, 0.0F);
    for (int octave = 0; octave < octaves; ++octave) {
      const int wave = 4 << octave;
      const int count = kSide / wave;
      std::vector<float> knots(static_cast<std::size_t>(count * count));
      for (float& knot : knots) {
        knot = static_cast<float>(random_.Uniform(-28, 28));
      }
      for (int v = 0; v < kSide; ++v) {
        for (int u = 0; u < kSide; ++u) {
          tile[static_cast<std::size_t>(v * kSide + u)] += Knotted(knots, count, wave, u, v);
        }
      }
    }
    return tile;
  }

  static float Knotted(const std::vector<float>& knots, int count, int wave, int u, int v) {
    const int i = u / wave, j = v / wave, i1 = (i + 1) % count, j1 = (j + 1) % count;
    const float a = Smooth(static_cast<float>(u % wave) / static_cast<float>(wave));
    const float b = Smooth(static_cast<float>(v % wave) / static_cast<float>(wave));
    const auto at = [&](int c, int r) { return knots[static_cast<std::size_t>(r * count + c)]; };
    const float top = at(i, j) + a * (at(i1, j) - at(i, j));
    const float bottom = at(i, j1) + a * (at(i1, j1) - at(i, j1));
    return top + b * (bottom - top);
  }
  static float Smooth(float t) { return t * t * (3 - 2 * t); }

  float Texture(float north_m, float east_m, float footprint_m) const {
    float sum = 0;
    for (std::size_t i = 0; i < kTiles; ++i) {
      const float fade = std::min(2 * kCell_m[i] / footprint_m - 0.5F, 1.0F);
      if (fade <= 0) {
        break;
      }
      sum += fade * Sample(tiles_[i], north_m / kCell_m[i], east_m / kCell_m[i]);
    }
    return sum;
  }

  static float Sample(const std::vector<float>& tile, float u, float v) {
    // Moved to positive numbers, where cutting off is rounding down.
    const float pu = u + 64 * kSide, pv = v + 64 * kSide;
    const int iu = static_cast<int>(pu), iv = static_cast<int>(pv);
    const float a = pu - static_cast<float>(iu), b = pv - static_cast<float>(iv);
    const int i = iu & (kSide - 1), i1 = (iu + 1) & (kSide - 1);
    const float* row = tile.data() + (iv & (kSide - 1)) * kSide;
    const float* next = tile.data() + ((iv + 1) & (kSide - 1)) * kSide;
    const float top = row[i] + a * (row[i1] - row[i]);
    const float bottom = next[i] + a * (next[i1] - next[i]);
    return top + b * (bottom - top);
  }

  RandomStream random_;
  std::vector<float> tiles_[kTiles];
  std::vector<float> noise_;
};

/// A descent along a 45 degree slope towards the origin of W, facing north, with attitude motion.
struct Descent {
  double start_height_m = 15;
  double end_height_m = 1.5;
  int frames = 120;
  double side_m = 0;   ///< the site passes off the middle
  double ahead_m = 0;  ///< the camera ends before (negative) or beyond the slope

  /// Camera at frame i; tilt -45 degrees.
  RigidTransform CameraAt(int i) const {
    const double share = static_cast<double>(i) / (frames - 1);
    const double height_m = start_height_m + share * (end_height_m - start_height_m);
    const double t = 0.1 * i;
    const EulerAngles attitude{Rad(1.5 * std::sin(1.9 * t)), Rad(1.2 * std::sin(2.3 * t + 1)),
                               Rad(2.0 * std::sin(0.7 * t))};
    RigidTransform X_WC;
    X_WC.R = RotationFromEuler(attitude) * CameraRotationFromTilt(Rad(-45));
    X_WC.p = {-height_m + share * ahead_m, side_m + 0.05 * std::sin(1.3 * t), -height_m};
    return X_WC;
  }
};

}  // namespace palace
