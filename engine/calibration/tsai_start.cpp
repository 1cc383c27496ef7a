#include "engine/calibration/tsai_start.h"

#include <algorithm>
#include <cmath>

namespace palace {
namespace {

constexpr std::size_t kLeastPoints = 7;       // five ratios and something to average
constexpr double kLeastTilt = 0.1;            // sin of the tilt: flatter views tell no focal length
constexpr double kLeastFocal_per_side = 0.2;  // of the picture's longer side: 136 degrees wide
constexpr double kMostFocal_per_side = 50;

/// One point about the picture's centre and about the view's own origin on the target.
struct RadialPoint {
  Eigen::Vector2d picture;
  Eigen::Vector2d plane;
};

/// R, Tx, Ty of one view; p.z() is still unknown.
struct RadialPose {
  RigidTransform X_CT;
  std::vector<RadialPoint> points;
  Eigen::Vector2d origin;  ///< of `plane` in T
};

/// Tsai's solution divides by Ty, so the target's origin must not appear on the middle row: the
/// point farthest from it becomes the origin.
RadialPose CentredPoints(const CalibrationTarget& target, const TargetObservation& seen,
                         const Eigen::Vector2d& centre) {
  const auto farthest =
      std::max_element(seen.begin(), seen.end(), [&](const TargetPoint& a, const TargetPoint& b) {
        return std::abs(a.pixel.y() - centre.y()) < std::abs(b.pixel.y() - centre.y());
      });
  RadialPose pose;
  pose.origin = target.p_TQ(farthest->index).head<2>();
  for (const TargetPoint& point : seen) {
    pose.points.push_back({point.pixel - centre, target.p_TQ(point.index).head<2>() - pose.origin});
  }
  return pose;
}

/// Ty^2 from the 2 x 2 corner of R / Ty (Tsai 1987, equation 10).
double SquaredTy(double r1, double r2, double r4, double r5) {
  const double square_sum = r1 * r1 + r2 * r2 + r4 * r4 + r5 * r5;
  const double determinant = r1 * r5 - r4 * r2;
  if (std::abs(determinant) < 1e-12 * square_sum) {
    return 1 / square_sum;
  }
  const double root =
      std::sqrt(std::max(0.0, square_sum * square_sum - 4 * determinant * determinant));
  return (square_sum - root) / (2 * determinant * determinant);
}

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * sign * svd.matrixV().transpose();
}

bool SolveRadial(RadialPose& pose) {
  Eigen::MatrixXd left(pose.points.size(), 5);
  Eigen::VectorXd right(pose.points.size());
  for (std::size_t i = 0; i < pose.points.size(); ++i) {
    const auto& [picture, plane] = pose.points[i];
    const auto row = static_cast<Eigen::Index>(i);
    left.row(row) << picture.y() * plane.x(), picture.y() * plane.y(), picture.y(),
        -picture.x() * plane.x(), -picture.x() * plane.y();
    right[row] = picture.x();
  }
  const Eigen::VectorXd column_scale = left.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::VectorXd ratios =
      column_scale.asDiagonal() *
      (left * column_scale.asDiagonal()).colPivHouseholderQr().solve(right);
  if (!ratios.allFinite()) {
    return false;
  }
  double Ty = std::sqrt(SquaredTy(ratios[0], ratios[1], ratios[3], ratios[4]));
  const auto& far = *std::max_element(pose.points.begin(), pose.points.end(),
                                      [](const RadialPoint& a, const RadialPoint& b) {
                                        return a.picture.squaredNorm() < b.picture.squaredNorm();
                                      });
  const double y_over_Ty = ratios[3] * far.plane.x() + ratios[4] * far.plane.y() + 1;
  if ((y_over_Ty * Ty > 0) != (far.picture.y() > 0)) {
    Ty = -Ty;
  }
  const double r1 = ratios[0] * Ty, r2 = ratios[1] * Ty;
  const double r4 = ratios[3] * Ty, r5 = ratios[4] * Ty;
  const double r3 = std::sqrt(std::max(0.0, 1 - r1 * r1 - r2 * r2));
  const double r6 =
      (r1 * r4 + r2 * r5 > 0 ? -1 : 1) * std::sqrt(std::max(0.0, 1 - r4 * r4 - r5 * r5));
  Eigen::Matrix3d R;
  R.row(0) << r1, r2, r3;
  R.row(1) << r4, r5, r6;
  R.row(2) = R.row(0).cross(R.row(1));
  pose.X_CT.R = NearestRotation(R);
  pose.X_CT.p = {ratios[2] * Ty, Ty, 0};
  return std::isfinite(Ty) && pose.X_CT.R.allFinite();
}

/// The other tilt with the same first two components of the first two columns.
Eigen::Matrix3d MirroredTilt(const Eigen::Matrix3d& R) {
  Eigen::Matrix3d mirrored = R;
  mirrored(0, 2) = -R(0, 2);
  mirrored(1, 2) = -R(1, 2);
  mirrored(2, 0) = -R(2, 0);
  mirrored(2, 1) = -R(2, 1);
  return mirrored;
}

/// y = r4 x + r5 y + Ty (and the same with x) against the depth beside Tz; Tsai's second stage.
struct DepthRow {
  double lateral;  ///< r4 x + r5 y + Ty, or with r1 r2 Tx
  double picture;  ///< Y or X
  double slope;    ///< r7 x + r8 y
};

std::vector<DepthRow> DepthRows(const RadialPose& pose) {
  std::vector<DepthRow> rows;
  for (const auto& [picture, plane] : pose.points) {
    const Eigen::Vector3d p = pose.X_CT.R.leftCols<2>() * plane + pose.X_CT.p;
    rows.push_back({p.x(), picture.x(), p.z()});
    rows.push_back({p.y(), picture.y(), p.z()});
  }
  return rows;
}

/// f and Tz from f lateral - Tz picture = slope picture.
Eigen::Vector2d FocalAndDepth(const std::vector<DepthRow>& rows) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const DepthRow& row : rows) {
    const Eigen::Vector2d a(row.lateral, -row.picture);
    normal += a * a.transpose();
    right += a * row.slope * row.picture;
  }
  const Eigen::Vector2d scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::Matrix2d scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  return scale.asDiagonal() * scaled.fullPivLu().solve(scale.asDiagonal() * right);
}

