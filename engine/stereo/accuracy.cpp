#include "engine/stereo/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "engine/camera/pinhole.h"
#include "engine/core/check.h"

namespace palace {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kMargin_px = 8;
constexpr int kLeastInBin = 500;
constexpr int kLeastInPatch = 20;
constexpr int kLeastOnTop = 5;

/// Calls visit(true point, measured point) in W for each pixel with a true depth; the measured one
/// is NaN where unknown.
template <typename Visit>
void ForPoints(const MeasuredView& view, const Visit& visit) {
  for (int y = 0; y < view.camera.height; ++y) {
    for (int x = 0; x < view.camera.width; ++x) {
      const double truth = view.true_depth_m.at(x, y);
      if (std::isfinite(truth)) {
        const Eigen::Vector3d ray =
            RayFromPixel(view.camera, {static_cast<double>(x), static_cast<double>(y)});
        const double depth = view.depth_m.at(x, y);
        visit(view.X_WC * (ray * truth), view.X_WC * (ray * depth), x, truth);
      }
    }
  }
}

/// Sums of a plane fit about the patch's centre.
class PlaneSums {
 public:
  void Add(double north, double east, double height) {
    const Eigen::Vector3d row(1, north, east);
    normal_ += row * row.transpose();
    right_ += row * height;
    ++count_;
  }
  int count() const { return count_; }
  /// (1, b, c) of h = a + b north + c east.
  Eigen::Vector3d Fit() const { return normal_.ldlt().solve(right_); }

 private:
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
  int count_ = 0;
};

struct PatchSums {
  PlaneSums truth;
  PlaneSums measured;
  Eigen::AlignedBox2d seen;  // of the true places, about the centre
  void Add(const Eigen::Vector3d& true_W, const Eigen::Vector3d& measured_W, double north,
           double east) {
    seen.extend(Eigen::Vector2d(true_W.x() - north, true_W.y() - east));
    truth.Add(true_W.x() - north, true_W.y() - east, HeightFromDown(true_W.z()));
    if (!std::isnan(measured_W.z())) {
      measured.Add(measured_W.x() - north, measured_W.y() - east, HeightFromDown(measured_W.z()));
    }
  }
};

PatchSlope SlopeFrom(const PatchSums& sums) {
  if (sums.measured.count() < kLeastInPatch) {
    return {kNaN, kNaN, 0};
  }
  const auto normal = [](const Eigen::Vector3d& plane) {
    return Eigen::Vector3d(-plane.y(), -plane.z(), 1).normalized();
  };
  const Eigen::Vector3d found = normal(sums.measured.Fit());
  const Eigen::Vector3d truth = normal(sums.truth.Fit());
  PatchSlope slope;
  slope.slope_rad = std::atan2(found.head<2>().norm(), found.z());
  slope.error_rad = std::atan2(found.cross(truth).norm(), found.dot(truth));
  slope.known = static_cast<double>(sums.measured.count()) / sums.truth.count();
  return slope;
}

}  // namespace

DisparityAccuracy CompareDisparity(const ImageF& disparity_px, const ImageF& sigma_px,
                                   const ImageF& true_disparity_px) {
  PALACE_CHECK(disparity_px.width() == true_disparity_px.width() &&
               disparity_px.height() == true_disparity_px.height());
  std::array<double, kFractionBins> sums{};
  std::array<int, kFractionBins> counts{};
  double square = 0, normalised = 0;
  int good = 0, bad = 0, seen = 0;
  for (int y = 0; y < disparity_px.height(); ++y) {
    for (int x = 0; x < disparity_px.width(); ++x) {
      const double truth = true_disparity_px.at(x, y);
      if (!(truth > 0) || x - truth < kMargin_px) {
        continue;
      }
      ++seen;
      const double error = disparity_px.at(x, y) - truth;
      if (std::isnan(error)) {
        continue;
      }
      if (std::abs(error) > 1) {
        ++bad;
        continue;
      }
      ++good;
      square += error * error;
      if (!sigma_px.empty()) {
        const double ratio = error / sigma_px.at(x, y);
        normalised += ratio * ratio;
      }
      const auto bin = std::min(
          kFractionBins - 1, static_cast<std::size_t>((truth - std::floor(truth)) * kFractionBins));
      sums[bin] += error;
      ++counts[bin];
    }
  }
  DisparityAccuracy accuracy;
  accuracy.coverage = seen > 0 ? static_cast<double>(good + bad) / seen : kNaN;
  accuracy.outliers = good + bad > 0 ? static_cast<double>(bad) / (good + bad) : kNaN;
  accuracy.rms_px = good > 0 ? std::sqrt(square / good) : kNaN;
  accuracy.normalised = good > 0 && !sigma_px.empty() ? std::sqrt(normalised / good) : kNaN;
  for (std::size_t k = 0; k < kFractionBins; ++k) {
    const bool enough = counts[k] >= kLeastInBin;
    accuracy.mean_error_px[k] = enough ? sums[k] / counts[k] : kNaN;
    accuracy.lock_px =
        enough ? std::max(accuracy.lock_px, std::abs(accuracy.mean_error_px[k])) : accuracy.lock_px;
  }
  return accuracy;
}

