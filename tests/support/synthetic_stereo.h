// A ray-cast stereo pair of textured level ground with boxes on it, and its exact depths.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/camera/pinhole.h"
#include "engine/core/frames.h"
#include "engine/core/random.h"
#include "engine/model/image.h"

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

struct Hit {
  double depth = std::numeric_limits<double>::infinity();  ///< along the axis; rays have unit depth
  double u = 0;                                            ///< texture coordinates, metres
  double v = 0;
  bool sky() const { return std::isinf(depth); }
};

inline double Lattice(std::int64_t i, std::int64_t j, std::uint64_t seed) {
  std::uint64_t h = seed * 0x9E3779B97F4A7C15ULL +
                    static_cast<std::uint64_t>(i) * 0xBF58476D1CE4E5B9ULL +
                    static_cast<std::uint64_t>(j) * 0x94D049BB133111EBULL;
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
  return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1.0p-53 - 0.5;
}

/// Smooth noise of one wavelength, about -0.5 .. 0.5.
inline double Noise(double u, double v, std::uint64_t seed) {
  const double fu = std::floor(u);
  const double fv = std::floor(v);
  const auto i = static_cast<std::int64_t>(fu);
  const auto j = static_cast<std::int64_t>(fv);
  const auto fade = [](double t) { return t * t * (3 - 2 * t); };
  const double a = fade(u - fu);
  const double b = fade(v - fv);
  return (1 - b) * ((1 - a) * Lattice(i, j, seed) + a * Lattice(i + 1, j, seed)) +
         b * ((1 - a) * Lattice(i, j + 1, seed) + a * Lattice(i + 1, j + 1, seed));
}

/// Grey 0..255 of gravel-like ground: five octaves from 0.8 m to 5 cm.
inline double Texture(const World& world, double u, double v) {
  double grey = 0;
  double wavelength = 0.8;
  for (std::uint64_t octave = 0; octave < 5; ++octave) {
    grey +=
        Noise(u / wavelength, v / wavelength, world.texture_seed + octave) * (octave < 3 ? 60 : 45);
    wavelength /= 2;
  }
  return 128 + world.contrast * grey;
}

/// Nearest hit of the ray p + s r (W axes) with the ground or a box.
inline Hit Cast(const World& world, const Eigen::Vector3d& p, const Eigen::Vector3d& r) {
  Hit hit;
  // Ground: height = slope * north, so -z = slope x.
  const double fall = r.z() + world.slope_north * r.x();
  if (fall > 1e-9) {
    hit.depth = -(p.z() + world.slope_north * p.x()) / fall;
    hit.u = p.x() + hit.depth * r.x();
    hit.v = p.y() + hit.depth * r.y();
  }
  for (const Box& box : world.boxes) {
    const Eigen::Vector3d low(box.north_m - box.side_m / 2, box.east_m - box.side_m / 2,
                              -box.height_m);
    const Eigen::Vector3d high(box.north_m + box.side_m / 2, box.east_m + box.side_m / 2, 0);
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const double a = (low[k] - p[k]) / r[k];
      const double b = (high[k] - p[k]) / r[k];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter < leave && enter < hit.depth) {
      const Eigen::Vector3d q = p + enter * r;
      hit = {enter, q.x() + 0.7 * q.z() + 31, q.y() + 0.7 * q.z() + 17};
    }
  }
  return hit;
}

/// One picture, 2x2 samples a pixel, with Gaussian sensor noise of `noise_grey`.
inline ImageU8 Render(const World& world, const PinholeCamera& camera, const RigidTransform& X_WC,
                      double noise_grey, std::uint64_t seed, double gain = 1, double offset = 0) {
  RandomStream random(seed, "sensor");
  ImageU8 image(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      double grey = 0;
      for (const double dy : {-0.25, 0.25}) {
        for (const double dx : {-0.25, 0.25}) {
          const Hit hit = Cast(world, X_WC.p, X_WC.R * RayFromPixel(camera, {x + dx, y + dy}));
          grey += hit.sky() ? 200 : Texture(world, hit.u, hit.v);
        }
      }
      grey = gain * grey / 4 + offset + noise_grey * random.Normal();
      image.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
  }
  return image;
}

/// Camera `height_m` over the origin, tilted (negative down), heading north.
inline Pair MakePair(const World& world, double height_m, double tilt_rad, double noise_grey = 2,
                     double right_gain = 1, double right_offset = 0, int width = 640,
                     int height = 480) {
  Pair pair;
  pair.camera = PinholeFromFov(width, height, 0.785398163397448);
  pair.X_WC.R = CameraRotationFromTilt(tilt_rad);
  pair.X_WC.p = {0, 0, -height_m};
  RigidTransform X_WRight = pair.X_WC;
  X_WRight.p += pair.X_WC.R.col(0) * pair.baseline_m;
  pair.left = Render(world, pair.camera, pair.X_WC, noise_grey, 11);
  pair.right = Render(world, pair.camera, X_WRight, noise_grey, 12, right_gain, right_offset);
  pair.depth_m = ImageF(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Hit hit = Cast(world, pair.X_WC.p,
                           pair.X_WC.R * RayFromPixel(pair.camera, {static_cast<double>(x),
                                                                    static_cast<double>(y)}));
      pair.depth_m.at(x, y) = static_cast<float>(hit.depth);
    }
  }
  return pair;
}

}  // namespace palace::synthetic
