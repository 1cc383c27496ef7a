#include "engine/calibration/grid_dots.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "engine/calibration/dot_finder.h"
#include "engine/core/median.h"

namespace palace {
namespace {

/// Steps of the grid in the picture round one point: a plane through the points nearby.
std::optional<Eigen::Matrix2d> StepsAt(const CalibrationTarget& target,
                                       const std::map<int, Eigen::Vector2d>& seen, int index) {
  constexpr int kReach = 2;
  const int column = index % target.columns, row = index / target.columns;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (int i = -kReach; i <= kReach; ++i) {
    for (int j = -kReach; j <= kReach; ++j) {
      const auto found = OnGrid(target, column + i, row + j)
                             ? seen.find((row + j) * target.columns + column + i)
                             : seen.end();
      if (found != seen.end()) {
        const Eigen::Vector3d at(1, i, j);
        normal += at * at.transpose();
        right += at * found->second.transpose();
      }
    }
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(normal);
  if (solver.rank() < 3) {
    return std::nullopt;
  }
  const Eigen::Matrix<double, 3, 2> plane = solver.solve(right);
  return plane.bottomRows<2>().transpose();
}

double LargestNeighbour_m(const CalibrationTarget& target, int index) {
  const int column = index % target.columns, row = index / target.columns;
  double largest = target.dot_diameter_m;
  for (const auto& [i, j] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
    if (OnGrid(target, column + i, row + j)) {
      largest = std::max(largest, target.DotDiameter_m((row + j) * target.columns + column + i));
    }
  }
  return largest;
}

}  // namespace

bool OnGrid(const CalibrationTarget& target, int column, int row) {
  return column >= 0 && row >= 0 && column < target.columns && row < target.rows;
}

TargetObservation RefineOnGrid(const ImageU8& picture, const CalibrationTarget& target,
                               const TargetObservation& rough) {
  std::map<int, Eigen::Vector2d> seen;
  for (const TargetPoint& point : rough) {
    seen[point.index] = point.pixel;
  }
  TargetObservation refined;
  for (const TargetPoint& point : rough) {
    const auto steps = StepsAt(target, seen, point.index);
    if (!steps || !(steps->determinant() > 0)) {
      continue;
    }
    const double per_pitch = 0.5 / target.pitch_m;
    const auto centre =
        RefineInGrid(picture, {point.pixel, *steps, per_pitch * target.DotDiameter_m(point.index),
                               per_pitch * LargestNeighbour_m(target, point.index)});
    if (centre) {
      refined.push_back({point.index, *centre});
    }
  }
  return refined;
}

Status CheckDotSize(const CalibrationTarget& target, const TargetObservation& seen,
                    const std::map<int, double>& areas_px) {
  constexpr double kMostShare = 0.2;
  constexpr double kSampling_px = 0.5;
  std::map<int, Eigen::Vector2d> places;
  for (const TargetPoint& point : seen) {
    places[point.index] = point.pixel;
  }
  std::vector<double> ratios;
  std::vector<double> diameters_px;
  for (const TargetPoint& point : seen) {
    const auto steps = StepsAt(target, places, point.index);
    if (steps && steps->determinant() > 0) {
      const double told_px =
          std::sqrt(steps->determinant()) * target.DotDiameter_m(point.index) / target.pitch_m;
      diameters_px.push_back(told_px);
      ratios.push_back(std::sqrt(4 * areas_px.at(point.index) / M_PI) / told_px);
    }
  }
  if (ratios.empty()) {
    return Ok();
  }
  const double ratio = UpperMedian(ratios);
  if (std::abs(ratio - 1) > kMostShare + kSampling_px / UpperMedian(diameters_px)) {
    char text[240];
    std::snprintf(text, sizeof text,
                  "the dots are %.2f of the pitch wide in the picture, dot_diameter_m = %.4g with "
                  "pitch_m = %.4g says %.2f (limit 20 %% off); measure both on the board",
                  ratio * target.dot_diameter_m / target.pitch_m, target.dot_diameter_m,
                  target.pitch_m, target.dot_diameter_m / target.pitch_m);
    return InvalidError(text);
  }
  return Ok();
}

}  // namespace palace
