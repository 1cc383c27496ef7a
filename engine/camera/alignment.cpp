// Epipolar alignment of two CAHVOR cameras (declared in cahvor.h).
#include <algorithm>
#include <array>
#include <limits>

#include "engine/camera/cahvor.h"

namespace palace {
namespace {

/// Tangents that every picture reaches: the largest of the near borders, the least of the far ones.
struct Extents {
  double left = -std::numeric_limits<double>::infinity();
  double right = std::numeric_limits<double>::infinity();
  double top = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
};

/// Narrows `extents` to the corners and side centres of one picture. R_RectF: rows x, y, z.
bool Narrow(const CahvorModel& model, const Eigen::Matrix3d& R_RectF, Extents& extents) {
  const std::array<double, 3> columns = {0, (model.width - 1) / 2.0, model.width - 1.0};
  const std::array<double, 3> rows = {0, (model.height - 1) / 2.0, model.height - 1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == 1 && j == 1) {
        continue;
      }
      const auto ray = RayFromPixelCahvor(model, {columns[i], rows[j]});
      if (!ray) {
        return false;
      }
      const Eigen::Vector3d r = R_RectF * ray->direction;
      if (!(r.z() > 1e-3)) {
        return false;
      }
      const double x = r.x() / r.z();
      const double y = r.y() / r.z();
      extents.left = i == 0 ? std::max(extents.left, x) : extents.left;
      extents.right = i == 2 ? std::min(extents.right, x) : extents.right;
      extents.top = j == 0 ? std::max(extents.top, y) : extents.top;
      extents.bottom = j == 2 ? std::min(extents.bottom, y) : extents.bottom;
    }
  }
  return true;
}

}  // namespace

std::optional<AlignedPair> AlignPair(const CahvorModel& left, const CahvorModel& right) {
  const Eigen::Vector3d baseline = right.C - left.C;
  if (!(baseline.norm() > 0) || left.width < 2 || left.height < 2) {
    return std::nullopt;
  }
  Eigen::Vector3d x = baseline.normalized();
  const Eigen::Vector3d left_across = left.H - left.A.dot(left.H) * left.A;
  if (x.dot(left_across) < 0) {
    x = -x;  // a "right" camera on the left side: rows still point right in the picture
  }
  const Eigen::Vector3d mean_axis = left.A + right.A;
  const Eigen::Vector3d across = mean_axis - mean_axis.dot(x) * x;
  if (!(across.norm() > 1e-6)) {
    return std::nullopt;
  }
  const Eigen::Vector3d z = across.normalized();
  Eigen::Matrix3d R_RectF;
  R_RectF.row(0) = x;
  R_RectF.row(1) = z.cross(x);
  R_RectF.row(2) = z;
  Extents extents;
  if (!Narrow(left, R_RectF, extents) || !Narrow(right, R_RectF, extents) ||
      !(extents.right > extents.left) || !(extents.bottom > extents.top)) {
    return std::nullopt;
  }
  PinholeCamera camera;
  camera.width = left.width;
  camera.height = left.height;
  camera.fx_px = (left.width - 1) / (extents.right - extents.left);
  camera.fy_px = (left.height - 1) / (extents.bottom - extents.top);
  camera.cx_px = -extents.left * camera.fx_px;
  camera.cy_px = -extents.top * camera.fy_px;
  return AlignedPair{CahvFromPinhole(camera, R_RectF, left.C),
                     CahvFromPinhole(camera, R_RectF, right.C)};
}

}  // namespace palace
