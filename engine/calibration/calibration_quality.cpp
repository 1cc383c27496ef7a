#include "engine/calibration/calibration_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "engine/calibration/lens.h"
#include "engine/camera/alignment.h"
#include "engine/camera/cahvor.h"
#include "engine/core/check.h"
#include "engine/core/rotation_vector.h"

namespace palace {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostOutliers = 0.25;  // share of one picture's points
using LensMatrix = Eigen::Matrix<double, kLensSize, kLensSize>;

Eigen::Vector2d CellCentre(const Calibration& calibration, const GridF& map, int row, int column) {
  return {(column + 0.5) * calibration.width / map.cols() - 0.5,
          (row + 0.5) * calibration.height / map.rows() - 0.5};
}

/// Direction through a pixel in the camera's own axes.
std::optional<Eigen::Vector3d> DirectionAt(const Calibration& calibration, int side,
                                           const Eigen::Vector2d& pixel) {
  const CahvorModel model =
      CahvorFromLens(calibration.estimate.lens[static_cast<std::size_t>(side)], RigidTransform{},
                     calibration.width, calibration.height);
  const auto ray = RayFromPixelCahvor(model, pixel);
  return ray ? std::optional<Eigen::Vector3d>(ray->direction) : std::nullopt;
}

/// Rows of the aligned pictures in which one point appears.
std::optional<double> AlignedRow(const CahvorModel& raw, const CahvorModel& aligned,
                                 const Eigen::Vector2d& pixel) {
  const auto ray = RayFromPixelCahvor(raw, pixel);
  if (!ray) {
    return std::nullopt;
  }
  const auto at = ProjectCahvor(aligned, raw.C + ray->direction);
  return at ? std::optional<double>(at->y()) : std::nullopt;
}

struct RowErrors {
  int count = 0;
  double sum_of_squares = 0;
  double most = 0;
  void Add(double error) {
    ++count;
    sum_of_squares += error * error;
    most = std::max(most, std::abs(error));
  }
  double Rms() const { return count > 0 ? std::sqrt(sum_of_squares / count) : kNaN; }
};

/// Row errors of the points that both cameras saw, with the cameras of `estimate`.
template <typename Pick>
RowErrors MeasureRows(const Calibration& calibration, const RigEstimate& estimate, Pick pick) {
  const CahvorModel left =
      CahvorFromLens(estimate.lens[0], RigidTransform{}, calibration.width, calibration.height);
  const CahvorModel right =
      CahvorFromLens(estimate.lens[1], estimate.X_C0C1, calibration.width, calibration.height);
  RowErrors errors;
  const auto aligned = AlignPair(CameraModel{left}, CameraModel{right});
  if (!aligned) {
    return errors;
  }
  std::map<std::pair<int, int>, Eigen::Vector2d> left_points;
  for (const PointResidual& r : calibration.residuals) {
    if (r.side == 0) {
      left_points[{r.view, r.index}] = r.centre;
    }
  }
  for (const PointResidual& r : calibration.residuals) {
    const auto other = left_points.find({r.view, r.index});
    if (r.side == 0 || other == left_points.end() || !pick(r.view)) {
      continue;
    }
    const auto left_row = AlignedRow(left, aligned->left, other->second);
    const auto right_row = AlignedRow(right, aligned->right, r.centre);
    if (left_row && right_row) {
      errors.Add(*left_row - *right_row);
    }
  }
  return errors;
}

}  // namespace

std::vector<std::string> Contradictions(const Calibration& calibration) {
  std::vector<std::string> sentences;
  for (const ViewResult& view : calibration.views) {
    if (view.left_outliers <= kMostOutliers * view.left_points &&
        view.right_outliers <= kMostOutliers * view.right_points) {
      continue;
    }
    const std::string left = std::to_string(view.left_outliers) + " of " +
                             std::to_string(view.left_points) + " left points",
                      right = std::to_string(view.right_outliers) + " of " +
                              std::to_string(view.right_points) + " right points";
    if (view.left_points > 0 && view.right_points > 0) {
      sentences.push_back((view.right_name.empty() ? "the pictures of " + view.name
                                                   : view.name + " and " + view.right_name) +
                          " do not show the same board position (" + left + " and " + right +
                          " do not fit, limit 25 %): are they a pair, and was the board still?");
    } else {
      sentences.push_back(
          (view.left_points > 0 || view.right_name.empty() ? view.name : view.right_name) +
          " does not fit the other pictures (" + (view.left_points > 0 ? left : right) +
          " do not fit, limit 25 %): was the board bent or covered?");
    }
  }
  return sentences;
}

GridF CoverageMap(const Calibration& calibration, int side, int rows, int columns) {
  GridF map(rows, columns, 0.0f);
  for (const PointResidual& r : calibration.residuals) {
    if (r.side != side) {
      continue;
    }
    const int column =
        static_cast<int>(std::floor((r.pixel.x() + 0.5) * columns / calibration.width));
    const int row = static_cast<int>(std::floor((r.pixel.y() + 0.5) * rows / calibration.height));
    if (column >= 0 && row >= 0 && column < columns && row < rows) {
      map.at(row, column) += 1;
    }
  }
  return map;
}

