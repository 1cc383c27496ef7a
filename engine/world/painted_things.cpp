#include "engine/world/painted_things.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/camera/pinhole.h"
#include "engine/world/baked_ground.h"

namespace palace {
namespace {

using Eigen::Vector3d;

double NormalShare(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

Vector3d Ray(const PinholeCamera& camera, int x, int y) {
  return RayFromPixel(camera, {static_cast<double>(x), static_cast<double>(y)});
}

}  // namespace

void PaintWire(const PaintedWire& wire, const PinholeCamera& camera, const RigidTransform& X_WC,
               ImageF& grey) {
  constexpr double kNearest_m = 0.1, kReach_px = 3;
  const double spread_px = std::sqrt(kLensBlur_px * kLensBlur_px + 1.0 / 12);
  const RigidTransform X_CW = X_WC.Inverse();
  const Vector3d from = X_CW * wire.from_W;
  const Vector3d along = X_CW * wire.to_W - from;
  for (int y = 0; y < grey.height(); ++y) {
    for (int x = 0; x < grey.width(); ++x) {
      // The wire's point nearest to the pixel's ray.
      const Vector3d ray = Ray(camera, x, y).normalized();
      const double across2 = along.squaredNorm() - std::pow(along.dot(ray), 2);
      if (across2 < 1e-12) {
        continue;
      }
      const double t = (from.dot(ray) * along.dot(ray) - from.dot(along)) / across2;
      const Vector3d p = from + std::clamp(t, 0.0, 1.0) * along;
      const double range_m = p.dot(ray);
      if (range_m < kNearest_m) {
        continue;
      }
      const double px_per_m = camera.fx_px / range_m;
      const double off_px = (p - range_m * ray).norm() * px_per_m;
      const double radius_px = wire.diameter_m / 2 * px_per_m;
      if (off_px > radius_px + kReach_px) {
        continue;
      }
      const double share = NormalShare((off_px + radius_px) / spread_px) -
                           NormalShare((off_px - radius_px) / spread_px);
      float& value = grey.at(x, y);
      value += static_cast<float>(share * (wire.grey - static_cast<double>(value)));
    }
  }
}

void PaintPool(const PaintedPool& pool, const PinholeCamera& camera, const RigidTransform& X_WC,
               ImageF& grey) {
  for (int y = 0; y < grey.height(); ++y) {
    for (int x = 0; x < grey.width(); ++x) {
      const Vector3d ray = X_WC.R * Ray(camera, x, y);
      if (!(ray.z() > 0)) {
        continue;
      }
      const Vector3d p = X_WC.p - X_WC.p.z() / ray.z() * ray;
      if (std::hypot(p.x() - pool.north_m, p.y() - pool.east_m) < pool.radius_m) {
        grey.at(x, y) = static_cast<float>(pool.grey);
      }
    }
  }
}

void PaintThings(const std::vector<PaintedWire>& wires, const std::vector<PaintedPool>& pools,
                 const PinholeCamera& camera, const RigidTransform& X_WC, ImageF& grey) {
  for (const PaintedWire& wire : wires) {
    PaintWire(wire, camera, X_WC, grey);
  }
  for (const PaintedPool& pool : pools) {
    PaintPool(pool, camera, X_WC, grey);
  }
}

}  // namespace palace
