#include "engine/slad/terrain/air_seen.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/check.h"

namespace palace {

void AddAirSeen(const PinholeCamera& camera, const RigidTransform& X_WC, const ElevationMap& frame,
                GridF& seen_up_to_m) {
  PALACE_CHECK(seen_up_to_m.rows() == frame.geometry.rows &&
               seen_up_to_m.cols() == frame.geometry.cols);
  const GridGeometry& g = frame.geometry;
  // Inward normals, in C, of the four sides of the view and of the nearest depth; a point was looked
  // at where all products are at least `from`.
  const std::array<Eigen::Vector3d, 5> sides_C = {
      Eigen::Vector3d(camera.fx_px, 0, camera.cx_px + 0.5),
      Eigen::Vector3d(-camera.fx_px, 0, camera.width - 0.5 - camera.cx_px),
      Eigen::Vector3d(0, camera.fy_px, camera.cy_px + 0.5),
      Eigen::Vector3d(0, -camera.fy_px, camera.height - 0.5 - camera.cy_px),
      Eigen::Vector3d(0, 0, 1)};
  const std::array<double, 5> from = {0, 0, 0, 0, kNearestThin_m};
  std::array<Eigen::Vector3d, 5> sides_W;
  for (std::size_t i = 0; i < sides_W.size(); ++i) {
    sides_W[i] = X_WC.R * sides_C[i];
  }
  const double camera_m = HeightFromDown(X_WC.p.z());
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      if (frame.state.at(r, c) != CellState::kMeasured) {
        continue;
      }
      const Eigen::Vector3d level = Eigen::Vector3d(g.NorthOfRow(r), g.EastOfCol(c), 0) - X_WC.p;
      double top_m = camera_m;
      for (std::size_t i = 0; i < sides_W.size(); ++i) {
        const double a = sides_W[i].dot(level) - from[i], b = -sides_W[i].z();
        top_m = b < 0 ? std::min(top_m, -a / b) : top_m;
      }
      float& seen_m = seen_up_to_m.at(r, c);
      seen_m = std::fmax(seen_m, static_cast<float>(top_m));  // not NaN, where either is known
    }
  }
}

}  // namespace palace
