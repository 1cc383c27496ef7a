#include "engine/slad/terrain/frame_registration.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/median.h"

namespace palace {
namespace {

constexpr std::size_t kLeastOverlap_cells = 60;
constexpr double kLargestOffset_m = 0.5;
constexpr double kLargestTilt = 0.026;  // 1.5 degrees
constexpr int kIterations = 6;
constexpr double kTukey = 4.685;
constexpr double kScaleFloor_m = 0.01;

struct Pair {
  Eigen::Vector3d basis;  ///< 1, n - n0, e - e0
  double difference_m;
  double weight;
  double height_m;  ///< of the map
};

double MedianAbsolute(const std::vector<Pair>& pairs, const Eigen::Vector3d& x) {
  std::vector<double> off;
  off.reserve(pairs.size());
  for (const Pair& p : pairs) {
    off.push_back(std::abs(p.difference_m - p.basis.dot(x)));
  }
  return UpperMedian(off);
}

std::vector<Pair> CommonCells(const ElevationMap& frame, const ElevationMap& map, double north_m,
                              double east_m) {
  std::vector<Pair> pairs;
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      if (frame.state.at(r, c) != CellState::kMeasured ||
          map.state.at(r, c) != CellState::kMeasured) {
        continue;
      }
      const double variance = static_cast<double>(frame.variance_m2.at(r, c)) +
                              static_cast<double>(map.variance_m2.at(r, c));
      pairs.push_back(
          {{1, map.geometry.NorthOfRow(r) - north_m, map.geometry.EastOfCol(c) - east_m},
           static_cast<double>(frame.height_m.at(r, c)) -
               static_cast<double>(map.height_m.at(r, c)),
           1 / (variance + kScaleFloor_m * kScaleFloor_m),
           static_cast<double>(map.height_m.at(r, c))});
    }
  }
  return pairs;
}

}  // namespace

PlaneCorrection RegisterFrame(const ElevationMap& frame, const ElevationMap& map) {
  PALACE_CHECK(frame.geometry == map.geometry);
  const GridGeometry& g = map.geometry;
  PlaneCorrection correction;
  correction.north_m = g.north_min_m + g.rows * g.cell_m / 2;
  correction.east_m = g.east_min_m + g.cols * g.cell_m / 2;
  const auto pairs = CommonCells(frame, map, correction.north_m, correction.east_m);
  if (pairs.size() < kLeastOverlap_cells) {
    return correction;
  }
  std::vector<double> differences;
  differences.reserve(pairs.size());
  for (const Pair& p : pairs) {
    correction.height_m += p.height_m / static_cast<double>(pairs.size());
    differences.push_back(p.difference_m);
  }
  Eigen::Vector3d x(UpperMedian(differences), 0, 0);
  for (int i = 0; i < kIterations; ++i) {
    const double limit = kTukey * std::max(kScaleFloor_m, kSigmaPerMad * MedianAbsolute(pairs, x));
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Pair& p : pairs) {
      const double u = (p.difference_m - p.basis.dot(x)) / limit;
      if (std::abs(u) < 1) {
        const double w = p.weight * (1 - u * u) * (1 - u * u);
        normal += w * p.basis * p.basis.transpose();
        right += w * p.difference_m * p.basis;
      }
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
    if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-9)) {
      return correction;
    }
    x = solver.solve(right);
  }
  if (std::abs(x[0]) <= kLargestOffset_m && std::hypot(x[1], x[2]) <= kLargestTilt) {
    correction.offset_m = x[0];
    correction.north_tilt = x[1];
    correction.east_tilt = x[2];
  }
  return correction;
}

void ApplyCorrection(const PlaneCorrection& correction, double gain, ElevationMap& map) {
  for (int r = 0; r < map.geometry.rows; ++r) {
    const double north_m = map.geometry.NorthOfRow(r);
    for (int c = 0; c < map.geometry.cols; ++c) {
      const auto by_m =
          static_cast<float>(gain * correction.At(north_m, map.geometry.EastOfCol(c)));
      map.height_m.at(r, c) += by_m;
      if (!map.measured_m.empty()) {
        map.measured_m.at(r, c) += by_m;
      }
    }
  }
}

}  // namespace palace
