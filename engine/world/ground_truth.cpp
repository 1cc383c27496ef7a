#include "engine/world/ground_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/core/units.h"
#include "engine/world/truth_raster.h"

namespace palace {
namespace {

using Eigen::Vector2d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

cv::Mat View(const GridF& grid) {
  return cv::Mat(grid.rows(), grid.cols(), CV_32F, const_cast<float*>(grid.row(0)));
}

/// Largest difference to any cell within a foot's length.
void MeasureSteps(GroundTruth& truth) {
  const int reach = static_cast<int>(kFootLength_m / truth.geometry.cell_m + 1e-9);
  cv::Mat foot(2 * reach + 1, 2 * reach + 1, CV_8U);
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      foot.at<std::uint8_t>(i + reach, j + reach) = i * i + j * j <= reach * reach;
    }
  }
  const cv::Mat height = View(truth.height_m);
  cv::Mat highest, lowest;
  cv::dilate(height, highest, foot);
  cv::erode(height, lowest, foot);
  truth.step_m = GridF(truth.geometry.rows, truth.geometry.cols);
  cv::Mat step = View(truth.step_m);
  cv::max(cv::Mat(highest - height), cv::Mat(height - lowest), step);
}

/// b = sum(x h) / sum(x x) over a square about each cell, and c alike.
void MeasureSlopes(GroundTruth& truth) {
  const GridGeometry& geometry = truth.geometry;
  const int reach = static_cast<int>(std::lround((kSlopeWindow_m / geometry.cell_m - 1) / 2));
  const int side = 2 * reach + 1;
  double squares = 0;
  cv::Mat ramp(1, side, CV_32F), even(1, side, CV_32F, cv::Scalar(1.0 / side));
  for (int i = -reach; i <= reach; ++i) {
    ramp.at<float>(0, i + reach) = static_cast<float>(i);
    squares += i * i;
  }
  ramp /= squares * geometry.cell_m;
  cv::Mat north, east;
  const cv::Mat height = View(truth.height_m);
  cv::sepFilter2D(height, north, CV_32F, even, ramp);
  cv::sepFilter2D(height, east, CV_32F, ramp, even);
  truth.slope_deg = GridF(geometry.rows, geometry.cols, kUnknownValue);
  for (int row = reach; row < geometry.rows - reach; ++row) {
    for (int col = reach; col < geometry.cols - reach; ++col) {
      const double rise = std::hypot(static_cast<double>(north.at<float>(row, col)),
                                     static_cast<double>(east.at<float>(row, col)));
      truth.slope_deg.at(row, col) = static_cast<float>(Deg(std::atan(rise)));
    }
  }
}

/// Part of a row of cells, both ends included; north of the disc's middle.
struct DiscRow {
  int row, from, to;
  double north_m;
};

/// Calls visit(DiscRow) for the cells whose middles lie within the disc, until it returns false.
/// False when the disc leaves the grid.
template <typename Visit>
bool OverRows(const GridGeometry& geometry, const Vector2d& place_m, double radius_m,
              Visit&& visit) {
  if (place_m.x() - radius_m < geometry.north_min_m ||
      place_m.x() + radius_m > geometry.north_max_m() ||
      place_m.y() - radius_m < geometry.east_min_m ||
      place_m.y() + radius_m > geometry.east_max_m()) {
    return false;
  }
  constexpr double kRounding = 1e-9;
  const double cell_m = geometry.cell_m;
  const double row = (geometry.north_max_m() - place_m.x()) / cell_m - 0.5;
  const double col = (place_m.y() - geometry.east_min_m) / cell_m - 0.5;
  const int first = static_cast<int>(std::ceil(row - radius_m / cell_m - kRounding));
  const int last = static_cast<int>(std::floor(row + radius_m / cell_m + kRounding));
  for (int r = std::max(first, 0); r <= std::min(last, geometry.rows - 1); ++r) {
    const double north_m = geometry.NorthOfRow(r) - place_m.x();
    const double half = std::sqrt(std::max(0.0, radius_m * radius_m - north_m * north_m)) / cell_m;
    const int from = static_cast<int>(std::ceil(std::max(0.0, col - half - kRounding)));
    const int to =
        static_cast<int>(std::floor(std::min(geometry.cols - 1.0, col + half + kRounding)));
    if (from <= to && !visit(DiscRow{r, from, to, north_m})) {
      break;
    }
  }
  return true;
}

/// Sums of the least-squares plane a + b north + c east about a disc's middle, row by row.
class PlaneSums {
 public:
  PlaneSums(const GridGeometry& geometry, const Vector2d& place_m)
      : cell_m_(geometry.cell_m), east0_m_(geometry.EastOfCol(0) - place_m.y()) {}

