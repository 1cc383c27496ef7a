#include "engine/simulation/stereo_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/camera/pinhole.h"
#include "engine/core/random.h"

namespace palace {
namespace {

using Eigen::Vector3d;

struct Hit {
  double depth = std::numeric_limits<double>::infinity();
  double u_m = 0;  ///< texture coordinates
  double v_m = 0;
};

/// Where the ray enters the solid; infinity when it misses (Cyrus & Beck 1978).
double Enter(const Solid& solid, const Vector3d& p, const Vector3d& r) {
  double enter = 0;
  double leave = std::numeric_limits<double>::infinity();
  for (const HalfSpace& face : solid.faces) {
    const double outside = face.normal.dot(p) - face.offset;
    const double rate = face.normal.dot(r);
    if (rate < 0) {
      enter = std::max(enter, -outside / rate);
    } else if (rate > 0) {
      leave = std::min(leave, -outside / rate);
    } else if (outside > 0) {
      return std::numeric_limits<double>::infinity();
    }
  }
  return enter < leave ? enter : std::numeric_limits<double>::infinity();
}

Hit Cast(const StereoWorld& world, const Vector3d& p, const Vector3d& r) {
  Hit hit;
  // Ground: height = slope * north, so -z = slope x.
  const double fall = r.z() + world.slope_north * r.x();
  if (fall > 1e-9) {
    hit.depth = -(p.z() + world.slope_north * p.x()) / fall;
    hit.u_m = p.x() + hit.depth * r.x();
    hit.v_m = p.y() + hit.depth * r.y();
  }
  for (const Solid& solid : world.solids) {
    const double enter = Enter(solid, p, r);
    if (enter < hit.depth) {
      // Slanted over the walls, so that they show texture too; shifted off the ground's.
      const Vector3d q = p + enter * r;
      hit = {enter, q.x() + 0.7 * q.z() + 31, q.y() + 0.7 * q.z() + 17};
    }
  }
  return hit;
}

double GreyOf(const StereoWorld& world, const Hit& hit) {
  constexpr double kSky = 200, kMid = 128;
  if (std::isinf(hit.depth)) {
    return kSky;
  }
  return kMid +
         world.contrast * (GroundGrey(world.texture, hit.u_m, hit.v_m, world.texture_seed) - kMid);
}

/// The pixel's square, `samples` wide, spread by the lens; their sum is 1.
std::vector<double> SampleWeights(int samples) {
  const double sigma = kLensBlur_px * samples;
  const int reach = static_cast<int>(std::ceil(2.5 * sigma));
  std::vector<double> weights(static_cast<std::size_t>(samples + 2 * reach), 0.0);
  double sum = 0;
  for (int k = 0; k < samples; ++k) {
    for (int shift = -reach; shift <= reach; ++shift) {
      const double share = std::exp(-0.5 * shift * shift / (sigma * sigma));
      weights[static_cast<std::size_t>(k + shift + reach)] += share;
      sum += share;
    }
  }
  for (double& weight : weights) {
    weight /= sum;
  }
  return weights;
}

}  // namespace

Solid MakeBox(double north_m, double east_m, double size_north_m, double size_east_m,
              double height_m) {
  return {{{{1, 0, 0}, north_m + size_north_m / 2},
           {{-1, 0, 0}, -(north_m - size_north_m / 2)},
           {{0, 1, 0}, east_m + size_east_m / 2},
           {{0, -1, 0}, -(east_m - size_east_m / 2)},
           {{0, 0, 1}, 0},
           {{0, 0, -1}, height_m}}};
}

Solid MakeWedge(double north_m, double east_m, double length_m, double width_m, double slope_rad) {
  const double foot_m = north_m - length_m / 2;
  const double rise = std::tan(slope_rad);
  Solid wedge = MakeBox(north_m, east_m, length_m, width_m, rise * length_m);
  // Below the ramp: -z <= rise (x - foot).
  wedge.faces.push_back({{-rise, 0, -1}, -rise * foot_m});
  return wedge;
}

double CastDepth(const StereoWorld& world, const Vector3d& p_W, const Vector3d& r_W) {
  return Cast(world, p_W, r_W).depth;
}

ImageF RenderGrey(const StereoWorld& world, const PinholeCamera& camera, const RigidTransform& X_WC,
                  int samples) {
  const std::vector<double> weights = SampleWeights(samples);
  const int reach = (static_cast<int>(weights.size()) - samples) / 2;
  // Samples of the picture and a rim around it; those of one column of pixels are weighted first.
  const int across = camera.width * samples + 2 * reach;
  const int down = camera.height * samples + 2 * reach;
  const auto place = [&](int sample) { return (sample - reach + 0.5) / samples - 0.5; };
  ImageF columns(camera.width, down);
  std::vector<double> line(static_cast<std::size_t>(across));
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < across; ++i) {
      const Vector3d ray = X_WC.R * RayFromPixel(camera, {place(i), place(j)});
      line[static_cast<std::size_t>(i)] = GreyOf(world, Cast(world, X_WC.p, ray));
    }
    for (int x = 0; x < camera.width; ++x) {
      const auto first = line.begin() + static_cast<std::ptrdiff_t>(x) * samples;
      columns.at(x, j) =
          static_cast<float>(std::inner_product(weights.begin(), weights.end(), first, 0.0));
    }
  }
  ImageF grey(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      double sum = 0;
      for (std::size_t k = 0; k < weights.size(); ++k) {
        sum += weights[k] * static_cast<double>(columns.at(x, y * samples + static_cast<int>(k)));
      }
      grey.at(x, y) = static_cast<float>(sum);
    }
  }
  return grey;
}

ImageF RenderDepth(const StereoWorld& world, const PinholeCamera& camera,
                   const RigidTransform& X_WC) {
  ImageF depth_m(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Vector3d ray = RayFromPixel(camera, {static_cast<double>(x), static_cast<double>(y)});
      depth_m.at(x, y) = static_cast<float>(CastDepth(world, X_WC.p, X_WC.R * ray));
    }
  }
  return depth_m;
}

ImageU8 Expose(const ImageF& grey, const Exposure& exposure, std::uint64_t seed) {
  RandomStream random(seed, "sensor");
  ImageU8 picture(grey.width(), grey.height());
  for (std::size_t i = 0; i < grey.pixels().size(); ++i) {
    const double level = exposure.gain * static_cast<double>(grey.pixels()[i]) + exposure.offset +
                         exposure.noise_grey * random.Normal();
    picture.pixels()[i] = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
  }
  return picture;
}

StereoView ViewFrom(const StereoWorld& world, const PinholeCamera& camera, double height_m,
                    double tilt_rad, int samples) {
  StereoView view;
  view.camera = camera;
  view.X_WC.R = CameraRotationFromTilt(tilt_rad);
  view.X_WC.p = {0, 0, -height_m};
  RigidTransform X_WRight = view.X_WC;
  X_WRight.p += view.X_WC.R.col(0) * view.baseline_m;
  view.left_grey = RenderGrey(world, camera, view.X_WC, samples);
  view.right_grey = RenderGrey(world, camera, X_WRight, samples);
  view.depth_m = RenderDepth(world, camera, view.X_WC);
  return view;
}

}  // namespace palace
