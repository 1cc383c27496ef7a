#include "engine/world/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <span>
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

template <typename BranchesOf>
RayScene::Meeting RayScene::CastAmong(const Vector3d& p_W, const Vector3d& r_W, double time_s,
                                      double clear_of_ground, BranchesOf&& branches_of) const {
  Meeting first;
  first.s = CastGround(world_.ground, p_W, r_W, clear_of_ground).s;
  first.ground = std::isfinite(first.s);
  for (int mover = -1; mover < static_cast<int>(movers_.size()); ++mover) {
    const Surfaces& surfaces = SurfacesOf(mover);
    const std::span<const std::uint32_t> branches = branches_of(mover);
    if (branches.empty()) {
      continue;
    }
    const Vector3d p = mover < 0 ? p_W : p_W - time_s * surfaces.v_W;
    const TriangleMesh::Meeting met = surfaces.mesh->Cast(branches, p, r_W, first.s);
    if (met.s < first.s) {
      first = {met.s, false, mover, met.triangle};
    }
  }
  return first;
}

RayScene::Meeting RayScene::Cast(const Vector3d& p_W, const Vector3d& r_W, double time_s) const {
  return CastAmong(p_W, r_W, time_s, 0, [&](int mover) { return SurfacesOf(mover).mesh->Whole(); });
}

RayScene::Meeting RayScene::Cast(const Bundle& bundle, const Vector3d& p_W, const Vector3d& r_W,
                                 double time_s) const {
  return CastAmong(p_W, r_W, time_s, bundle.clear_of_ground, [&](int mover) {
    return std::span<const std::uint32_t>(bundle.solids[static_cast<std::size_t>(mover + 1)]);
  });
}

RayScene::Bundle RayScene::BundleOf(const Beam& beam_W, double time_s) const {
  Bundle bundle{ClearOfGround(world_.ground, beam_W), {still_.mesh->Within(beam_W)}};
  for (const Surfaces& mover : movers_) {
    bundle.solids.push_back(mover.mesh->Within(beam_W.From(beam_W.p() - time_s * mover.v_W)));
  }
  return bundle;
}

bool RayScene::StillSees(const Vector3d& p_W) const {
  return !still_.mesh->Meets(p_W, sun_W_) && std::isinf(CastGround(world_.ground, p_W, sun_W_).s);
}

bool RayScene::Sees(const Vector3d& p_W, double time_s, bool movers_only) const {
  const auto hides = [&](const Surfaces& surfaces) {
    return surfaces.mesh->Meets(p_W - time_s * surfaces.v_W, sun_W_);
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
  const Surfaces& surfaces = SurfacesOf(meeting.mover);
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
  const double normal_dot_sun = normal.dot(sun_W_);
  const bool lit =
      normal_dot_sun > 0 && Sees(at + kOffSurface_m * normal, time_s, /*movers_only=*/false);
  const double albedo = static_cast<double>(corner[0].albedo) *
                        (1 + SurfaceGrain::kContrast * grain_.At(place.x(), place.y()));
  return std::min(255.0, 255 * albedo * LightOn(world_.sun, lit ? normal_dot_sun : 0.0));
}

template <typename Visit>
void RayScene::OverPixels(const PinholeCamera& camera, const RigidTransform& X_WC, double time_s,
                          Visit&& visit) const {
  constexpr int kSide = 8;
  constexpr double kAround_px = 0.51;  // of the bundle's outermost pixels, a hair beside their rays
  cv::parallel_for_(cv::Range(0, (camera.height + kSide - 1) / kSide), [&](const cv::Range& rows) {
    for (int top = rows.start * kSide; top < std::min(rows.end * kSide, camera.height);
         top += kSide) {
      for (int left = 0; left < camera.width; left += kSide) {
        const int right = std::min(left + kSide, camera.width);
        const int bottom = std::min(top + kSide, camera.height);
        const double x0 = left - kAround_px, x1 = right - 1 + kAround_px;
        const double y0 = top - kAround_px, y1 = bottom - 1 + kAround_px;
        const Beam beam(X_WC.p, {X_WC.R * RayOf(camera, x0, y0), X_WC.R * RayOf(camera, x1, y0),
                                 X_WC.R * RayOf(camera, x1, y1), X_WC.R * RayOf(camera, x0, y1)});
        const Bundle bundle = BundleOf(beam, time_s);
        for (int y = top; y < bottom; ++y) {
          for (int x = left; x < right; ++x) {
            visit(x, y, bundle);
          }
        }
      }
    }
  });
}

ImageF RayScene::Grey(const PinholeCamera& camera, const RigidTransform& X_WC, int samples,
                      double time_s) const {
  ImageF grey(camera.width, camera.height);
  OverPixels(camera, X_WC, time_s, [&](int x, int y, const Bundle& bundle) {
    double sum = 0;
    for (int k = 0; k < samples * samples; ++k) {
      const double dx = (k % samples + 0.5) / samples - 0.5;
      const double dy = (k / samples + 0.5) / samples - 0.5;
      const Vector3d r = X_WC.R * RayOf(camera, x + dx, y + dy);
      sum += GreyAt(X_WC.p, r, Cast(bundle, X_WC.p, r, time_s), time_s);
    }
    grey.at(x, y) = static_cast<float>(sum / (samples * samples));
  });
  return grey;
}

ImageF RayScene::Depth(const PinholeCamera& camera, const RigidTransform& X_WC,
                       double time_s) const {
  ImageF depth_m(camera.width, camera.height);
  OverPixels(camera, X_WC, time_s, [&](int x, int y, const Bundle& bundle) {
    const Vector3d r = X_WC.R * RayOf(camera, x, y);
    depth_m.at(x, y) = static_cast<float>(Cast(bundle, X_WC.p, r, time_s).s);
  });
  return depth_m;
}

}  // namespace palace