/// Tz alone, with f known.
double DepthFor(const std::vector<DepthRow>& rows, double focal_px) {
  double above = 0, below = 0;
  for (const DepthRow& row : rows) {
    above += row.picture * (focal_px * row.lateral - row.slope * row.picture);
    below += row.picture * row.picture;
  }
  return above / below;
}

}  // namespace

std::optional<TsaiStart> StartFromRadialAlignment(const CalibrationTarget& target,
                                                  const std::vector<TargetObservation>& views,
                                                  int width, int height) {
  const Eigen::Vector2d centre((width - 1) / 2.0, (height - 1) / 2.0);
  std::vector<std::optional<RadialPose>> poses(views.size());
  std::vector<std::pair<double, double>> focals;  // with the tilt that tells it
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (views[v].size() < kLeastPoints) {
      continue;
    }
    RadialPose pose = CentredPoints(target, views[v], centre);
    if (!SolveRadial(pose)) {
      continue;
    }
    Eigen::Vector2d solved = FocalAndDepth(DepthRows(pose));
    if (solved[0] < 0) {  // of the two tilts, the one that puts the picture before the lens
      pose.X_CT.R = MirroredTilt(pose.X_CT.R);
      solved = FocalAndDepth(DepthRows(pose));
    }
    const double tilt = std::hypot(pose.X_CT.R(2, 0), pose.X_CT.R(2, 1));
    const double side = std::max(width, height);
    if (tilt > kLeastTilt && solved[0] > kLeastFocal_per_side * side &&
        solved[0] < kMostFocal_per_side * side && solved[1] > 0) {
      focals.emplace_back(solved[0], tilt * tilt);
    }
    poses[v] = std::move(pose);
  }
  if (focals.empty()) {
    return std::nullopt;
  }
  // Weighted median: a view tells its focal length the better the more it is tilted.
  std::sort(focals.begin(), focals.end());
  double total = 0, passed = 0;
  for (const auto& [focal, weight] : focals) {
    total += weight;
  }
  TsaiStart start;
  for (const auto& [focal, weight] : focals) {
    passed += weight;
    if (passed >= total / 2) {
      start.focal_px = focal;
      break;
    }
  }
  for (const auto& pose : poses) {
    if (!pose) {
      start.X_CT.emplace_back();
      continue;
    }
    RigidTransform X_CT = pose->X_CT;
    X_CT.p.z() = DepthFor(DepthRows(*pose), start.focal_px);
    X_CT.p -= X_CT.R.leftCols<2>() * pose->origin;
    start.X_CT.push_back(X_CT.p.allFinite() ? std::optional(X_CT) : std::nullopt);
  }
  return start;
}

}  // namespace palace