  /// Of the row's heights, and of each times its column.
  void Add(const DiscRow& row, double heights, double heights_by_col) {
    const double n = row.north_m, e = east0_m_ + cell_m_ * row.from;
    const double count = row.to - row.from + 1;
    const double cols = count * (count - 1) / 2, squares = cols * (2 * count - 1) / 3;
    const double easts = count * e + cell_m_ * cols;
    const double east_squares =
        count * e * e + 2 * e * cell_m_ * cols + cell_m_ * cell_m_ * squares;
    Eigen::Matrix3d normal;
    normal << count, n * count, easts,        //
        n * count, n * n * count, n * easts,  //
        easts, n * easts, east_squares;
    normal_ += normal;
    right_ += Eigen::Vector3d(heights, n * heights, east0_m_ * heights + cell_m_ * heights_by_col);
  }
  double count() const { return normal_(0, 0); }
  Eigen::Vector3d Plane() const { return normal_.ldlt().solve(right_); }

 private:
  double cell_m_, east0_m_;
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
};

double SlopeOf(const Eigen::Vector3d& plane) {
  return Deg(std::atan(std::hypot(plane.y(), plane.z())));
}

/// Largest distance from the plane; once it exceeds `enough` any that does.
double DeviationFrom(const GroundTruth& truth, const Eigen::Vector3d& plane,
                     const Vector2d& place_m, double radius_m, double enough) {
  float deviation = 0;
  OverRows(truth.geometry, place_m, radius_m, [&](const DiscRow& row) {
    const double east_m = truth.geometry.EastOfCol(row.from) - place_m.y();
    const auto first = static_cast<float>(plane.x() + plane.y() * row.north_m + plane.z() * east_m);
    const auto per_col = static_cast<float>(plane.z() * truth.geometry.cell_m);
    const float* height_m = truth.height_m.row(row.row) + row.from;
    for (int i = 0; i <= row.to - row.from; ++i) {
      const float off = std::abs(height_m[i] - first - per_col * static_cast<float>(i));
      deviation = off > deviation ? off : deviation;
    }
    return static_cast<double>(deviation) <= enough;
  });
  return static_cast<double>(deviation);
}

bool BreaksAlone(const GroundTruth& truth, Cell cell, const TruthLimits& limits,
                 const char** what) {
  const std::uint8_t flags = truth.flags.at(cell);
  *what = static_cast<double>(truth.step_m.at(cell)) > limits.step_m         ? "step"
          : (flags & kWaterThere) != 0                                       ? "water"
          : (flags & kMovingThere) != 0                                      ? "moving"
          : static_cast<double>(truth.slope_deg.at(cell)) > limits.slope_deg ? "slope"
                                                                             : nullptr;
  return *what != nullptr;
}

/// Metres from each cell to the nearest that no disc may hold.
cv::Mat DistanceToStepsAndWater(const GroundTruth& truth, const TruthLimits& limits) {
  const GridGeometry& geometry = truth.geometry;
  cv::Mat clear(geometry.rows, geometry.cols, CV_8U), away;
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      const bool hazard = static_cast<double>(truth.step_m.at(row, col)) > limits.step_m ||
                          (truth.flags.at(row, col) & (kWaterThere | kMovingThere)) != 0;
      clear.at<std::uint8_t>(row, col) = hazard ? 0 : 1;
    }
  }
  cv::distanceTransform(clear, away, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return away * geometry.cell_m;
}

/// Running sums along every row: of heights, and of each times its column.
class RowSums {
 public:
  explicit RowSums(const GroundTruth& truth)
      : heights_(truth.geometry.rows, truth.geometry.cols + 1),
        heights_by_col_(truth.geometry.rows, truth.geometry.cols + 1) {
    for (int row = 0; row < truth.geometry.rows; ++row) {
      for (int col = 0; col < truth.geometry.cols; ++col) {
        const auto height = static_cast<double>(truth.height_m.at(row, col));
        heights_.at(row, col + 1) = heights_.at(row, col) + height;
        heights_by_col_.at(row, col + 1) = heights_by_col_.at(row, col) + height * col;
      }
    }
  }
  void AddTo(PlaneSums& plane, const DiscRow& row) const {
    plane.Add(row, heights_.at(row.row, row.to + 1) - heights_.at(row.row, row.from),
              heights_by_col_.at(row.row, row.to + 1) - heights_by_col_.at(row.row, row.from));
  }

 private:
  Grid<double> heights_, heights_by_col_;
};

/// Slope and deviation of a disc that holds no step and no water.
bool IsEven(const GroundTruth& truth, const RowSums& sums, const Vector2d& place_m, double radius_m,
            const TruthLimits& limits) {
  PlaneSums plane_sums(truth.geometry, place_m);
  const bool known = OverRows(truth.geometry, place_m, radius_m, [&](const DiscRow& row) {
    sums.AddTo(plane_sums, row);
    return true;
  });
  if (!known || plane_sums.count() < 3) {
    return false;
  }
  const Eigen::Vector3d plane = plane_sums.Plane();
  return SlopeOf(plane) <= limits.slope_deg &&
         DeviationFrom(truth, plane, place_m, radius_m, limits.deviation_m) <= limits.deviation_m;
}

}  // namespace

