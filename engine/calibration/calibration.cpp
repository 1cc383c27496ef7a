#include "engine/calibration/calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <tuple>

#include "engine/calibration/calibration_quality.h"
#include "engine/calibration/rig_start.h"
#include "engine/core/check.h"
#include "engine/core/median.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kLeastPoints = 12;  // a side with fewer is not used
constexpr double kMostOutliers = 0.25;    // share of all points
constexpr double kLeastBaseline = 1e-3;   // of the board's distance; one camera moves by less
constexpr int kRejectionRounds = 6;
constexpr double kRobustTolerance = 1e-6;    // of a fit that only tells outliers apart
constexpr double kMedianPerSigma = 1.17741;  // median length of a 2-D normal vector of sigma 1

std::string DegreesText(double rad) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f degrees", Deg(rad));
  return text;
}

std::array<bool, kCameraSize> AllFree() {
  std::array<bool, kCameraSize> free{};
  free.fill(true);
  return free;
}

std::vector<TargetView> UsableViews(const std::vector<TargetView>& views) {
  std::vector<TargetView> usable;
  for (TargetView view : views) {
    if (view.left.size() < kLeastPoints) {
      view.left.clear();
    }
    if (view.right.size() < kLeastPoints) {
      view.right.clear();
    }
    if (!view.left.empty() || !view.right.empty()) {
      usable.push_back(std::move(view));
    }
  }
  return usable;
}

using PointKey = std::tuple<int, int, int>;  // view, side, index

/// The views without the rejected points.
std::vector<TargetView> Without(const std::vector<TargetView>& views,
                                const std::vector<PointResidual>& rejected) {
  std::set<PointKey> out;
  for (const PointResidual& r : rejected) {
    out.emplace(r.view, r.side, r.index);
  }
  std::vector<TargetView> kept = views;
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (const int side : {0, 1}) {
      TargetObservation& points = side == 0 ? kept[v].left : kept[v].right;
      std::erase_if(points, [&](const TargetPoint& point) {
        return out.contains({static_cast<int>(v), side, point.index});
      });
    }
  }
  return kept;
}

/// Points farther out than `sigmas` of a robust sigma (from the median, which outliers cannot
/// move).
std::vector<PointResidual> FarOut(const std::vector<PointResidual>& residuals, double sigmas) {
  std::vector<double> lengths;
  for (const PointResidual& r : residuals) {
    lengths.push_back(r.error_px.allFinite() ? r.error_px.norm()
                                             : std::numeric_limits<double>::infinity());
  }
  std::vector<double> sorted = lengths;
  const double limit_px = sigmas * UpperMedian(sorted) / kMedianPerSigma;
  std::vector<PointResidual> far;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (!(lengths[i] <= limit_px)) {
      far.push_back(residuals[i]);
    }
  }
  return far;
}

struct Fit {
  BundleResult bundle;
  std::vector<PointResidual> rejected;
};

/// Robust first, then plain least squares with outliers taken out until their set is stable.
Result<Fit> FitWithRejection(const CalibrationTarget& target, const std::vector<TargetView>& views,
                             const RigEstimate& start, BundleOptions options, double reject_sigma) {
  const double cost_tolerance = options.cost_tolerance;
  options.robust = true;
  options.cost_tolerance = kRobustTolerance;
  auto fitted = AdjustBundle(target, views, start, options);
  if (!fitted) {
    return fitted.error();
  }
  Fit fit;
  options.robust = false;
  options.cost_tolerance = cost_tolerance;
  std::size_t before = 0;
  for (int round = 0; round < kRejectionRounds; ++round) {
    fit.rejected = FarOut(Residuals(target, views, fitted->estimate), reject_sigma);
    if (round > 0 && fit.rejected.size() == before) {
      break;
    }
    before = fit.rejected.size();
    fitted = AdjustBundle(target, Without(views, fit.rejected), fitted->estimate, options);
    if (!fitted) {
      return fitted.error();
    }
  }
  fit.bundle = *fitted;
  return fit;
}

double LongestDistance(const CalibrationTarget& target) {
  return (target.p_TQ(target.point_count() - 1) - target.p_TQ(0)).norm();
}

Eigen::Vector3d Middle(const CalibrationTarget& target, const RigidTransform& X_CT) {
  return X_CT * Eigen::Vector3d((target.p_TQ(0) + target.p_TQ(target.point_count() - 1)) / 2);
}

double TiltOf(const RigidTransform& X_CT) {
  return std::acos(std::clamp(std::abs(X_CT.R(2, 2)), 0.0, 1.0));
}

