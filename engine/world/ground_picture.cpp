#include "engine/world/ground_picture.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <opencv2/core/utility.hpp>

#include "engine/core/check.h"
#include "engine/world/lattice_noise.h"

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr double kAboveGround_m = 0.004;

/// Painters of the ground and of every patch that reaches into a rectangle, each remembering its
/// last place.
class Albedos {
 public:
  Albedos(const Ground& ground, const Eigen::AlignedBox2d& rectangle) : base_(*ground.material) {
    for (const GroundPatch& patch : ground.patches) {
      Eigen::AlignedBox2d box;
      for (const Eigen::Vector2d& corner : patch.outline_m) {
        box.extend(corner);
      }
      if (box.intersects(rectangle)) {
        patches_.push_back({patch, box, MaterialPainter(patch.material)});
      }
    }
  }
  double At(double north_m, double east_m) {
    for (auto top = patches_.rbegin(); top != patches_.rend(); ++top) {
      if (top->box.contains(Eigen::Vector2d(north_m, east_m)) &&
          top->patch.Contains(north_m, east_m)) {
        return top->painter.Albedo(north_m, east_m);
      }
    }
    return base_.Albedo(north_m, east_m);
  }

 private:
  struct Painted {
    const GroundPatch& patch;
    Eigen::AlignedBox2d box;
    MaterialPainter painter;
  };
  MaterialPainter base_;
  std::vector<Painted> patches_;
};

/// The ground's normal, worked out once for each of the relief's triangles met in turn.
class Normals {
 public:
  explicit Normals(const Ground& ground) : ground_(ground), normal_(ground.Normal()) {}
  const Vector3d& At(double north_m, double east_m) {
    if (ground_.relief) {
      const HeightField::Triangle triangle = ground_.relief->TriangleAt(north_m, east_m);
      if (!known_ || !(triangle == last_)) {
        normal_ = ground_.NormalAt(north_m, east_m);
        last_ = triangle;
        known_ = true;
      }
    }
    return normal_;
  }

 private:
  const Ground& ground_;
  Vector3d normal_;
  HeightField::Triangle last_;
  bool known_ = false;
};

/// Index of a texel in a row of them that goes on mirrored.
int Folded(std::int64_t index, int count) {
  const std::int64_t twice = 2 * static_cast<std::int64_t>(count);
  const std::int64_t within = ((index % twice) + twice) % twice;
  return static_cast<int>(within < count ? within : twice - 1 - within);
}

}  // namespace

double LightOn(const Sun& sun, double normal_dot_sun) {
  return sun.diffuse + sun.direct * std::max(0.0, normal_dot_sun);
}

double LightOn(const Sun& sun, const Vector3d& normal_W, bool lit) {
  return LightOn(sun, lit ? normal_W.dot(sun.Direction()) : 0.0);
}

GroundSquare SquareOf(const Ground& ground) {
  if (!ground.relief) {
    return {-16, -32, 64};
  }
  const HeightField::Place& place = ground.relief->place();
  return {place.north_m, place.east_m, place.size_m};
}

GroundPicture::GroundPicture(const World& world, double texel_m,
                             std::function<bool(const Vector3d&)> lit)
    : ground_(world.ground),
      sun_(world.sun),
      sun_W_(world.sun.Direction()),
      lit_(std::move(lit)),
      square_(SquareOf(world.ground)) {
  PALACE_CHECK(ground_.material.has_value() && texel_m > 0, texel_m);
  side_ = static_cast<int>(std::ceil(square_.size_m / texel_m));
  tiles_a_side_ = (side_ + kTile - 1) / kTile;
  per_texel_ = side_ / square_.size_m;
  tiles_ = std::vector<std::atomic<const Tile*>>(static_cast<std::size_t>(tiles_a_side_) *
                                                 static_cast<std::size_t>(tiles_a_side_));
}

GroundPicture::~GroundPicture() {
  for (const std::atomic<const Tile*>& tile : tiles_) {
    delete tile.load(std::memory_order_relaxed);
  }
}

