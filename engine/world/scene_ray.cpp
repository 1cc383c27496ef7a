#include "engine/world/scene_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palace {
namespace {

using Eigen::Vector3d;
constexpr double kNone = std::numeric_limits<double>::infinity();

/// The ray in an object's own axes: x along its yaw, y to its right, z UP from its base.
struct LocalRay {
  Vector3d o;
  Vector3d d;
};

LocalRay ToLocal(const Scene& scene, const SceneObject& object, const Vector3d& origin_W,
                 const Vector3d& direction_W) {
  const double c = std::cos(object.yaw_rad), s = std::sin(object.yaw_rad);
  const double base = scene.GroundHeight(object.north_m, object.east_m);
  const double n = origin_W.x() - object.north_m, e = origin_W.y() - object.east_m;
  return {{c * n + s * e, -s * n + c * e, -origin_W.z() - base},
          {c * direction_W.x() + s * direction_W.y(), -s * direction_W.x() + c * direction_W.y(),
           -direction_W.z()}};
}

/// Slab method (Kay & Kajiya 1986).
double HitBox(const LocalRay& ray, const SceneObject& object) {
  const Vector3d low(-object.size_north_m / 2, -object.size_east_m / 2, 0);
  const Vector3d high(object.size_north_m / 2, object.size_east_m / 2, object.height_m);
  double enter = 0, leave = kNone;
  for (int i = 0; i < 3; ++i) {
    if (ray.d[i] == 0) {
      if (ray.o[i] < low[i] || ray.o[i] > high[i]) {
        return kNone;
      }
      continue;
    }
    const double t1 = (low[i] - ray.o[i]) / ray.d[i], t2 = (high[i] - ray.o[i]) / ray.d[i];
    enter = std::max(enter, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
  }
  return enter <= leave ? enter : kNone;
}

/// Nearest root t >= 0 of a t^2 + 2 b t + c for which the height lies in [0, top].
double FirstRootInside(double a, double b, double c, const LocalRay& ray, double top) {
  const double discriminant = b * b - a * c;
  if (discriminant < 0 || std::abs(a) < 1e-12) {
    return kNone;
  }
  const double root = std::sqrt(discriminant);
  double nearest = kNone;
  for (const double t : {(-b - root) / a, (-b + root) / a}) {
    const double z = ray.o.z() + t * ray.d.z();
    if (t >= 0 && z >= 0 && z <= top) {
      nearest = std::min(nearest, t);
    }
  }
  return nearest;
}

/// x^2 + y^2 = r^2 (1 - z/h)^2 for a cone, = r^2 for a cylinder with a lid.
double HitRound(const LocalRay& ray, const SceneObject& object) {
  const double radius = object.size_north_m / 2, height = object.height_m;
  const bool cone = object.shape == SceneShape::kCone;
  const double k = cone ? radius / height : 0;
  const double reach = cone ? radius - k * ray.o.z() : radius;  // radius at the height of o
  const double slope = -k * ray.d.z();                          // its change along the ray
  const double a = ray.d.x() * ray.d.x() + ray.d.y() * ray.d.y() - slope * slope;
  const double b = ray.o.x() * ray.d.x() + ray.o.y() * ray.d.y() - reach * slope;
  const double c = ray.o.x() * ray.o.x() + ray.o.y() * ray.o.y() - reach * reach;
  double nearest = FirstRootInside(a, b, c, ray, height);
  if (!cone && ray.d.z() < 0) {
    const double t = (height - ray.o.z()) / ray.d.z();
    if (t >= 0 && (ray.o + t * ray.d).head<2>().norm() <= radius) {
      nearest = std::min(nearest, t);
    }
  }
  return nearest;
}

bool IsRound(const SceneObject& object) {
  return object.shape == SceneShape::kCone || object.shape == SceneShape::kCylinder;
}

}  // namespace

double CastRay(const Scene& scene, const Vector3d& origin_W, const Vector3d& direction_W,
               double max_range_m) {
  const double tn = std::tan(scene.slope_north_rad), te = std::tan(scene.slope_east_rad);
  const double closing = -direction_W.z() - tn * direction_W.x() - te * direction_W.y();
  const double above = -origin_W.z() - tn * origin_W.x() - te * origin_W.y();
  double nearest = closing < 0 && above >= 0 ? -above / closing : kNone;
  for (const SceneObject& object : scene.objects) {
    const LocalRay ray = ToLocal(scene, object, origin_W, direction_W);
    nearest = std::min(nearest, IsRound(object) ? HitRound(ray, object) : HitBox(ray, object));
  }
  return nearest <= max_range_m ? nearest : std::numeric_limits<double>::quiet_NaN();
}

double SurfaceHeight(const Scene& scene, double north_m, double east_m) {
  double top = scene.GroundHeight(north_m, east_m);
  for (const SceneObject& object : scene.objects) {
    const LocalRay local = ToLocal(scene, object, {north_m, east_m, 0}, Vector3d(0, 0, 1));
    const double base = scene.GroundHeight(object.north_m, object.east_m);
    const double radius = object.size_north_m / 2;
    if (IsRound(object)) {
      const double share = local.o.head<2>().norm() / radius;
      if (share <= 1) {
        const bool cone = object.shape == SceneShape::kCone;
        top = std::max(top, base + object.height_m * (cone ? 1 - share : 1));
      }
    } else if (std::abs(local.o.x()) <= radius && std::abs(local.o.y()) <= object.size_east_m / 2) {
      top = std::max(top, base + object.height_m);
    }
  }
  return top;
}

}  // namespace palace
