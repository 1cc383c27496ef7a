#include "engine/world/families/drawing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/core/units.h"

namespace palace {

using Eigen::Vector2d;

double Draw(RandomStream& random, const Range& range) {
  return random.Uniform(range.low, range.high);
}

double DrawLog(RandomStream& random, const Range& range) {
  return range.low * std::pow(range.high / range.low, random.Uniform());
}

bool Chance(RandomStream& random, double share) { return random.Uniform() < share; }

double DrawPower(RandomStream& random, const Range& range, double exponent) {
  // The inverse of the share of sizes below x: (1 - (x/low)^-q) / (1 - (high/low)^-q).
  const double cut = 1 - std::pow(range.high / range.low, -exponent);
  return range.low * std::pow(1 - random.Uniform() * cut, -1 / exponent);
}

double DrawAngle(RandomStream& random) { return random.Uniform(0, 2 * std::numbers::pi); }

Vector2d DrawPlace(RandomStream& random) {
  const double north_m = random.Uniform(2, 44);
  return {north_m, random.Uniform(-20, 20)};
}

std::vector<Vector2d> DrawPlaces(RandomStream& random, int count, double apart_m) {
  std::vector<Vector2d> places;
  for (int tries = 0; tries < 20 * count && static_cast<int>(places.size()) < count; ++tries) {
    const Vector2d place = DrawPlace(random);
    if (std::all_of(places.begin(), places.end(), [&](const Vector2d& other) {
          return (other - place).squaredNorm() >= apart_m * apart_m;
        })) {
      places.push_back(place);
    }
  }
  return places;
}

Material DrawMaterial(RandomStream& random, GroundTexture texture, const Range& scale,
                      const Range& contrast) {
  Material material;
  material.texture = texture;
  material.seed = random.NextBits();
  material.scale = Draw(random, scale);
  material.contrast = Draw(random, contrast);
  material.turn_rad = DrawAngle(random);
  return material;
}

Sun DrawSun(RandomStream& random) {
  Sun sun;
  sun.azimuth_rad = DrawAngle(random);
  sun.elevation_rad = Rad(random.Uniform(18, 65));
  sun.direct = random.Uniform(0.35, 0.85);
  // Grey of level ground stays about that of its albedo, as an exposure would have it.
  sun.diffuse =
      std::max(0.12, random.Uniform(0.85, 1.0) - sun.direct * std::sin(sun.elevation_rad));
  return sun;
}

std::shared_ptr<const HeightField> ReliefOf(const std::function<double(double, double)>& height,
                                            int levels, double size_m, double north_m) {
  return std::make_shared<const HeightField>(
      HeightField::Place{north_m - size_m / 2, -size_m / 2, size_m, levels}, height);
}

Solid PutOn(const Ground& ground, Solid solid, const Vector2d& place_m, double turn_rad,
            double sunk_m) {
  const double down_m = sunk_m - ground.Height(place_m.x(), place_m.y());
  return Moved(solid, turn_rad, {place_m.x(), place_m.y(), down_m});
}

void PutOn(World& world, const std::vector<Solid>& solids, const Vector2d& place_m,
           double turn_rad) {
  for (const Solid& solid : solids) {
    world.solids.push_back(PutOn(world.ground, solid, place_m, turn_rad));
  }
}

Solid Painted(Solid solid, double albedo) {
  solid.albedo = albedo;
  return solid;
}

double WallShare(double inside_m, double wall_m) {
  return std::clamp(inside_m / wall_m + 0.5, 0.0, 1.0);
}

Blob::Blob(RandomStream& random, const Vector2d& middle_m, double radius_m, double lobes)
    : middle_m_(middle_m), radius_m_(radius_m), reach_m_(radius_m) {
  for (int waves = 2; waves <= 6; ++waves) {
    const double share = random.Uniform(0, lobes) / (waves - 1.0);
    lobes_.push_back({share, DrawAngle(random)});
    reach_m_ += share * radius_m;
  }
}

double Blob::RadiusAt(double angle_rad) const {
  double share = 1;
  double waves = 2;
  for (const Lobe& lobe : lobes_) {
    share += lobe.share * std::cos(waves * angle_rad + lobe.phase_rad);
    ++waves;
  }
  return radius_m_ * std::max(share, 0.1);
}

double Blob::Inside(double north_m, double east_m) const {
  const double north = north_m - middle_m_.x(), east = east_m - middle_m_.y();
  const double away2 = north * north + east * east;
  constexpr double kFar_m = 1;
  if (away2 > (reach_m_ + kFar_m) * (reach_m_ + kFar_m)) {
    return -kFar_m;
  }
  return RadiusAt(std::atan2(east, north)) - std::sqrt(away2);
}

Blob Blob::Widened(double by_m) const {
  Blob wide = *this;
  wide.radius_m_ += by_m;
  wide.reach_m_ *= wide.radius_m_ / radius_m_;
  return wide;
}

GroundPatch Blob::Patch(const Material& material) const {
  constexpr int kCorners = 48;
  GroundPatch patch{{}, material};
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    patch.outline_m.push_back(middle_m_ +
                              RadiusAt(angle) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return patch;
}

Course::Course(std::vector<Vector2d> corners_m) : corners_m_(std::move(corners_m)) {
  for (const Vector2d& corner : corners_m_) {
    box_.extend(corner);
  }
}

Course::Course(RandomStream& random, const Vector2d& from_m, double heading_rad, double length_m,
               int pieces, double wander_m) {
  const Vector2d along(std::cos(heading_rad), std::sin(heading_rad));
  const Vector2d across(-along.y(), along.x());
  for (int i = 0; i <= pieces; ++i) {
    const double wander = i == 0 ? 0 : random.Uniform(-wander_m, wander_m);
    corners_m_.push_back(from_m + length_m * i / pieces * along + wander * across);
    box_.extend(corners_m_.back());
  }
}

double Course::Distance(double north_m, double east_m) const {
  constexpr double kFar_m = 3;
  const Vector2d place(north_m, east_m);
  if (box_.squaredExteriorDistance(place) > kFar_m * kFar_m) {
    return kFar_m;
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < corners_m_.size(); ++i) {
    const Vector2d along = corners_m_[i + 1] - corners_m_[i], off = place - corners_m_[i];
    const double s = std::clamp(off.dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (off - s * along).squaredNorm());
  }
  return std::sqrt(nearest);
}

void Course::Paint(Ground& ground, double width_m, const Material& material) const {
  for (std::size_t i = 0; i + 1 < corners_m_.size(); ++i) {
    ground.patches.push_back(StripPatch(corners_m_[i], corners_m_[i + 1], width_m, material));
    ground.patches.push_back(
        DiscPatch(corners_m_[i + 1].x(), corners_m_[i + 1].y(), width_m / 2, material));
  }
}

}  // namespace palace
