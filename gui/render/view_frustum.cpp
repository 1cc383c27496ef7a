#include "gui/render/view_frustum.h"

#include <algorithm>
#include <optional>

namespace palace {
namespace {

constexpr int kColumns = 24, kRows = 16;
constexpr int kHalvings = 14;  // of a column, to where its rays last meet ground
constexpr double kNoGround_m = 20;
constexpr double kLift_m = 1;

constexpr Rgba8 kSeen = RgbaFromHex(0xE23B3B, 84), kSeenEdge = RgbaFromHex(0xFF5A5A);
constexpr Rgba8 kFace = RgbaFromHex(0xE8ECF1, 20), kEdge = RgbaFromHex(0xE8ECF1, 190);

/// Rays of one picture onto the ground; u and v run from 0 to 1 over it.
struct Caster {
  const Ground& ground;
  const PinholeCamera& camera;
  const RigidTransform& X_WC;

  Eigen::Vector3d Direction(double u, double v) const {
    const double x_px = u * camera.width - 0.5, y_px = v * camera.height - 0.5;
    const Eigen::Vector3d r_C((x_px - camera.cx_px) / camera.fx_px,
                              (y_px - camera.cy_px) / camera.fy_px, 1);
    return (X_WC.R * r_C).normalized();
  }
  std::optional<Eigen::Vector3d> Meet(double u, double v) const {
    const Eigen::Vector3d r_W = Direction(u, v);
    const double s = CastGround(ground, X_WC.p, r_W).s;
    return s <= ViewFrustum::kReach_m ? std::optional<Eigen::Vector3d>(X_WC.p + s * r_W)
                                      : std::nullopt;
  }
  /// Ground of a column of the picture from its highest ray that meets some to its lowest; empty
  /// where the lowest meets none.
  std::vector<Eigen::Vector3d> Column(double u) const {
    std::vector<Eigen::Vector3d> points;
    if (!Meet(u, 1)) {
      return points;
    }
    double top = 0;
    if (!Meet(u, 0)) {
      double misses = 0, meets = 1;
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = (misses + meets) / 2;
        (Meet(u, middle) ? meets : misses) = middle;
      }
      top = meets;
    }
    for (int k = 0; k <= kRows; ++k) {
      if (const auto p_W = Meet(u, top + (1 - top) * k / kRows)) {
        points.push_back(*p_W);
      }
    }
    return points;
  }
};

/// As many points as the fuller of two neighbours: a ridge may have swallowed one.
void AddStrip(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b,
              ViewFrustum& frustum) {
  for (std::size_t k = 1; k < std::min(a.size(), b.size()); ++k) {
    frustum.patch_W.push_back({a[k - 1], a[k], b[k]});
    frustum.patch_W.push_back({a[k - 1], b[k], b[k - 1]});
  }
}

}  // namespace

ViewFrustum CastFrustum(const Ground& ground, const PinholeCamera& camera,
                        const RigidTransform& X_WC) {
  const Caster caster{ground, camera, X_WC};
  ViewFrustum frustum;
  frustum.apex_W = X_WC.p;
  std::vector<std::vector<Eigen::Vector3d>> columns;
  for (int i = 0; i <= kColumns; ++i) {
    columns.push_back(caster.Column(static_cast<double>(i) / kColumns));
  }
  std::vector<Eigen::Vector3d> back;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i > 0) {
      AddStrip(columns[i - 1], columns[i], frustum);
    }
    if (!columns[i].empty()) {
      frustum.outline_W.push_back(columns[i].front());
      back.push_back(columns[i].back());
    }
  }
  const auto end = [&](std::size_t column, bool top, double u) -> Eigen::Vector3d {
    const std::vector<Eigen::Vector3d>& points = columns[column];
    return points.empty() ? X_WC.p + kNoGround_m * caster.Direction(u, top ? 0 : 1)
                          : (top ? points.front() : points.back());
  };
  frustum.corners_W = {end(0, true, 0), end(kColumns, true, 1), end(kColumns, false, 1),
                       end(0, false, 0)};
  frustum.outline_W.insert(frustum.outline_W.end(), back.rbegin(), back.rend());
  if (!frustum.outline_W.empty()) {
    frustum.outline_W.push_back(frustum.outline_W.front());
  }
  return frustum;
}

void AddSeenGround(LineBatch& batch, const ViewFrustum& frustum, const Eigen::Vector3d& eye_W,
                   double ui_scale) {
  const auto lifted = [&](const Eigen::Vector3d& p_W) -> Eigen::Vector3d {
    const Eigen::Vector3d to_eye = eye_W - p_W;
    return p_W + std::min(kLift_m / to_eye.norm(), 0.5) * to_eye;
  };
  for (const auto& [a, b, c] : frustum.patch_W) {
    batch.Triangle(lifted(a), lifted(b), lifted(c), kSeen);
  }
  std::vector<Eigen::Vector3d> outline;
  for (const Eigen::Vector3d& p_W : frustum.outline_W) {
    outline.push_back(lifted(p_W));
  }
  batch.Polyline(outline, {kSeenEdge, 1.4 * ui_scale});
}

void AddFrustumBody(LineBatch& batch, const ViewFrustum& frustum, double ui_scale) {
  const std::vector<Eigen::Vector3d>& rim = frustum.outline_W;
  for (std::size_t i = 1; i < rim.size(); ++i) {
    batch.Triangle(frustum.apex_W, rim[i - 1], rim[i], kFace);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d& corner = frustum.corners_W[i];
    if (rim.empty()) {
      batch.Triangle(frustum.apex_W, corner, frustum.corners_W[(i + 1) % 4], kFace);
    }
    batch.Line(frustum.apex_W, corner, {kEdge, 1.2 * ui_scale});
  }
}

}  // namespace palace