GroundTruth TruthOf(const World& world, const TruthArea& area, double time_s) {
  GroundTruth truth = RasteriseWorld(world, area, time_s);
  MeasureSteps(truth);
  MeasureSlopes(truth);
  return truth;
}

DiscTruth TruthOfDisc(const GroundTruth& truth, const Vector2d& place_m, double radius_m) {
  DiscTruth disc;
  PlaneSums sums(truth.geometry, place_m);
  float step = 0;
  int water = 0, moving = 0;
  disc.known = OverRows(truth.geometry, place_m, radius_m, [&](const DiscRow& row) {
    double heights = 0, heights_by_col = 0;
    for (int col = row.from; col <= row.to; ++col) {
      const auto height = static_cast<double>(truth.height_m.at(row.row, col));
      heights += height;
      heights_by_col += height * col;
      step = std::max(step, truth.step_m.at(row.row, col));
      const std::uint8_t flags = truth.flags.at(row.row, col);
      water += (flags & kWaterThere) != 0;
      moving += (flags & kMovingThere) != 0;
    }
    sums.Add(row, heights, heights_by_col);
    return true;
  });
  disc.known = disc.known && sums.count() >= 3;
  if (!disc.known) {
    return disc;
  }
  const Eigen::Vector3d plane = sums.Plane();
  disc.slope_deg = SlopeOf(plane);
  disc.deviation_m = DeviationFrom(truth, plane, place_m, radius_m, kInfinity);
  disc.step_m = static_cast<double>(step);
  disc.water_share = water / sums.count();
  disc.moving_share = moving / sums.count();
  return disc;
}

bool WithinLimits(const DiscTruth& disc, const TruthLimits& limits) {
  return disc.known && disc.slope_deg <= limits.slope_deg &&
         disc.deviation_m <= limits.deviation_m && disc.step_m <= limits.step_m &&
         disc.water_share == 0 && disc.moving_share == 0;
}

bool SafeDisc(const GroundTruth& truth, const Vector2d& place_m, double radius_m,
              const TruthLimits& limits) {
  return WithinLimits(TruthOfDisc(truth, place_m, radius_m), limits);
}

std::optional<TruthHazard> NearestHazard(const GroundTruth& truth, const Vector2d& place_m,
                                         const TruthLimits& limits) {
  const GridGeometry& geometry = truth.geometry;
  std::optional<TruthHazard> nearest;
  for (int row = 0; row < geometry.rows; ++row) {
    const double north = geometry.NorthOfRow(row) - place_m.x();
    for (int col = 0; col < geometry.cols; ++col) {
      const double away = std::hypot(north, geometry.EastOfCol(col) - place_m.y());
      const char* what = nullptr;
      if ((!nearest || away < nearest->distance_m) &&
          BreaksAlone(truth, {row, col}, limits, &what)) {
        nearest = {{geometry.NorthOfRow(row), geometry.EastOfCol(col)}, away, what};
      }
    }
  }
  return nearest;
}

SafePlaces FindSafePlaces(const GroundTruth& truth, double radius_m, const TruthLimits& limits,
                          double every_m) {
  const GridGeometry& fine = truth.geometry;
  SafePlaces places;
  places.geometry = {.rows = static_cast<int>(fine.rows * fine.cell_m / every_m + 1e-9),
                     .cols = static_cast<int>(fine.cols * fine.cell_m / every_m + 1e-9),
                     .cell_m = every_m,
                     .north_min_m = fine.north_min_m,
                     .east_min_m = fine.east_min_m};
  places.safe = Grid<std::uint8_t>(places.geometry.rows, places.geometry.cols);
  const cv::Mat clear_m = DistanceToStepsAndWater(truth, limits);
  const RowSums sums(truth);
  cv::parallel_for_(cv::Range(0, places.geometry.rows), [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row) {
      for (int col = 0; col < places.geometry.cols; ++col) {
        const Vector2d place(places.geometry.NorthOfRow(row), places.geometry.EastOfCol(col));
        const std::optional<Cell> at = fine.CellFromPoint(place.x(), place.y());
        if (!at) {
          continue;
        }
        // The place is within a cell of the middle of its own.
        const auto clear = static_cast<double>(clear_m.at<float>(at->row, at->col));
        const bool safe =
            clear > radius_m + fine.cell_m
                ? IsEven(truth, sums, place, radius_m, limits)
                : clear > radius_m - fine.cell_m && SafeDisc(truth, place, radius_m, limits);
        places.safe.at(row, col) = safe ? 1 : 0;
      }
    }
  });
  return places;
}

int SafePlaces::Count() const {
  return static_cast<int>(std::count(safe.cells().begin(), safe.cells().end(), 1));
}

int SafePlaces::Regions() const {
  const cv::Mat view(safe.rows(), safe.cols(), CV_8U, const_cast<std::uint8_t*>(safe.row(0)));
  cv::Mat labels;
  return cv::connectedComponents(view, labels, 8) - 1;  // the rest is one more
}

}  // namespace palace