GridF UncertaintyMap(const Calibration& calibration, int side, int rows, int columns) {
  struct LensCell {
    Eigen::Matrix<double, 2, kLensSize> by_lens;
    Eigen::Matrix<double, 2, 3> by_rotation;
  };
  const Lens& lens = calibration.estimate.lens[static_cast<std::size_t>(side)];
  GridF map(rows, columns, kUnknownValue);
  std::map<std::pair<int, int>, LensCell> cells;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, kLensSize> right = Eigen::Matrix<double, 3, kLensSize>::Zero();
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto direction =
          DirectionAt(calibration, side, CellCentre(calibration, map, row, column));
      const auto at = direction ? ProjectThroughLens(lens, *direction) : std::nullopt;
      if (!at) {
        continue;
      }
      const LensCell cell{at->by_lens, -at->by_point * CrossMatrix(*direction)};
      normal += cell.by_rotation.transpose() * cell.by_rotation;
      right += cell.by_rotation.transpose() * cell.by_lens;
      cells[{column, row}] = cell;
    }
  }
  if (cells.size() < 4) {
    return map;
  }
  const Eigen::Matrix<double, 3, kLensSize> rotation_by_lens = normal.ldlt().solve(right);
  const LensMatrix covariance = calibration.covariance.block<kLensSize, kLensSize>(
      side == 0 ? 0 : kRightLens, side == 0 ? 0 : kRightLens);
  for (const auto& [place, cell] : cells) {
    const Eigen::Matrix<double, 2, kLensSize> by_lens =
        cell.by_lens - cell.by_rotation * rotation_by_lens;
    const Eigen::Matrix2d spread = by_lens * covariance * by_lens.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread, Eigen::EigenvaluesOnly);
    map.at(place.second, place.first) =
        static_cast<float>(std::sqrt(std::max(0.0, axes.eigenvalues()[1])));
  }
  return map;
}

GridF DepthSigmaMap(const Calibration& calibration, double depth_m, int rows, int columns) {
  PALACE_CHECK(depth_m > 0, depth_m);
  GridF map(rows, columns, kUnknownValue);
  const RigidTransform X_C1C0 = calibration.estimate.X_C0C1.Inverse();
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto direction = DirectionAt(calibration, 0, CellCentre(calibration, map, row, column));
      if (!direction || !(direction->z() > 0)) {
        continue;
      }
      const Eigen::Vector3d p_C0 = *direction * (depth_m / direction->z());
      const Eigen::Vector3d p_C1 = X_C1C0 * p_C0;
      const auto left = ProjectThroughLens(calibration.estimate.lens[0], p_C0);
      const auto right = ProjectThroughLens(calibration.estimate.lens[1], p_C1);
      if (!left || !right ||
          !(right->pixel.x() >= -0.5 && right->pixel.y() >= -0.5 &&
            right->pixel.x() <= calibration.width - 0.5 &&
            right->pixel.y() <= calibration.height - 0.5)) {
        continue;
      }
      Eigen::Matrix<double, 4, 3> by_point;
      by_point << left->by_point, right->by_point * X_C1C0.R;
      Eigen::Matrix<double, 4, kCameraSize> by_camera =
          Eigen::Matrix<double, 4, kCameraSize>::Zero();
      by_camera.topRows<2>().leftCols<kLensSize>() = left->by_lens;
      by_camera.bottomRows<2>().middleCols<kLensSize>(kRightLens) = right->by_lens;
      by_camera.bottomRows<2>().middleCols<3>(kRightRotation) = right->by_point * CrossMatrix(p_C1);
      by_camera.bottomRows<2>().middleCols<3>(kRightCentre) = -right->by_point * X_C1C0.R;
      // Pixels stay as observed, so the triangulated point takes up what the cameras are off.
      const Eigen::Matrix<double, 3, kCameraSize> point_by_camera =
          -(by_point.transpose() * by_point).ldlt().solve(by_point.transpose() * by_camera);
      const Eigen::Matrix<double, 1, kCameraSize> depth = point_by_camera.row(2);
      map.at(row, column) = static_cast<float>(
          std::sqrt(std::max(0.0, (depth * calibration.covariance * depth.transpose())(0, 0))));
    }
  }
  return map;
}

EpipolarCheck CheckEpipolar(const Calibration& calibration) {
  const RowErrors all = MeasureRows(calibration, calibration.estimate, [](int) { return true; });
  EpipolarCheck check;
  check.points = all.count;
  check.rms_px = all.Rms();
  check.max_px = all.count > 0 ? all.most : kNaN;
  check.held_out_rms_px = kNaN;
  if (calibration.held_out_estimate) {
    check.held_out_rms_px = MeasureRows(calibration, *calibration.held_out_estimate, [&](int view) {
                              return calibration.views[static_cast<std::size_t>(view)].held_out;
                            }).Rms();
  }
  return check;
}

}  // namespace palace
