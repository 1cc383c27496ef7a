#include "engine/world/solids.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr int kSides = 24;

/// Distance of flat sides from the axis, so that they lie as far inside the circle as their edges
/// lie outside.
double FlatSideRadius(double radius_m) {
  const double share = std::cos(std::numbers::pi / kSides);
  return radius_m * 2 * share / (1 + share);
}

std::vector<HalfSpace> BoxFaces(double north_m, double east_m, double size_north_m,
                                double size_east_m, double height_m) {
  return {{{1, 0, 0}, north_m + size_north_m / 2},
          {{-1, 0, 0}, -(north_m - size_north_m / 2)},
          {{0, 1, 0}, east_m + size_east_m / 2},
          {{0, -1, 0}, -(east_m - size_east_m / 2)},
          {{0, 0, 1}, 0},
          {{0, 0, -1}, height_m}};
}

std::vector<HalfSpace> ConeFaces(double north_m, double east_m, double foot_radius_m,
                                 double top_radius_m, double height_m) {
  std::vector<HalfSpace> faces = {{{0, 0, 1}, 0}, {{0, 0, -1}, height_m}};
  const double foot = FlatSideRadius(foot_radius_m);
  const double shrink = (foot - FlatSideRadius(top_radius_m)) / height_m;  // per metre of height
  for (int i = 0; i < kSides; ++i) {
    const double azimuth = 2 * std::numbers::pi * i / kSides;
    const double north = std::cos(azimuth), east = std::sin(azimuth);
    // Distance from the axis <= foot - shrink * height, and height = -z.
    faces.push_back({{north, east, -shrink}, foot + north * north_m + east * east_m});
  }
  return faces;
}

Solid MadeOf(std::vector<HalfSpace> faces) { return {MakePolyhedron(std::move(faces))}; }

}  // namespace

RigidTransform Upright(const Vector3d& p_WO, double yaw_rad) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  RigidTransform X_WO;
  X_WO.R << c, -s, 0, s, c, 0, 0, 0, 1;
  X_WO.p = p_WO;
  return X_WO;
}

double Enter(const Solid& solid, const Vector3d& p_W, const Vector3d& r_W) {
  const Eigen::Matrix3d R_OW = solid.X_WO.R.transpose();
  return Enter(solid.shape, R_OW * (p_W - solid.X_WO.p), R_OW * r_W);
}

double DistanceFromAbove(const Solid& solid, double north_m, double east_m) {
  const Vector3d p_O = solid.X_WO.R.transpose() * (Vector3d(north_m, east_m, 0) - solid.X_WO.p);
  return DistanceFromAbove(solid.shape, p_O.x(), p_O.y());
}

Solid MakeBox(double north_m, double east_m, double size_north_m, double size_east_m,
              double height_m) {
  return MadeOf(BoxFaces(north_m, east_m, size_north_m, size_east_m, height_m));
}

Solid MakeSlab(double north_m, double east_m, double size_north_m, double size_east_m,
               double from_m, double to_m) {
  std::vector<HalfSpace> faces = BoxFaces(north_m, east_m, size_north_m, size_east_m, to_m);
  faces.push_back({Vector3d::UnitZ(), -from_m});
  return MadeOf(std::move(faces));
}

Solid MakeWedge(double north_m, double east_m, double length_m, double width_m, double slope_rad) {
  const double foot_m = north_m - length_m / 2;
  const double rise = std::tan(slope_rad);
  std::vector<HalfSpace> faces = BoxFaces(north_m, east_m, length_m, width_m, rise * length_m);
  // Below the ramp: -z <= rise (x - foot).
  faces.push_back({{-rise, 0, -1}, -rise * foot_m});
  return MadeOf(std::move(faces));
}

Solid MakeCone(double north_m, double east_m, double foot_radius_m, double top_radius_m,
               double height_m) {
  return MadeOf(ConeFaces(north_m, east_m, foot_radius_m, top_radius_m, height_m));
}

Solid MakeRod(const Vector3d& from_W, const Vector3d& to_W, double diameter_m) {
  constexpr int kRodSides = 8;
  const Vector3d along = (to_W - from_W).normalized();
  const Vector3d side = along.unitOrthogonal();
  const Vector3d up = along.cross(side);
  std::vector<HalfSpace> faces = {{along, along.dot(to_W)}, {-along, -along.dot(from_W)}};
  for (int i = 0; i < kRodSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRodSides;
    const Vector3d normal = std::cos(angle) * side + std::sin(angle) * up;
    faces.push_back({normal, normal.dot(from_W) + diameter_m / 2});
  }
  return MadeOf(std::move(faces));
}

std::vector<Solid> MakeTrafficCone(double north_m, double east_m, double height_m) {
  constexpr double kFootWidth = 0.5, kFootHeight = 0.05, kBodyWidth = 0.36, kTipWidth = 0.08;
  constexpr double kBlack = 45 / 255.0, kOrange = 150 / 255.0, kWhite = 225 / 255.0;
  constexpr double kCollarFrom = 0.6, kCollarTo = 0.85;  // of the height
  Solid foot = MakeBox(north_m, east_m, kFootWidth * height_m, kFootWidth * height_m,
                       kFootHeight * height_m);
  foot.albedo = kBlack;
  Solid body =
      MakeCone(north_m, east_m, kBodyWidth * height_m / 2, kTipWidth * height_m / 2, height_m);
  body.albedo = kOrange;
  // The collar is a slice of the body, a hair wider.
  std::vector<HalfSpace> faces = ConeFaces(north_m, east_m, kBodyWidth * height_m / 2 + 1e-3,
                                           kTipWidth * height_m / 2 + 1e-3, height_m);
  faces[0].offset = -kCollarFrom * height_m;
  faces[1].offset = kCollarTo * height_m;
  Solid collar = MadeOf(std::move(faces));
  collar.albedo = kWhite;
  return {foot, body, collar};
}

Solid Moved(const Solid& solid, double turn_rad, const Vector3d& shift_W) {
  Solid moved = solid;
  moved.X_WO = Upright(shift_W, turn_rad) * solid.X_WO;
  return moved;
}

}  // namespace palace
