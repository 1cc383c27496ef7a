#include "engine/world/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/core/utility.hpp>

namespace palace {
namespace {

using Eigen::Vector3d;
constexpr double kSky = 200;
constexpr double kOffSurface_m = 0.003;  // where a ray to the sun starts

Vector3d RayOf(const PinholeCamera& camera, double x_px, double y_px) {
  return {(x_px - camera.cx_px) / camera.fx_px, (y_px - camera.cy_px) / camera.fy_px, 1};
}

}  // namespace

RayScene::Surfaces RayScene::SurfacesOf(const World& world) {
  Surfaces surfaces;
  surfaces.corners = SolidTriangles(world, kGroundAlbedo);
  std::vector<Vector3d> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  vertices.reserve(surfaces.corners.size());
  for (const MeshVertex& corner : surfaces.corners) {
    vertices.push_back(corner.position_W.cast<double>());
  }
  for (std::uint32_t i = 0; i + 2 < vertices.size(); i += 3) {
    triangles.push_back({i, i + 1, i + 2});
  }
  surfaces.mesh = std::make_unique<TriangleMesh>(std::move(vertices), std::move(triangles));
  return surfaces;
}

RayScene::RayScene(const World& world, double texel_m)
    : world_(world), sun_W_(world.sun.Direction()), grain_(world.ground.texture_seed) {
  World standing = world_;
  standing.solids.clear();
  for (const Solid& solid : world_.solids) {
    if (solid.v_WO.isZero()) {
      standing.solids.push_back(solid);
      continue;
    }
    World alone = world_;
    alone.solids = {solid};
    movers_.push_back(SurfacesOf(alone));
    movers_.back().v_W = solid.v_WO;
  }
  still_ = SurfacesOf(standing);
  ground_ = std::make_unique<GroundPicture>(world_, texel_m,
                                            [&](const Vector3d& p_W) { return StillSees(p_W); });
}

RayScene::Meeting RayScene::Cast(const Vector3d& p_W, const Vector3d& r_W, double time_s) const {
  Meeting first;
  first.s = CastGround(world_.ground, p_W, r_W).s;
  first.ground = std::isfinite(first.s);
  const auto meet = [&](const Surfaces& surfaces, const Vector3d& p, int mover) {
    const TriangleMesh::Meeting met = surfaces.mesh->Cast(p, r_W, first.s);
    if (met.s < first.s) {
      first = {met.s, false, mover, met.triangle};
    }
  };
  meet(still_, p_W, -1);
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    meet(movers_[i], p_W - time_s * movers_[i].v_W, static_cast<int>(i));
  }
  return first;
}

bool RayScene::StillSees(const Vector3d& p_W) const {
  return std::isinf(still_.mesh->Cast(p_W, sun_W_).s) &&
         std::isinf(CastGround(world_.ground, p_W, sun_W_).s);
}

bool RayScene::Sees(const Vector3d& p_W, double time_s, bool movers_only) const {
  const auto hides = [&](const Surfaces& surfaces) {
    return std::isfinite(surfaces.mesh->Cast(p_W - time_s * surfaces.v_W, sun_W_).s);
  };
  return std::none_of(movers_.begin(), movers_.end(), hides) && (movers_only || StillSees(p_W));
}

double RayScene::GreyAt(const Vector3d& p_W, const Vector3d& r_W, const Meeting& meeting,
                        double time_s) const {
  if (std::isinf(meeting.s)) {
    return kSky;
  }
  const Vector3d at = p_W + meeting.s * r_W;
  if (meeting.ground) {
    const double grey = ground_->Grey(at.x(), at.y());
    const Vector3d above = at - Vector3d(0, 0, kOffSurface_m);
    // What stands still has thrown its shadow already.
    const bool darkened = !movers_.empty() && !Sees(above, time_s, true) && StillSees(above);
    return darkened ? grey * ground_->ShareInShadow(at.x(), at.y()) : grey;
  }
  const Surfaces& surfaces =
      meeting.mover < 0 ? still_ : movers_[static_cast<std::size_t>(meeting.mover)];
  const MeshVertex* corner = &surfaces.corners[std::size_t{3} * meeting.triangle];
  const Vector3d a = corner[0].position_W.cast<double>();
  const Vector3d ab = corner[1].position_W.cast<double>() - a;
  const Vector3d ac = corner[2].position_W.cast<double>() - a;
  const Vector3d ap = at - time_s * surfaces.v_W - a;
  const Vector3d n = ab.cross(ac);
  const double area2 = std::max(n.squaredNorm(), 1e-30);
  const double u = ap.cross(ac).dot(n) / area2, v = ab.cross(ap).dot(n) / area2;
  const auto blend = [&](const auto& of_a, const auto& of_b, const auto& of_c) {
    return ((1 - u - v) * of_a.template cast<double>() + u * of_b.template cast<double>() +
            v * of_c.template cast<double>())
        .eval();
  };
  const Vector3d normal =
      blend(corner[0].normal_W, corner[1].normal_W, corner[2].normal_W).normalized();
  const Eigen::Vector2d place =
      blend(corner[0].surface_m, corner[1].surface_m, corner[2].surface_m);
  const bool lit =
      normal.dot(sun_W_) > 0 && Sees(at + kOffSurface_m * normal, time_s, /*movers_only=*/false);
  const double albedo = static_cast<double>(corner[0].albedo) *
                        (1 + SurfaceGrain::kContrast * grain_.At(place.x(), place.y()));
  return std::min(255.0, 255 * albedo * LightOn(world_.sun, normal, lit));
}

ImageF RayScene::Grey(const PinholeCamera& camera, const RigidTransform& X_WC, int samples,
                      double time_s) const {
  ImageF grey(camera.width, camera.height);
  cv::parallel_for_(cv::Range(0, camera.height), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        double sum = 0;
        for (int k = 0; k < samples * samples; ++k) {
          const double dx = (k % samples + 0.5) / samples - 0.5;
          const double dy = (k / samples + 0.5) / samples - 0.5;
          const Vector3d r = X_WC.R * RayOf(camera, x + dx, y + dy);
          sum += GreyAt(X_WC.p, r, Cast(X_WC.p, r, time_s), time_s);
        }
        grey.at(x, y) = static_cast<float>(sum / (samples * samples));
      }
    }
  });
  return grey;
}

ImageF RayScene::Depth(const PinholeCamera& camera, const RigidTransform& X_WC,
                       double time_s) const {
  ImageF depth_m(camera.width, camera.height);
  cv::parallel_for_(cv::Range(0, camera.height), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const Vector3d r = X_WC.R * RayOf(camera, x, y);
        depth_m.at(x, y) = static_cast<float>(Cast(X_WC.p, r, time_s).s);
      }
    }
  });
  return depth_m;
}

}  // namespace palace
