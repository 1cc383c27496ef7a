#include "engine/experiments/shape_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "engine/core/random.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kInch_m = 0.0254;
constexpr std::array kTextures = {GroundTexture::kGravel, GroundTexture::kGrass,
                                  GroundTexture::kAsphalt, GroundTexture::kCloud};

struct SmallShape {
  const char* name;
  Solid (*make)();  ///< at the origin
};

/// "4 in" is the height; the wide ones are at least 0.30 m wide.
const std::array<SmallShape, 8> kSmallShapes = {{
    {"cube 6 in", [] { return MakeBox(0, 0, 6 * kInch_m, 6 * kInch_m, 6 * kInch_m); }},
    {"square 4 in high 0.30 m", [] { return MakeBox(0, 0, 0.30, 0.30, 4 * kInch_m); }},
    {"cylinder 6 in", [] { return MakeCone(0, 0, 3 * kInch_m, 3 * kInch_m, 6 * kInch_m); }},
    {"rectangle 4 in high 0.30 x 0.60 m", [] { return MakeBox(0, 0, 0.30, 0.60, 4 * kInch_m); }},
    {"cube 4 in", [] { return MakeBox(0, 0, 4 * kInch_m, 4 * kInch_m, 4 * kInch_m); }},
    {"cylinder 4 in high 0.30 m", [] { return MakeCone(0, 0, 0.15, 0.15, 4 * kInch_m); }},
    {"rectangle 6 in high 0.20 x 0.60 m", [] { return MakeBox(0, 0, 0.20, 0.60, 6 * kInch_m); }},
    {"wedge 6 in high 0.40 m",
     [] { return MakeWedge(0, 0, 0.40, 0.40, std::atan(6 * kInch_m / 0.40)); }},
}};

/// Sets solids into the world, turned about their own middle and shifted.
class Builder {
 public:
  explicit Builder(ShapeField& field) : field_(field) {}

  void Add(std::string name, const std::vector<Solid>& solids, double north_m, double east_m,
           double turn_rad, double slope_rad = 0) {
    field_.shapes.push_back(
        {std::move(name), field_.world.solids.size(), solids.size(), slope_rad});
    for (const Solid& solid : solids) {
      field_.world.solids.push_back(Moved(solid, turn_rad, {north_m, east_m, 0}));
    }
  }

 private:
  ShapeField& field_;
};

void PlaceObjects(const HoverView& view, int number, RandomStream& random, Builder& builder) {
  constexpr double kPitch_m = 1.8;
  const GroundInView seen = GroundSeenBy(view);
  const double tall_m = seen.north_max_m - seen.north_min_m - 0.8;
  const double wide_m = seen.east_max_m - seen.east_min_m - 0.8;
  const int rows = std::clamp(static_cast<int>(tall_m / kPitch_m), 1, 3);
  const int cols = std::clamp(static_cast<int>(wide_m / kPitch_m), 1, 4);
  for (int i = 0; i < rows * cols; ++i) {
    const double play_m = 0.2;
    const double north_m =
        seen.north_min_m + 0.4 + (i / cols + 0.5) * tall_m / rows + random.Uniform(-play_m, play_m);
    const double east_m =
        seen.east_min_m + 0.4 + (i % cols + 0.5) * wide_m / cols + random.Uniform(-play_m, play_m);
    const SmallShape& shape =
        kSmallShapes[static_cast<std::size_t>(number * rows * cols + i) % kSmallShapes.size()];
    builder.Add(shape.name, {shape.make()}, north_m, east_m,
                random.Uniform(0, 2 * std::numbers::pi));
  }
}

void PlaceRamp(RandomStream& random, Builder& builder) {
  const double slope_rad = Rad(random.Uniform(3, 15));
  builder.Add("ramp", {MakeWedge(0, 0, 2, 2, slope_rad)}, random.Uniform(-2.4, -2.0),
              random.Uniform(-3.2, -2.8), std::floor(random.Uniform(0, 4)) * std::numbers::pi / 2,
              slope_rad);
}

