// Robust weighted least-squares planes over the footprint around every cell, by moving sums.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/hazards/plane_fit.h"

namespace palace {
namespace {

/// Cells this far off their plane are kept whatever their noise; those farther off by so many
/// sigmas and shares of the plane's scatter, above it and below it, are not.
constexpr float kKeep_m = 0.02F;
constexpr float kKeepSigmas = 3;
constexpr float kKeepAbove = 0.5F, kKeepBelow = 1.5F;
constexpr double kLeastHalf_cells = 2;  // of the window: of nine cells no fit is robust
constexpr int kPasses = 3;
/// Stereo's windows share their error over about this length: farther cells err by themselves.
constexpr double kCorrelationLength_m = 0.6;
/// Sums slide down stripes of so many rows, however many threads share them.
constexpr int kStripeRows = 32;

class FootprintFit {
 public:
  /// `leave_out`: cells with this flag are no ground; null: all are.
  FootprintFit(const ElevationMap& map, double diameter_m, const Grid<std::uint8_t>* leave_out,
               FootprintPlanes& out)
      : map_(map),
        leave_out_(leave_out),
        rows_(map.geometry.rows),
        cols_(map.geometry.cols),
        out_(out),
        weight_(rows_, cols_, 0.0F),
        height_m_(rows_, cols_, 0.0F),
        variance_m2_(rows_, cols_, 0.0F),
        scatter_m_(rows_, cols_, 0.0F) {
    // Half side of the square with the circle's area, in whole cells; wider than the map is the
    // whole map.
    const double side = diameter_m * std::sqrt(M_PI) / 2 / map.geometry.cell_m;
    const double widest = std::max(rows_, cols_);
    half_ = static_cast<int>(std::clamp(std::round((side - 1) / 2), kLeastHalf_cells,
                                        std::max(kLeastHalf_cells, widest)));
    double sum = 0;
    int count = 0;
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < cols_; ++c) {
        if (Counts(r, c)) {
          sum += static_cast<double>(map.height_m.at(r, c));
          ++count;
        }
      }
    }
    reference_m_ = static_cast<float>(count > 0 ? sum / count : 0);
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < cols_; ++c) {
        if (Counts(r, c)) {
          height_m_.at(r, c) = map.height_m.at(r, c) - reference_m_;
          variance_m2_.at(r, c) = map.variance_m2.at(r, c);
          weight_.at(r, c) = FullWeight(r, c);
        }
      }
    }
  }

  int stripes() const { return (rows_ + kStripeRows - 1) / kStripeRows; }

  /// One pass over a stripe; leaves heights above the reference and gradients per cell. Sums of
  /// columns slide down the stripe; along each row the window adds those sums up.
  void Solve(int stripe) {
    const int first = FirstRow(stripe);
    const int pitch = cols_ + 2 * half_;
    const auto moments = [&](int count) { return static_cast<std::size_t>(count * pitch); };
    std::vector<double> columns(moments(kMoments), 0.0), work(moments(kMoments + 1));
    double* middle = columns.data() + half_;
    const auto add = [&](int r, double sign) {
      if (r >= 0 && r < rows_) {
        loops_.add_moments(weight_.row(r), height_m_.row(r), variance_m2_.row(r), -cols_ / 2,
                           r - rows_ / 2, sign, cols_, pitch, middle);
      }
    };
    for (int r = first - half_; r < first + half_; ++r) {
      add(r, 1);
    }
    for (int r = first; r < EndRow(stripe); ++r) {
      add(r + half_, 1);
      if (r > first) {
        add(r - half_ - 1, -1);
      }
      loops_.solve_moments(middle, pitch, half_, -cols_ / 2, r - rows_ / 2, cols_, work.data(),
                           {out_.plane.height_m.row(r), out_.plane.east_gradient.row(r),
                            out_.plane.north_gradient.row(r), scatter_m_.row(r),
                            out_.gradient_sigma.row(r), out_.cell_variance_m2.row(r)});
    }
  }
  /// Between two passes.
  void RejectOutliers(int stripe) {
    for (int r = FirstRow(stripe); r < EndRow(stripe); ++r) {
      for (int c = 0; c < cols_; ++c) {
        const float plane_m = out_.plane.height_m.at(r, c), scatter_m = scatter_m_.at(r, c);
        if (!Counts(r, c) || std::isnan(plane_m)) {
          continue;
        }
        const float off_m = height_m_.at(r, c) - plane_m;
        const float keep_m = kKeepSigmas * std::sqrt(variance_m2_.at(r, c)) + kKeep_m;
        // An obstacle lifts the plane of the ground beside it: ground then lies far below its own
        // plane and must stay, the obstacle stands above it and must go.
        const bool outlier =
            off_m > keep_m + kKeepAbove * scatter_m || off_m < -keep_m - kKeepBelow * scatter_m;
        weight_.at(r, c) = outlier ? 0.0F : FullWeight(r, c);
      }
    }
  }
  /// After the last pass: heights and gradients in metres.
  void Finish(int stripe) {
    const double cell = map_.geometry.cell_m;
    const float cell_m = static_cast<float>(cell);
    // The loops take kCorrelatedCells for granted.
    const double correlated =
        std::clamp(std::pow(kCorrelationLength_m / cell, 2), 1.0, kCorrelatedCells);
    const float sigma_scale = static_cast<float>(std::sqrt(correlated / kCorrelatedCells)) / cell_m;
    for (int r = FirstRow(stripe); r < EndRow(stripe); ++r) {
      for (int c = 0; c < cols_; ++c) {
        float& height_m = out_.plane.height_m.at(r, c);
        float& south_then_north = out_.plane.north_gradient.at(r, c);
        out_.plane.residual_m.at(r, c) = (map_.height_m.at(r, c) - reference_m_) - height_m;
        height_m += reference_m_;
        out_.plane.east_gradient.at(r, c) /= cell_m;
        south_then_north /= -cell_m;
        out_.gradient_sigma.at(r, c) *= sigma_scale;
      }
    }
  }

 private:
  static int FirstRow(int stripe) { return stripe * kStripeRows; }
  int EndRow(int stripe) const { return std::min(rows_, FirstRow(stripe + 1)); }
  bool Counts(int r, int c) const {
    return map_.state.at(r, c) == CellState::kMeasured &&
           (leave_out_ == nullptr || (leave_out_->at(r, c) & kFlagElevated) == 0);
  }
  float FullWeight(int r, int c) const {
    constexpr float kFloor = static_cast<float>(kVarianceFloor_m2);
    return kFloor / (variance_m2_.at(r, c) + kFloor);
  }

  const ElevationMap& map_;
  const Grid<std::uint8_t>* leave_out_;
  int rows_, cols_;
  FootprintPlanes& out_;
  int half_ = 1;
  float reference_m_ = 0;
  GridF weight_, height_m_, variance_m2_, scatter_m_;
  const SladLoops& loops_ = FastestSladLoops();
};

