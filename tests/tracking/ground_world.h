// A level, textured plane seen by a pinhole camera: pictures with a known truth for tracker tests.
#pragma once

#include <cmath>
#include <vector>

#include "engine/core/frames.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"
#include "engine/tracking/view_geometry.h"

namespace palace {

/// Value noise in octaves from 2.56 m down to 1 cm; octaves finer than a pixel's footprint fade
/// out, as a real lens and sensor would have it.
class GroundWorld {
 public:
  explicit GroundWorld(std::uint64_t seed) : random_(seed, "ground") {
    table_.resize(kTable * kTable);
    for (float& value : table_) {
      value = static_cast<float>(random_.Uniform(-1, 1));
    }
    noise_.resize(kNoise);
    for (float& value : noise_) {
      value = static_cast<float>(random_.Normal());
    }
  }

  ImageU8 Render(const PinholeCamera& camera, const RigidTransform& X_WC, double noise_grey) {
    ImageU8 picture(camera.width, camera.height);
    const std::size_t shift = static_cast<std::size_t>(random_.Index(kNoise / 2));
    std::size_t k = 0;
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x, ++k) {
        const Eigen::Vector3d ray_C = RayFromPixel(camera, Eigen::Vector2d(x, y));
        const Eigen::Vector3d ray_W = X_WC.R * ray_C;
        double grey = 200;
        if (ray_W.z() > 0.02) {
          const double depth_m = -X_WC.p.z() / ray_W.z();
          const Eigen::Vector3d p_W = X_WC.p + depth_m * ray_W;
          grey = 120 + Texture(p_W.x(), p_W.y(), depth_m / camera.fx_px / ray_W.z());
        }
        grey += noise_grey * noise_[(shift + 7919 * (k / 64) + k) % kNoise];
        picture.at(x, y) =
            static_cast<std::uint8_t>(std::lround(std::fmin(std::fmax(grey, 0), 255)));
      }
    }
    return picture;
  }

 private:
  static constexpr int kTable = 256;
  static constexpr int kNoise = 1 << 18;

  double Texture(double north_m, double east_m, double footprint_m) const {
    double sum = 0;
    double wave_m = 2.56;
    for (int octave = 0; octave < 9; ++octave, wave_m /= 2) {
      const double fade = std::fmin(std::fmax(wave_m / footprint_m / 2 - 0.5, 0), 1);
      if (fade <= 0) {
        break;
      }
      sum += 28 * fade * Value(north_m / wave_m + 17.3 * octave, east_m / wave_m + 41.7 * octave);
    }
    return sum;
  }

  double Value(double u, double v) const {
    const double fu = std::floor(u), fv = std::floor(v);
    const int i = static_cast<int>(fu) & (kTable - 1), j = static_cast<int>(fv) & (kTable - 1);
    const int i1 = (i + 1) & (kTable - 1), j1 = (j + 1) & (kTable - 1);
    const double a = Smooth(u - fu), b = Smooth(v - fv);
    const double top = At(i, j) + a * (At(i1, j) - At(i, j));
    const double bottom = At(i, j1) + a * (At(i1, j1) - At(i, j1));
    return top + b * (bottom - top);
  }
  static double Smooth(double t) { return t * t * (3 - 2 * t); }
  double At(int i, int j) const { return double{table_[static_cast<std::size_t>(i * kTable + j)]}; }

  RandomStream random_;
  std::vector<float> table_;
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