void PlaceHouse(RandomStream& random, Builder& builder) {
  constexpr double kRoof_m = 2.5, kSide_m = 4, kParapet_m = 0.25, kWall_m = 0.20;
  const double north_m = random.Uniform(-0.4, 0.4), east_m = random.Uniform(1.6, 2.2);
  const double turn_rad = random.Uniform(-0.2, 0.2);
  const auto add = [&](const char* name, const std::vector<Solid>& solids) {
    builder.Add(name, solids, north_m, east_m, turn_rad);
  };
  add("roof", {MakeBox(0, 0, kSide_m, kSide_m, kRoof_m)});
  std::vector<Solid> parapet;
  const double rim_m = (kSide_m - kWall_m) / 2;
  for (const double side : {-rim_m, rim_m}) {
    parapet.push_back(MakeSlab(side, 0, kWall_m, kSide_m, kRoof_m, kRoof_m + kParapet_m));
    parapet.push_back(MakeSlab(0, side, kSide_m, kWall_m, kRoof_m, kRoof_m + kParapet_m));
  }
  add("parapet", parapet);
  const double vent_m = random.Uniform(-1.2, -0.6), other_m = random.Uniform(0.6, 1.2);
  add("vent", {MakeSlab(vent_m, vent_m, 0.4, 0.4, kRoof_m, kRoof_m + 0.35)});
  add("vent", {MakeSlab(other_m, vent_m, 0.4, 0.4, kRoof_m, kRoof_m + 0.35)});
  for (const double place_m : {vent_m, other_m}) {
    add("antenna",
        {MakeRod({place_m, other_m, -kRoof_m}, {place_m, other_m, -kRoof_m - 1.2}, 0.04)});
  }
}

void PlaceTable(RandomStream& random, Builder& builder) {
  constexpr double kTop_m = 0.75;
  std::vector<Solid> table = {MakeSlab(0, 0, 0.8, 1.2, kTop_m - 0.04, kTop_m)};
  for (const double north_m : {-0.35, 0.35}) {
    for (const double east_m : {-0.55, 0.55}) {
      table.push_back(MakeBox(north_m, east_m, 0.05, 0.05, kTop_m));
    }
  }
  builder.Add("table", table, random.Uniform(1.8, 2.4), random.Uniform(-3.2, -2.6),
              random.Uniform(0, 2 * std::numbers::pi));
}

}  // namespace

const char* NameOf(ShapeFieldKind kind) {
  switch (kind) {
    case ShapeFieldKind::kObjects:
      return "objects";
    case ShapeFieldKind::kSlope:
      return "slope";
    case ShapeFieldKind::kHouse:
      return "house";
    case ShapeFieldKind::kPlatform:
      return "platform";
  }
  return "";
}

ShapeField MakeShapeField(ShapeFieldKind kind, const HoverView& view, int number,
                          std::uint64_t seed) {
  RandomStream random(seed, "shape field");
  ShapeField field;
  field.kind = kind;
  field.world.ground.texture = kTextures[static_cast<std::size_t>(random.Index(kTextures.size()))];
  field.world.ground.texture_seed = random.NextBits();
  Builder builder(field);
  switch (kind) {
    case ShapeFieldKind::kObjects:
      PlaceObjects(view, number, random, builder);
      break;
    case ShapeFieldKind::kSlope:
      field.world.ground.rise_north = std::tan(Rad(random.Uniform(0, 7)));
      break;
    case ShapeFieldKind::kHouse:
      PlaceHouse(random, builder);
      PlaceTable(random, builder);
      PlaceRamp(random, builder);
      break;
    case ShapeFieldKind::kPlatform:
      builder.Add("platform", {MakeBox(0, 0, 6.4, 6.4, 1.0)}, random.Uniform(-0.2, 0.2),
                  random.Uniform(1.0, 1.4), random.Uniform(-0.1, 0.1));
      break;
  }
  return field;
}

double DistanceToShape(const ShapeField& field, const PlacedShape& shape, double north_m,
                       double east_m) {
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < shape.solids; ++i) {
    nearest = std::min(
        nearest, DistanceFromAbove(field.world.solids[shape.first_solid + i], north_m, east_m));
  }
  return nearest;
}

double DepthInShape(const ShapeField& field, const PlacedShape& shape, double north_m,
                    double east_m) {
  const Solid& solid = field.world.solids[shape.first_solid];
  const Eigen::Vector3d p_O =
      solid.X_WO.R.transpose() * (Eigen::Vector3d(north_m, east_m, 0) - solid.X_WO.p);
  double depth_m = HUGE_VAL;
  for (const HalfSpace& face : std::get<Polyhedron>(solid.shape).faces) {
    const double level = face.normal.head<2>().norm();
    if (level > 1e-6 && std::abs(face.normal.z()) < 1e-6) {  // a wall
      depth_m = std::min(depth_m, (face.offset - face.normal.head<2>().dot(p_O.head<2>())) / level);
    }
  }
  return std::max(0.0, depth_m);
}

GroundInView GroundSeenBy(const HoverView& view) {
  // Two standard deviations of drift and of the swing of attitude.
  const double swing_m = 2 * std::hypot(view.drift_m, view.attitude_motion_rad * view.height_m);
  const double half_east_m = view.height_m * std::tan(view.field_of_view_rad / 2);
  const double half_north_m = half_east_m * view.height_px / view.width_px;
  return {view.north_m - half_north_m + swing_m, view.north_m + half_north_m - swing_m,
          view.east_m - half_east_m + view.baseline_m + swing_m,
          view.east_m + half_east_m - swing_m};
}

}  // namespace palace