/// Passes of several fits over one map, their stripes side by side: a map of few stripes keeps all
/// threads busy that way.
void Run(std::vector<FootprintFit>& fits) {
  const int stripes = fits.front().stripes();
  const auto in_all = [&](void (FootprintFit::*step)(int)) {
    const int jobs = stripes * static_cast<int>(fits.size());
    cv::parallel_for_(cv::Range(0, jobs), [&](const cv::Range& range) {
      for (int job = range.start; job < range.end; ++job) {
        (fits[static_cast<std::size_t>(job / stripes)].*step)(job % stripes);
      }
    });
  };
  in_all(&FootprintFit::Solve);
  for (int pass = 1; pass < kPasses; ++pass) {
    in_all(&FootprintFit::RejectOutliers);
    in_all(&FootprintFit::Solve);
  }
  in_all(&FootprintFit::Finish);
}

FootprintPlanes UnknownPlanes(const GridGeometry& geometry) {
  const GridF unknown(geometry.rows, geometry.cols, kUnknownValue);
  return {{unknown, unknown, unknown, unknown}, unknown, unknown};
}

/// Beside a raised surface the ground keeps its own plane, wherever it spans one.
void PreferGroundPlanes(const FootprintPlanes& ground, const Grid<std::uint8_t>& flags,
                        FootprintPlanes& planes) {
  for (std::size_t i = 0; i < flags.cells().size(); ++i) {
    if ((flags.cells()[i] & kFlagElevated) != 0 || std::isnan(ground.plane.height_m.cells()[i])) {
      continue;
    }
    planes.plane.height_m.cells()[i] = ground.plane.height_m.cells()[i];
    planes.plane.residual_m.cells()[i] = ground.plane.residual_m.cells()[i];
    planes.plane.north_gradient.cells()[i] = ground.plane.north_gradient.cells()[i];
    planes.plane.east_gradient.cells()[i] = ground.plane.east_gradient.cells()[i];
    planes.gradient_sigma.cells()[i] = ground.gradient_sigma.cells()[i];
    planes.cell_variance_m2.cells()[i] = ground.cell_variance_m2.cells()[i];
  }
}

}  // namespace

FootprintPlanes FitFootprintPlanes(const ElevationMap& map, double footprint_diameter_m,
                                   const Grid<std::uint8_t>& flags) {
  if (map.height_m.empty()) {
    return {};
  }
  const bool any_raised = std::any_of(flags.cells().begin(), flags.cells().end(),
                                      [](std::uint8_t f) { return (f & kFlagElevated) != 0; });
  FootprintPlanes planes = UnknownPlanes(map.geometry), ground;
  std::vector<FootprintFit> fits;
  fits.reserve(2);
  fits.emplace_back(map, footprint_diameter_m, nullptr, planes);
  if (any_raised) {
    ground = UnknownPlanes(map.geometry);
    fits.emplace_back(map, footprint_diameter_m, &flags, ground);
  }
  Run(fits);
  if (any_raised) {
    PreferGroundPlanes(ground, flags, planes);
  }
  return planes;
}

}  // namespace palace
