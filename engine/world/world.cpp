#include "engine/world/world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/core/check.h"

namespace palace {

using Eigen::Vector3d;

double Ground::Height(double north_m, double east_m) const {
  const double plane = rise_north * north_m + rise_east * east_m;
  return relief ? plane + relief->Height(north_m, east_m) : plane;
}

Vector3d Ground::NormalAt(double north_m, double east_m) const {
  if (!relief) {
    return Normal();
  }
  const Vector3d own = relief->Normal(north_m, east_m);
  return Vector3d(own.x() / -own.z() - rise_north, own.y() / -own.z() - rise_east, -1).normalized();
}

const Material& Ground::MaterialAt(double north_m, double east_m) const {
  PALACE_CHECK(material.has_value(), north_m, east_m);
  const auto top = std::find_if(patches.rbegin(), patches.rend(), [&](const GroundPatch& patch) {
    return patch.Contains(north_m, east_m);
  });
  return top != patches.rend() ? top->material : *material;
}

Vector3d Ground::Normal() const { return Vector3d(-rise_north, -rise_east, -1).normalized(); }

Vector3d Sun::Direction() const {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), -std::sin(elevation_rad)};
}

World WorldAt(const World& world, double time_s) {
  World moved = world;
  for (Solid& solid : moved.solids) {
    solid.X_WO.p += time_s * solid.v_WO;
  }
  return moved;
}

Solid StandingOn(const Ground& ground, Shape shape, double north_m, double east_m, double yaw_rad) {
  return {std::move(shape), Upright({north_m, east_m, -ground.Height(north_m, east_m)}, yaw_rad)};
}

namespace {

/// Heights above the plane instead of the origin: a shear, in which rays stay straight.
Vector3d AbovePlane(const Ground& ground, const Vector3d& v) {
  return {v.x(), v.y(), v.z() + ground.rise_north * v.x() + ground.rise_east * v.y()};
}

}  // namespace

Hit CastGround(const Ground& ground, const Vector3d& p_W, const Vector3d& r_W, double clear) {
  const Vector3d p = AbovePlane(ground, p_W), r = AbovePlane(ground, r_W);
  if (ground.relief) {
    return {ground.relief->Cast(p, r, clear)};
  }
  // Height above the plane falls from `above` by `fall` a unit of s.
  const double fall = r.z(), above = -p.z();
  return fall > 1e-9 && above >= 0 ? Hit{above / fall} : Hit{};
}

double ClearOfGround(const Ground& ground, const Beam& beam_W) {
  if (!ground.relief) {
    return 0;
  }
  std::array<Vector3d, 4> edges = beam_W.edges();
  for (Vector3d& edge : edges) {
    edge = AbovePlane(ground, edge);
  }
  return ground.relief->ClearUpTo(Beam(AbovePlane(ground, beam_W.p()), edges));
}

Hit CastRay(const World& world, const Vector3d& p_W, const Vector3d& r_W) {
  Hit hit = CastGround(world.ground, p_W, r_W);
  for (const Solid& solid : world.solids) {
    const double enter = Enter(solid, p_W, r_W);
    if (enter < hit.s) {
      hit = {enter, &solid};
    }
  }
  return hit;
}

double SurfaceHeight(const World& world, double north_m, double east_m) {
  double top = world.ground.Height(north_m, east_m);
  for (const Solid& solid : world.solids) {
    const Vector3d p_O = solid.X_WO.R.transpose() * (Vector3d(north_m, east_m, 0) - solid.X_WO.p);
    top = std::max(top, TopHeight(solid.shape, p_O.x(), p_O.y()) - solid.X_WO.p.z());
  }
  return top;
}

double ObstacleDistance(const World& world, double north_m, double east_m) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Solid& solid : world.solids) {
    nearest = std::min(nearest, DistanceFromAbove(solid, north_m, east_m));
  }
  return nearest;
}

}  // namespace palace