/// Refuses sets of board poses that cannot tell the parameters apart.
Status CheckPoses(const std::vector<RigidTransform>& poses, const CalibrationOptions& options) {
  int tilted = 0;
  double steepest = 0;
  double spread = 0;
  for (const RigidTransform& a : poses) {
    steepest = std::max(steepest, TiltOf(a));
    tilted += TiltOf(a) >= options.min_tilt_rad ? 1 : 0;
    for (const RigidTransform& b : poses) {
      spread = std::max(spread, std::acos(std::clamp(a.R.col(2).dot(b.R.col(2)), -1.0, 1.0)));
    }
  }
  if (spread < options.min_spread_rad) {
    return InvalidError("the board is parallel to itself in all " + std::to_string(poses.size()) +
                        " views (their normals differ by " + DegreesText(spread) + " at most, " +
                        DegreesText(options.min_spread_rad) +
                        " are needed): focal length and distance cannot be told apart; add views "
                        "tilted by 20 to 45 degrees, about both axes");
  }
  if (tilted < options.min_tilted_views) {
    return InvalidError("only " + std::to_string(tilted) + " of " + std::to_string(poses.size()) +
                        " views are tilted by " + DegreesText(options.min_tilt_rad) +
                        " or more against the picture (the steepest: " + DegreesText(steepest) +
                        "), " + std::to_string(options.min_tilted_views) +
                        " are needed; add views tilted by 20 to 45 degrees, about both axes");
  }
  return Ok();
}

Status CheckRig(const RigEstimate& estimate) {
  const Eigen::Vector3d& C = estimate.X_C0C1.p;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const RigidTransform& X_C0T : estimate.X_C0T) {
    nearest_m = std::min(nearest_m, X_C0T.p.norm());
  }
  if (!(C.norm() > kLeastBaseline * nearest_m)) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "the baseline is 0 (%.2g m, with the board %.3g m away): both lists hold the same "
        "camera's pictures; give the right camera's as --right",
        C.norm(), nearest_m);
    return InvalidError(text);
  }
  if (C.x() < 0 && std::abs(C.x()) > 0.3 * C.norm()) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "the right camera comes out %.3f m to the left of the left one: left and right "
                  "pictures are swapped; exchange --left and --right",
                  -C.x());
    return InvalidError(text);
  }
  return Ok();
}

Status CheckCovariance(const BundleResult& bundle, const CalibrationOptions& options) {
  for (const int side : {0, 1}) {
    for (const int index : {kHs, kVs}) {
      const int at = (side == 0 ? 0 : kRightLens) + index;
      const double focal_px = bundle.estimate.lens[static_cast<std::size_t>(side)][index];
      const double share = std::sqrt(bundle.covariance(at, at)) / focal_px;
      if (!(focal_px > 0) || !(share <= options.max_focal_sigma)) {
        char text[256];
        std::snprintf(text, sizeof text,
                      "the %s focal length is known to %.2f %% only (1 sigma, limit %.2f %%): the "
                      "views do not determine it; add views tilted by 20 to 45 degrees about both "
                      "axes, near and far",
                      side == 0 ? "left" : "right", 100 * share, 100 * options.max_focal_sigma);
        return InvalidError(text);
      }
    }
  }
  return Ok();
}

