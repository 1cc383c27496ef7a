#include "engine/world/ray_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/camera/camera_model.h"
#include "engine/camera/pinhole.h"
#include "engine/core/random.h"

namespace palace {
namespace {

using Eigen::Vector3d;

/// A hit and where it lies on the texture, metres.
struct TexturedHit {
  double depth = std::numeric_limits<double>::infinity();
  double u_m = 0;
  double v_m = 0;
  const Solid* solid = nullptr;
};

/// First pixel and the one behind the last.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// A solid and the pixels it may touch.
struct SeenSolid {
  const Solid* solid;
  PixelBox box;
};

TexturedHit GroundHit(const World& world, const Vector3d& p, const Vector3d& r) {
  TexturedHit hit{CastGround(world.ground, p, r).s};
  if (!std::isinf(hit.depth)) {
    hit.u_m = p.x() + hit.depth * r.x();
    hit.v_m = p.y() + hit.depth * r.y();
  }
  return hit;
}

void CastSolid(const Solid& solid, const Vector3d& p, const Vector3d& r, TexturedHit& hit) {
  const double enter = Enter(solid, p, r);
  if (enter < hit.depth) {
    // Slanted over the walls, so that they show texture too; shifted off the ground's.
    const Vector3d q = p + enter * r;
    hit = {enter, q.x() + 0.7 * q.z() + 31, q.y() + 0.7 * q.z() + 17, &solid};
  }
}

constexpr double kMidGrey = 128, kWhite = 255;

double WithContrast(const World& world, double grey) {
  return kMidGrey + world.ground.contrast * (grey - kMidGrey);
}

double GreyOf(const World& world, GroundPainter& painter, const TexturedHit& hit) {
  constexpr double kSky = 200;
  if (std::isinf(hit.depth)) {
    return kSky;
  }
  const double grey = WithContrast(world, painter.Grey(hit.u_m, hit.v_m));
  const bool painted = hit.solid != nullptr && !std::isnan(hit.solid->albedo);
  return painted ? kWhite * hit.solid->albedo + (grey - kMidGrey) / 3 : grey;
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

PixelBox WholePicture(const PinholeCamera& camera) { return {0, 0, camera.width, camera.height}; }

/// Pixels that the solid can colour, the lens's reach included.
PixelBox PixelsOf(const Solid& solid, const PinholeCamera& camera, const RigidTransform& X_WC) {
  constexpr double kReach_px = 2;
  const PixelBox whole = WholePicture(camera);
  const RigidTransform X_CW = X_WC.Inverse();
  Eigen::AlignedBox2d box;
  for (const Vector3d& corner : Bounds(solid.shape)) {
    const auto pixel = ProjectPinhole(camera, X_CW * (solid.X_WO * corner));
    if (!pixel) {
      return whole;
    }
    box.extend(*pixel);
  }
  if (box.isEmpty()) {
    return whole;
  }
  const auto within = [](double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
  };
  return {within(box.min().x() - kReach_px, whole.right),
          within(box.min().y() - kReach_px, whole.bottom),
          within(box.max().x() + kReach_px + 1, whole.right),
          within(box.max().y() + kReach_px + 1, whole.bottom)};
}

std::vector<SeenSolid> SolidsInView(const World& world, const PinholeCamera& camera,
                                    const RigidTransform& X_WC) {
  std::vector<SeenSolid> seen;
  for (const Solid& solid : world.solids) {
    const PixelBox box = PixelsOf(solid, camera, X_WC);
    if (box.left < box.right && box.top < box.bottom) {
      seen.push_back({&solid, box});
    }
  }
  return seen;
}

/// Boxes that overlap are joined, so that no pixel is cast twice.
std::vector<PixelBox> MergedBoxes(const std::vector<SeenSolid>& solids) {
  std::vector<PixelBox> merged;
  for (const SeenSolid& seen : solids) {
    PixelBox box = seen.box;
    for (bool grown = true; grown;) {
      const auto other = std::find_if(merged.begin(), merged.end(), [&](const PixelBox& b) {
        return b.left < box.right && box.left < b.right && b.top < box.bottom && box.top < b.bottom;
      });
      grown = other != merged.end();
      if (grown) {
        box = {std::min(box.left, other->left), std::min(box.top, other->top),
               std::max(box.right, other->right), std::max(box.bottom, other->bottom)};
        merged.erase(other);
      }
    }
    merged.push_back(box);
  }
  return merged;
}

struct View {
  const World& world;
  const PinholeCamera& camera;
  const RigidTransform& X_WC;
  std::vector<SeenSolid> solids;
};

/// Casts samples x samples rays a pixel of the box. `shade(hit)`: grey. `everything`: false leaves
/// pixels that no solid colours as they are.
template <typename Shade>
void CastBox(const View& view, int samples, const PixelBox& box, bool everything, Shade shade,
             ImageF& grey) {
  const std::vector<double> weights = SampleWeights(samples);
  const int reach = (static_cast<int>(weights.size()) - samples) / 2;
  const int width = box.right - box.left, height = box.bottom - box.top;
  // Samples of the box and a rim around it; those of one column of pixels are weighted first.
  const int across = width * samples + 2 * reach;
  const int down = height * samples + 2 * reach;
  const auto place = [&](int first, int sample) {
    return first + (sample - reach + 0.5) / samples - 0.5;
  };
  ImageF columns(width, down);
  ImageU8 touched(width, down);
  std::vector<double> line(static_cast<std::size_t>(across));
  std::vector<std::uint8_t> solid_line(static_cast<std::size_t>(across));
  std::vector<const SeenSolid*> in_row;
  for (int j = 0; j < down; ++j) {
    const double y = place(box.top, j);
    in_row.clear();
    for (const SeenSolid& seen : view.solids) {
      if (y >= seen.box.top - 1 && y <= seen.box.bottom) {
        in_row.push_back(&seen);
      }
    }
    for (int i = 0; i < across; ++i) {
      const double x = place(box.left, i);
      const Vector3d ray = view.X_WC.R * RayFromPixel(view.camera, {x, y});
      TexturedHit hit = GroundHit(view.world, view.X_WC.p, ray);
      for (const SeenSolid* seen : in_row) {
        if (x >= seen->box.left - 1 && x <= seen->box.right) {
          CastSolid(*seen->solid, view.X_WC.p, ray, hit);
        }
      }
      line[static_cast<std::size_t>(i)] = shade(hit);
      solid_line[static_cast<std::size_t>(i)] = hit.solid != nullptr ? 1 : 0;
    }
    for (int x = 0; x < width; ++x) {
      const auto first = static_cast<std::ptrdiff_t>(x) * samples;
      const auto count = static_cast<std::ptrdiff_t>(weights.size());
      columns.at(x, j) = static_cast<float>(
          std::inner_product(weights.begin(), weights.end(), line.begin() + first, 0.0));
      const auto flags = solid_line.begin() + first;
      touched.at(x, j) = std::any_of(flags, flags + count, [](auto flag) { return flag != 0; });
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      bool any = everything;
      for (std::size_t k = 0; k < weights.size(); ++k) {
        const int j = y * samples + static_cast<int>(k);
        sum += weights[k] * static_cast<double>(columns.at(x, j));
        any = any || touched.at(x, j) != 0;
      }
      if (any) {
        grey.at(box.left + x, box.top + y) = static_cast<float>(sum);
      }
    }
  }
}

/// Metres of ground a pixel spans at a place of the picture; infinity at the horizon.
double SampleDistance(const World& world, const PinholeCamera& camera, const RigidTransform& X_WC,
                      double x, double y) {
  const auto at = [&](double px, double py) {
    return GroundHit(world, X_WC.p, X_WC.R * RayFromPixel(camera, {px, py}));
  };
  const TexturedHit centre = at(x, y), right = at(x + 1, y), below = at(x, y + 1);
  if (std::isinf(centre.depth) || std::isinf(right.depth) || std::isinf(below.depth)) {
    return std::numeric_limits<double>::infinity();
  }
  return std::max(std::hypot(right.u_m - centre.u_m, right.v_m - centre.v_m),
                  std::hypot(below.u_m - centre.u_m, below.v_m - centre.v_m));
}

/// Corners of the picture, outer edges.
std::array<Eigen::Vector2d, 4> PictureCorners(const PinholeCamera& camera) {
  const double right = camera.width - 0.5, bottom = camera.height - 0.5;
  return {{{-0.5, -0.5}, {right, -0.5}, {-0.5, bottom}, {right, bottom}}};
}

bool BakedAlike(const World& world, const PinholeCamera& camera, const RigidTransform& X_WC,
                const BakedGround& ground) {
  constexpr double kMostUnlike = 1.25;
  for (const Eigen::Vector2d& corner : PictureCorners(camera)) {
    const double ratio =
        SampleDistance(world, camera, X_WC, corner.x(), corner.y()) / ground.sample_distance_m();
    if (!(ratio < kMostUnlike && ratio > 1 / kMostUnlike)) {
      return false;
    }
  }
  return true;
}

void DrawGround(const View& view, const BakedGround& ground, ImageF& grey) {
  GroundPainter painter(view.world.ground.texture, view.world.ground.texture_seed);
  for (int y = 0; y < view.camera.height; ++y) {
    float* row = grey.row(y);
    const Vector3d first = view.X_WC.R * RayFromPixel(view.camera, {0, static_cast<double>(y)});
    const Vector3d step = view.X_WC.R.col(0) / view.camera.fx_px;
    for (int x = 0; x < view.camera.width; ++x) {
      const TexturedHit hit = GroundHit(view.world, view.X_WC.p, first + x * step);
      const float baked = ground.Grey(hit.u_m, hit.v_m);
      row[x] = static_cast<float>(std::isnan(baked)
                                      ? GreyOf(view.world, painter, hit)
                                      : WithContrast(view.world, static_cast<double>(baked)));
    }
  }
}

}  // namespace

ImageF RenderGrey(const World& world, const PinholeCamera& camera, const RigidTransform& X_WC,
                  int samples) {
  const View view{world, camera, X_WC, SolidsInView(world, camera, X_WC)};
  GroundPainter painter(world.ground.texture, world.ground.texture_seed);
  const auto shade = [&](const TexturedHit& hit) { return GreyOf(world, painter, hit); };
  ImageF grey(camera.width, camera.height);
  CastBox(view, samples, WholePicture(camera), true, shade, grey);
  PaintThings(world.wires, world.pools, camera, X_WC, grey);
  return grey;
}

ImageF DrawGrey(const World& world, const PinholeCamera& camera, const RigidTransform& X_WC,
                const BakedGround& ground) {
  constexpr int kSamples = 4;
  if (!BakedAlike(world, camera, X_WC, ground)) {
    return RenderGrey(world, camera, X_WC, kSamples);
  }
  const View view{world, camera, X_WC, SolidsInView(world, camera, X_WC)};
  ImageF grey(camera.width, camera.height);
  DrawGround(view, ground, grey);
  GroundPainter painter(world.ground.texture, world.ground.texture_seed);
  const auto shade = [&](const TexturedHit& hit) {
    const float baked = hit.solid != nullptr ? std::numeric_limits<float>::quiet_NaN()
                                             : ground.Grey(hit.u_m, hit.v_m);
    return std::isnan(baked) ? GreyOf(world, painter, hit)
                             : WithContrast(world, static_cast<double>(baked));
  };
  for (const PixelBox& box : MergedBoxes(view.solids)) {
    CastBox(view, kSamples, box, false, shade, grey);
  }
  PaintThings(world.wires, world.pools, camera, X_WC, grey);
  return grey;
}

BakedGround BakeFor(const World& world, const PinholeCamera& camera,
                    const std::vector<RigidTransform>& X_WCs) {
  constexpr double kMargin_m = 0.05;
  constexpr double kFarthest_m = 1000;
  TextureRectangle place{kFarthest_m, -kFarthest_m, kFarthest_m, -kFarthest_m};
  double distance_m = std::numeric_limits<double>::infinity();
  for (const RigidTransform& X_WC : X_WCs) {
    const double middle = SampleDistance(world, camera, X_WC, camera.cx_px, camera.cy_px);
    distance_m = std::min(distance_m, middle);
    for (const Eigen::Vector2d& corner : PictureCorners(camera)) {
      const TexturedHit hit = GroundHit(world, X_WC.p, X_WC.R * RayFromPixel(camera, corner));
      if (!std::isinf(hit.depth)) {
        place.u_min_m = std::min(place.u_min_m, hit.u_m - kMargin_m);
        place.u_max_m = std::max(place.u_max_m, hit.u_m + kMargin_m);
        place.v_min_m = std::min(place.v_min_m, hit.v_m - kMargin_m);
        place.v_max_m = std::max(place.v_max_m, hit.v_m + kMargin_m);
      }
    }
  }
  constexpr double kMostPixels = 4e6;  // 140 MB of texels
  const double pixels =
      (place.u_max_m - place.u_min_m) * (place.v_max_m - place.v_min_m) / (distance_m * distance_m);
  const bool seen = std::isfinite(distance_m) && pixels < kMostPixels &&
                    place.u_max_m - place.u_min_m < kFarthest_m &&
                    place.v_max_m - place.v_min_m < kFarthest_m && place.u_min_m < place.u_max_m;
  // Nothing to bake: every look-up falls outside and is worked out in place.
  return seen ? BakedGround(world.ground.texture, world.ground.texture_seed, place, distance_m)
              : BakedGround(world.ground.texture, world.ground.texture_seed, {}, 1);
}

ImageF RenderDepth(const World& world, const PinholeCamera& camera, const RigidTransform& X_WC) {
  ImageF depth_m(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Vector3d ray = RayFromPixel(camera, {static_cast<double>(x), static_cast<double>(y)});
      depth_m.at(x, y) = static_cast<float>(CastRay(world, X_WC.p, X_WC.R * ray).s);
    }
  }
  return depth_m;
}

ImageF RenderDepth(const World& world, const RigCamera& camera, const RigidTransform& X_WC) {
  if (!camera.model) {
    return RenderDepth(world, camera.pinhole, X_WC);
  }
  const Eigen::Matrix3d R_CF = RotationOf(*camera.model);
  ImageF depth_m(WidthOf(*camera.model), HeightOf(*camera.model),
                 std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < depth_m.height(); ++y) {
    for (int x = 0; x < depth_m.width(); ++x) {
      if (const auto ray = RayFromPixelCamera(*camera.model, {x, y})) {
        const Vector3d ray_C = R_CF * ray->direction;
        if (ray_C.z() > 0) {
          depth_m.at(x, y) =
              static_cast<float>(CastRay(world, X_WC.p, X_WC.R * (ray_C / ray_C.z())).s);
        }
      }
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

StereoView ViewFrom(const World& world, const PinholeCamera& camera, double height_m,
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