ImageF DisparityFromDepth(const ImageF& depth_m, double fb_px_m) {
  ImageF disparity(depth_m.width(), depth_m.height());
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    disparity.pixels()[i] = static_cast<float>(fb_px_m / static_cast<double>(depth_m.pixels()[i]));
  }
  return disparity;
}

double MeasuredHeight(const MeasuredView& view, const Patch& footprint, double height_m) {
  constexpr double kInside_m = 0.05, kRingFrom_m = 0.25, kRingTo_m = 0.85;
  double top = 0, ground = 0;
  int top_count = 0, ground_count = 0;
  ForPoints(view, [&](const Eigen::Vector3d& truth, const Eigen::Vector3d& measured, int, double) {
    if (std::isnan(measured.z())) {
      return;
    }
    // How far outside the footprint's edges; negative inside.
    const double outside =
        std::max(std::abs(truth.x() - footprint.north_m) - footprint.size_north_m / 2,
                 std::abs(truth.y() - footprint.east_m) - footprint.size_east_m / 2);
    const double height = HeightFromDown(measured.z());
    if (HeightFromDown(truth.z()) > 0.9 * height_m && outside < -kInside_m) {
      top += height;
      ++top_count;
    } else if (std::abs(truth.z()) < 0.01 && outside > kRingFrom_m && outside < kRingTo_m) {
      ground += height;
      ++ground_count;
    }
  });
  return top_count >= kLeastOnTop && ground_count >= kLeastOnTop
             ? top / top_count - ground / ground_count
             : kNaN;
}

PatchSlope MeasureSlope(const MeasuredView& view, const Patch& patch) {
  PatchSums sums;
  ForPoints(view, [&](const Eigen::Vector3d& truth, const Eigen::Vector3d& measured, int, double) {
    if (std::abs(truth.x() - patch.north_m) <= patch.size_north_m / 2 &&
        std::abs(truth.y() - patch.east_m) <= patch.size_east_m / 2) {
      sums.Add(truth, measured, patch.north_m, patch.east_m);
    }
  });
  return SlopeFrom(sums);
}

std::vector<PatchSlope> SlopesOverGround(const MeasuredView& view, double baseline_m,
                                         double size_m) {
  constexpr double kLeastKnown = 0.8;
  constexpr double kLeastExtent = 0.9;  // the picture's edge cuts the others
  const double fb = view.camera.fx_px * baseline_m;
  std::map<std::pair<int, int>, PatchSums> patches;
  ForPoints(view, [&](const Eigen::Vector3d& truth, const Eigen::Vector3d& measured, int x,
                      double depth_m) {
    if (x - fb / depth_m < kMargin_px) {
      return;
    }
    const int row = static_cast<int>(std::floor(truth.x() / size_m));
    const int col = static_cast<int>(std::floor(truth.y() / size_m));
    patches[{row, col}].Add(truth, measured, (row + 0.5) * size_m, (col + 0.5) * size_m);
  });
  std::vector<PatchSlope> slopes;
  for (const auto& [place, sums] : patches) {
    const bool whole = sums.seen.sizes().minCoeff() >= kLeastExtent * size_m;
    const PatchSlope slope = SlopeFrom(sums);
    if (whole && slope.known >= kLeastKnown) {
      slopes.push_back(slope);
    }
  }
  return slopes;
}

}  // namespace palace