/// Root mean square length of the residuals that `pick` accepts; NaN without any.
template <typename Pick>
double Rms(const std::vector<PointResidual>& residuals, Pick pick) {
  double sum = 0;
  int count = 0;
  for (const PointResidual& r : residuals) {
    if (pick(r) && r.error_px.allFinite()) {
      sum += r.error_px.squaredNorm();
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : kNaN;
}

/// Poses of all views with the cameras of `cameras` fixed.
Result<RigEstimate> PosesFor(const CalibrationTarget& target, const std::vector<TargetView>& views,
                             const RigEstimate& cameras) {
  BundleOptions options;
  options.robust = false;
  const auto fitted = AdjustBundle(target, views, cameras, options);
  if (!fitted) {
    return fitted.error();
  }
  return fitted->estimate;
}

/// A second fit without every n-th view, and the residuals of those views in it.
void HoldOut(const CalibrationTarget& target, const std::vector<TargetView>& clean,
             const CalibrationOptions& options, Calibration& calibration) {
  calibration.held_out_rms_px = kNaN;
  const int count = static_cast<int>(clean.size());
  if (options.hold_out_every < 2 || count < options.min_views_held_out) {
    return;
  }
  std::vector<TargetView> training;
  RigEstimate start = calibration.estimate;
  start.X_C0T.clear();
  for (int v = 0; v < count; ++v) {
    const bool held = (v + 1) % options.hold_out_every == 0;
    calibration.views[static_cast<std::size_t>(v)].held_out = held;
    if (!held) {
      training.push_back(clean[static_cast<std::size_t>(v)]);
      start.X_C0T.push_back(calibration.estimate.X_C0T[static_cast<std::size_t>(v)]);
    }
  }
  BundleOptions bundle;
  bundle.free = AllFree();
  bundle.prior = options.prior;
  bundle.robust = false;
  const auto fitted = AdjustBundle(target, training, start, bundle);
  if (!fitted) {
    return;
  }
  RigEstimate cameras = fitted->estimate;
  cameras.X_C0T = calibration.estimate.X_C0T;
  const auto posed = PosesFor(target, clean, cameras);
  if (!posed) {
    return;
  }
  calibration.held_out_estimate = *posed;
  const auto residuals = Residuals(target, clean, *posed);
  for (std::size_t v = 0; v < clean.size(); ++v) {
    ViewResult& view = calibration.views[v];
    if (view.held_out) {
      view.held_out_rms_px =
          Rms(residuals, [&](const auto& r) { return r.view == static_cast<int>(v); });
    }
  }
  calibration.held_out_rms_px = Rms(residuals, [&](const PointResidual& r) {
    return calibration.views[static_cast<std::size_t>(r.view)].held_out;
  });
}

void DescribeViews(const CalibrationTarget& target, const std::vector<TargetView>& views,
                   Calibration& calibration) {
  for (std::size_t v = 0; v < views.size(); ++v) {
    const int at = static_cast<int>(v);
    ViewResult view;
    view.name = views[v].name;
    view.right_name = views[v].right_name;
    view.X_C0T = calibration.estimate.X_C0T[v];
    view.tilt_rad = TiltOf(view.X_C0T);
    view.distance_m = Middle(target, view.X_C0T).norm();
    view.left_points = static_cast<int>(views[v].left.size());
    view.right_points = static_cast<int>(views[v].right.size());
    for (const PointResidual& r : calibration.rejected) {
      view.left_outliers += r.view == at && r.side == 0 ? 1 : 0;
      view.right_outliers += r.view == at && r.side == 1 ? 1 : 0;
    }
    view.left_rms_px =
        Rms(calibration.residuals, [&](const auto& r) { return r.view == at && r.side == 0; });
    view.right_rms_px =
        Rms(calibration.residuals, [&](const auto& r) { return r.view == at && r.side == 1; });
    view.held_out_rms_px = kNaN;
    calibration.views.push_back(std::move(view));
  }
}

Status CheckInput(const std::vector<TargetView>& usable, std::size_t given,
                  const CalibrationOptions& options) {
  const auto both = std::count_if(usable.begin(), usable.end(), [](const TargetView& view) {
    return !view.left.empty() && !view.right.empty();
  });
  if (both < options.min_views) {
    return InvalidError("the board is seen by both cameras in " + std::to_string(both) + " of " +
                        std::to_string(given) + " views, " + std::to_string(options.min_views) +
                        " are the least and 10 to 20 are good; add views");
  }
  return Ok();
}

}  // namespace

CahvorModel Calibration::LeftModel() const {
  return CahvorFromLens(estimate.lens[0], RigidTransform{}, width, height);
}

CahvorModel Calibration::RightModel() const {
  return CahvorFromLens(estimate.lens[1], estimate.X_C0C1, width, height);
}

double Calibration::baseline_sigma_m() const {
  const Eigen::Vector3d along = estimate.X_C0C1.p.normalized();
  return std::sqrt(along.dot(covariance.block<3, 3>(kRightCentre, kRightCentre) * along));
}

Result<Calibration> Calibrate(const CalibrationTarget& target, const std::vector<TargetView>& views,
                              const CalibrationOptions& options) {
  PALACE_CHECK(options.width > 0 && options.height > 0, options.width, options.height);
  PALACE_CHECK(target.point_count() > 0 && LongestDistance(target) > 0);
  const std::vector<TargetView> usable = UsableViews(views);
  if (Status status = CheckInput(usable, views.size(), options); !status) {
    return status.error();
  }
  const auto start = StartRig(target, usable, options.width, options.height, options.prior);
  if (!start) {
    return start.error();
  }
  if (Status status = CheckRig(*start); !status) {
    return status.error();
  }
  if (Status status = CheckPoses(start->X_C0T, options); !status) {
    return status.error();
  }
  BundleOptions bundle;
  bundle.free = AllFree();
  bundle.prior = options.prior;
  const auto fit = FitWithRejection(target, usable, *start, bundle, options.reject_sigma);
  if (!fit) {
    return fit.error();
  }
  if (Status status = CheckCovariance(fit->bundle, options); !status) {
    return status.error();
  }
  Calibration calibration;
  calibration.width = options.width;
  calibration.height = options.height;
  calibration.estimate = fit->bundle.estimate;
  calibration.covariance = fit->bundle.covariance;
  calibration.sigma_px = fit->bundle.sigma_px;
  calibration.rejected = fit->rejected;
  const std::vector<TargetView> clean = Without(usable, fit->rejected);
  calibration.residuals = Residuals(target, clean, calibration.estimate);
  calibration.outliers = static_cast<int>(fit->rejected.size());
  calibration.points = static_cast<int>(calibration.residuals.size()) + calibration.outliers;
  DescribeViews(target, usable, calibration);
  if (calibration.outliers > kMostOutliers * calibration.points) {
    const std::vector<std::string> contradictions = Contradictions(calibration);
    return InvalidError(std::to_string(calibration.outliers) + " of " +
                        std::to_string(calibration.points) +
                        " points do not fit (limit 25 %): is the board flat, still and the one "
                        "TARGET.toml describes?" +
                        (contradictions.empty() ? "" : " First: " + contradictions.front()));
  }
  calibration.left_rms_px = Rms(calibration.residuals, [](const auto& r) { return r.side == 0; });
  calibration.right_rms_px = Rms(calibration.residuals, [](const auto& r) { return r.side == 1; });
  HoldOut(target, clean, options, calibration);
  return calibration;
}

}  // namespace palace
