#include "engine/world/ground_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/core/utility.hpp>

#include "engine/core/check.h"
#include "engine/world/lattice_noise.h"

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr double kAboveGround_m = 0.004;

/// Painters of the ground and of every patch, each remembering its last place.
class Albedos {
 public:
  explicit Albedos(const Ground& ground) : ground_(ground), base_(*ground.material) {
    for (const GroundPatch& patch : ground.patches) {
      painters_.emplace_back(patch.material);
      Eigen::AlignedBox2d box;
      for (const Eigen::Vector2d& corner : patch.outline_m) {
        box.extend(corner);
      }
      boxes_.push_back(box);
    }
  }
  double At(double north_m, double east_m) {
    for (std::size_t i = painters_.size(); i-- > 0;) {
      if (boxes_[i].contains(Eigen::Vector2d(north_m, east_m)) &&
          ground_.patches[i].Contains(north_m, east_m)) {
        return painters_[i].Albedo(north_m, east_m);
      }
    }
    return base_.Albedo(north_m, east_m);
  }

 private:
  const Ground& ground_;
  MaterialPainter base_;
  std::vector<MaterialPainter> painters_;
  std::vector<Eigen::AlignedBox2d> boxes_;
};

/// Index of a texel in a row of them that goes on mirrored.
int Folded(std::int64_t index, int count) {
  const std::int64_t twice = 2 * static_cast<std::int64_t>(count);
  const std::int64_t within = ((index % twice) + twice) % twice;
  return static_cast<int>(within < count ? within : twice - 1 - within);
}

}  // namespace

double LightOn(const Sun& sun, const Vector3d& normal_W, bool lit) {
  return sun.diffuse + (lit ? sun.direct * std::max(0.0, normal_W.dot(sun.Direction())) : 0.0);
}

GroundSquare SquareOf(const Ground& ground) {
  if (!ground.relief) {
    return {-16, -32, 64};
  }
  const HeightField::Place& place = ground.relief->place();
  return {place.north_m, place.east_m, place.size_m};
}

GroundPicture::GroundPicture(const World& world, double texel_m,
                             const std::function<bool(const Vector3d&)>& lit)
    : ground_(world.ground), sun_(world.sun), square_(SquareOf(world.ground)) {
  PALACE_CHECK(ground_.material.has_value() && texel_m > 0, texel_m);
  const int side = static_cast<int>(std::ceil(square_.size_m / texel_m));
  per_texel_ = side / square_.size_m;
  texels_ = ImageU8(side, side);
  const bool sun_is_up = sun_.Direction().z() < 0;
  cv::parallel_for_(cv::Range(0, side), [&](const cv::Range& rows) {
    Albedos albedos(ground_);
    for (int y = rows.start; y < rows.end; ++y) {
      const double north_m = square_.north_m + (y + 0.5) / per_texel_;
      for (int x = 0; x < side; ++x) {
        const double east_m = square_.east_m + (x + 0.5) / per_texel_;
        const Vector3d normal = ground_.NormalAt(north_m, east_m);
        const Vector3d p(north_m, east_m, -ground_.Height(north_m, east_m));
        const bool reached =
            sun_is_up && normal.dot(sun_.Direction()) > 0 && lit(p + kAboveGround_m * normal);
        const double grey = 255 * albedos.At(north_m, east_m) * LightOn(sun_, normal, reached);
        texels_.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
      }
    }
  });
}

double GroundPicture::Grey(double north_m, double east_m) const {
  const double y = (north_m - square_.north_m) * per_texel_ - 0.5;
  const double x = (east_m - square_.east_m) * per_texel_ - 0.5;
  const double fy = FastFloor(y), fx = FastFloor(x);
  const auto i = static_cast<std::int64_t>(fy), j = static_cast<std::int64_t>(fx);
  const double a = y - fy, b = x - fx;
  const int side = texels_.width();
  if (i >= 0 && j >= 0 && i + 1 < side && j + 1 < side) {
    const std::uint8_t* low = texels_.row(static_cast<int>(i)) + j;
    const std::uint8_t* high = low + side;
    return (1 - a) * ((1 - b) * low[0] + b * low[1]) + a * ((1 - b) * high[0] + b * high[1]);
  }
  const auto at = [&](std::int64_t k, std::int64_t l) {
    return static_cast<double>(texels_.at(Folded(j + l, side), Folded(i + k, side)));
  };
  return (1 - a) * ((1 - b) * at(0, 0) + b * at(0, 1)) + a * ((1 - b) * at(1, 0) + b * at(1, 1));
}

double GroundPicture::ShareInShadow(double north_m, double east_m) const {
  const Vector3d normal = ground_.NormalAt(north_m, east_m);
  return sun_.diffuse / LightOn(sun_, normal, true);
}

}  // namespace palace
