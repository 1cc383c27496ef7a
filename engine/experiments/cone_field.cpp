#include "engine/experiments/cone_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/random.h"

namespace palace {
namespace {

using Eigen::Vector2d;

constexpr std::array kTextures = {GroundTexture::kCloud, GroundTexture::kGravel,
                                  GroundTexture::kGrass, GroundTexture::kAsphalt};
constexpr int kTries = 400;

Vector2d NorthEast(const HoverView& view, const Vector2d& right_forward) {
  const double c = std::cos(view.heading_rad), s = std::sin(view.heading_rad);
  return {c * right_forward.y() - s * right_forward.x(),
          s * right_forward.y() + c * right_forward.x()};
}

Vector2d RandomPlace(RandomStream& random, const Vector2d& half) {
  const double x = random.Uniform(-1, 1), y = random.Uniform(-1, 1);
  return {x * half.x(), y * half.y()};
}

/// Middles of cones, right and forward: apart from each other and out of the clear disc.
std::vector<Vector2d> PlaceCones(RandomStream& random, const Vector2d& half,
                                 const Vector2d& clear_middle, double keep_out_m) {
  constexpr double kApart_m = kTallCone_m;
  std::vector<Vector2d> cones;
  for (int i = 0; i < kTries && cones.size() < kConesInField; ++i) {
    const Vector2d place = RandomPlace(random, half);
    const bool crowded = std::any_of(cones.begin(), cones.end(), [&](const Vector2d& other) {
      return (other - place).norm() < kApart_m;
    });
    if (!crowded && (place - clear_middle).norm() >= keep_out_m) {
      cones.push_back(place);
    }
  }
  return cones;
}

}  // namespace

Vector2d HalfOverlap(const HoverView& view) {
  const double half_m = view.height_m * std::tan(view.field_of_view_rad / 2);
  return {std::max(0.0, half_m - view.baseline_m / 2), half_m * view.height_px / view.width_px};
}

Vector2d RightForward(const ConeField& field, double north_m, double east_m) {
  const double c = std::cos(field.view.heading_rad), s = std::sin(field.view.heading_rad);
  return {c * east_m - s * north_m, s * east_m + c * north_m};
}

ConeField MakeConeField(const ConeFieldPlan& plan, const HoverView& view, std::uint64_t seed) {
  RandomStream random(seed, "cone field");
  ConeField field;
  field.world.ground.texture = kTextures[static_cast<std::size_t>(random.Index(kTextures.size()))];
  field.world.ground.texture_seed = random.NextBits() >> 16;
  field.world.ground.rise_north = std::tan(random.Uniform(0, plan.largest_slope_rad));
  field.view = view;
  field.view.heading_rad = random.Uniform(-std::numbers::pi, std::numbers::pi);
  const Vector2d left_camera = NorthEast(field.view, {-view.baseline_m / 2, 0});
  field.view.north_m = left_camera.x();
  field.view.east_m = left_camera.y();
  const Vector2d half = HalfOverlap(view);
  const Vector2d room = half - Vector2d::Constant(plan.clear_radius_m + plan.margin_m);
  field.disc_fits = room.minCoeff() >= 0;
  const Vector2d clear = RandomPlace(random, room.cwiseMax(0.0));
  field.clear_middle = NorthEast(field.view, clear);
  const double half_foot_m = kTallCone_m / 4 * std::numbers::sqrt2;
  const double keep_out_m = field.disc_fits ? plan.clear_radius_m + plan.margin_m + half_foot_m : 0;
  for (const Vector2d& place : PlaceCones(random, half, clear, keep_out_m)) {
    const Vector2d at = NorthEast(field.view, place);
    const double height_m = field.world.ground.rise_north * at.x();
    const double turn_rad = random.Uniform(0, std::numbers::pi);
    // A little into the ground, so that no gap opens downhill.
    constexpr double kSunk_m = 0.01;
    for (const Solid& part : MakeTrafficCone(0, 0, plan.cone_height_m)) {
      field.world.solids.push_back(Moved(part, turn_rad, {at.x(), at.y(), -(height_m - kSunk_m)}));
    }
  }
  return field;
}

}  // namespace palace