const GroundPicture::Tile& GroundPicture::TileAt(int index) const {
  std::atomic<const Tile*>& kept = tiles_[static_cast<std::size_t>(index)];
  const Tile* tile = kept.load(std::memory_order_acquire);
  if (tile != nullptr) {
    return *tile;
  }
  auto drawn = std::make_unique<const Tile>(Draw(index));
  return kept.compare_exchange_strong(tile, drawn.get()) ? *drawn.release() : *tile;
}

GroundPicture::Tile GroundPicture::Draw(int index) const {
  const int first_x = index % tiles_a_side_ * kTile, first_y = index / tiles_a_side_ * kTile;
  const int end_x = std::min(first_x + kTile, side_), end_y = std::min(first_y + kTile, side_);
  const auto north = [&](int y) { return square_.north_m + (y + 0.5) / per_texel_; };
  const auto east = [&](int x) { return square_.east_m + (x + 0.5) / per_texel_; };
  Albedos albedos(ground_, {Eigen::Vector2d(north(first_y), east(first_x)),
                            Eigen::Vector2d(north(end_y - 1), east(end_x - 1))});
  Normals normals(ground_);
  const bool sun_is_up = sun_W_.z() < 0;
  Tile tile{};
  for (int y = first_y; y < end_y; ++y) {
    const double north_m = north(y);
    for (int x = first_x; x < end_x; ++x) {
      const double east_m = east(x);
      const Vector3d& normal = normals.At(north_m, east_m);
      const double normal_dot_sun = normal.dot(sun_W_);
      const bool reached = sun_is_up && normal_dot_sun > 0 &&
                           lit_(Vector3d(north_m, east_m, -ground_.Height(north_m, east_m)) +
                                kAboveGround_m * normal);
      const double grey =
          255 * albedos.At(north_m, east_m) * LightOn(sun_, reached ? normal_dot_sun : 0.0);
      tile[Within(x, y)] = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
  }
  return tile;
}

ImageU8 GroundPicture::Texels() const {
  ImageU8 texels(side_, side_);
  cv::parallel_for_(cv::Range(0, static_cast<int>(tiles_.size())), [&](const cv::Range& tiles) {
    for (int index = tiles.start; index < tiles.end; ++index) {
      const Tile& tile = TileAt(index);
      const int x = index % tiles_a_side_ * kTile, first_y = index / tiles_a_side_ * kTile;
      for (int y = first_y; y < std::min(first_y + kTile, side_); ++y) {
        std::copy_n(&tile[Within(x, y)], std::min(kTile, side_ - x), texels.row(y) + x);
      }
    }
  });
  return texels;
}

double GroundPicture::Grey(double north_m, double east_m) const {
  const double y = (north_m - square_.north_m) * per_texel_ - 0.5;
  const double x = (east_m - square_.east_m) * per_texel_ - 0.5;
  const double fy = FastFloor(y), fx = FastFloor(x);
  const auto i = static_cast<std::int64_t>(fy), j = static_cast<std::int64_t>(fx);
  const double a = y - fy, b = x - fx;
  if (i >= 0 && j >= 0 && i + 1 < side_ && j + 1 < side_) {
    const int y0 = static_cast<int>(i), x0 = static_cast<int>(j);
    const auto blend = [&](double sw, double se, double nw, double ne) {
      return (1 - a) * ((1 - b) * sw + b * se) + a * ((1 - b) * nw + b * ne);
    };
    const int index = TileOf(x0, y0);
    if (index == TileOf(x0 + 1, y0 + 1)) {
      const std::uint8_t* corner = &TileAt(index)[Within(x0, y0)];
      return blend(corner[0], corner[1], corner[kTile], corner[kTile + 1]);
    }
    return blend(Texel(x0, y0), Texel(x0 + 1, y0), Texel(x0, y0 + 1), Texel(x0 + 1, y0 + 1));
  }
  const auto at = [&](std::int64_t k, std::int64_t l) {
    return static_cast<double>(Texel(Folded(j + l, side_), Folded(i + k, side_)));
  };
  return (1 - a) * ((1 - b) * at(0, 0) + b * at(0, 1)) + a * ((1 - b) * at(1, 0) + b * at(1, 1));
}

double GroundPicture::ShareInShadow(double north_m, double east_m) const {
  const Vector3d normal = ground_.NormalAt(north_m, east_m);
  return sun_.diffuse / LightOn(sun_, normal.dot(sun_W_));
}

}  // namespace palace
