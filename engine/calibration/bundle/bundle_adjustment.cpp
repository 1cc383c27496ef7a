#include "engine/calibration/bundle/bundle_adjustment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/calibration/bundle/bundle_equations.h"
#include "engine/core/check.h"
#include "engine/core/median.h"
#include "engine/core/rotation_vector.h"

namespace palace {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastDamping = 1e-12;
constexpr double kMostDamping = 1e8;
constexpr double kRobustScale = 1.5;           // of the median residual: Cauchy's loss scale
constexpr double kLeastRobustScale_px = 0.01;  // perfect data still need a scale
constexpr double kMedianPerSigma = 1.17741;    // median length of a 2-D normal vector of sigma 1

using PointByPose = Eigen::Matrix<double, 3, 6>;

RigidTransform CameraFromTarget(const RigEstimate& estimate, int side, std::size_t view) {
  return side == 0 ? estimate.X_C0T[view] : estimate.X_C0C1.Inverse() * estimate.X_C0T[view];
}

RigEstimate Apply(const RigEstimate& estimate, const BundleStep& step) {
  RigEstimate moved = estimate;
  moved.lens[0] += step.camera.segment<kLensSize>(0);
  moved.lens[1] += step.camera.segment<kLensSize>(kRightLens);
  moved.X_C0C1.R = estimate.X_C0C1.R * RotationFromVector(step.camera.segment<3>(kRightRotation));
  moved.X_C0C1.p += step.camera.segment<3>(kRightCentre);
  for (std::size_t i = 0; i < step.poses.size(); ++i) {
    RigidTransform& X = moved.X_C0T[i];
    X.R = RotationFromVector(step.poses[i].head<3>()) * X.R;
    X.p += step.poses[i].tail<3>();
  }
  return moved;
}

/// An observed point, as the place of its centre.
struct CentrePoint {
  Eigen::Vector3d p_TQ;
  Eigen::Vector2d pixel;
};

/// The problem: what stays the same from step to step.
class Bundle {
 public:
  Bundle(const CalibrationTarget& target, const std::vector<TargetView>& views,
         const BundleOptions& options)
      : target_(target), views_(views), options_(options), centres_(views.size()) {}

  /// Takes the dots' eccentricity out of the observations. It is a few hundredths of a pixel and
  /// hardly depends on what a step changes, so it is held during a round of steps and renewed
  /// before the next: the same fixed point as projecting every dot in every step, at a fifth of the
  /// work.
  void CentreObservations(const std::vector<PointResidual>& residuals) {
    for (auto& sides : centres_) {
      sides[0].clear();
      sides[1].clear();
    }
    for (const PointResidual& r : residuals) {
      const Eigen::Vector2d& pixel = r.centre.allFinite() ? r.centre : r.pixel;
      centres_[static_cast<std::size_t>(r.view)][static_cast<std::size_t>(r.side)].push_back(
          {target_.p_TQ(r.index), pixel});
    }
  }

  /// Sum of the loss over all points and the priors, in px^2. A point that the estimate cannot
  /// project makes the step infinitely bad.
  double Cost(const RigEstimate& estimate, double sigma_px, double scale_px) const {
    double cost = PriorCost(estimate, sigma_px);
    for (std::size_t v = 0; v < views_.size(); ++v) {
      for (const int side : {0, 1}) {
        const RigidTransform X_CT = CameraFromTarget(estimate, side, v);
        const Lens& lens = estimate.lens[static_cast<std::size_t>(side)];
        for (const CentrePoint& point : centres_[v][static_cast<std::size_t>(side)]) {
          const auto at = PixelThroughLens(lens, X_CT * point.p_TQ);
          if (!at) {
            return std::numeric_limits<double>::infinity();
          }
          const double square = (point.pixel - *at).squaredNorm();
          cost += options_.robust ? scale_px * scale_px * std::log1p(square / (scale_px * scale_px))
                                  : square;
        }
      }
    }
    return cost;
  }

  NormalEquations Linearise(const RigEstimate& estimate, double sigma_px, double scale_px) const {
    NormalEquations n;
    n.W.assign(views_.size(), CameraPose::Zero());
    n.V.assign(views_.size(), Pose66::Zero());
    n.pose_gradient.assign(views_.size(), Pose6::Zero());
    for (std::size_t v = 0; v < views_.size(); ++v) {
      AddSide<0, kLensSize>(estimate, v, scale_px, n);
      AddSide<kRightLens, kCameraSize - kRightLens>(estimate, v, scale_px, n);
    }
    AddPrior(estimate, sigma_px, n);
    return n;
  }

 private:
  /// One camera's points of one view. They touch camera parameters `kFirst` .. `kFirst + kCount`.
  template <int kFirst, int kCount>
  void AddSide(const RigEstimate& estimate, std::size_t v, double scale_px,
               NormalEquations& n) const {
    constexpr int kSide = kFirst == 0 ? 0 : 1;
    const RigidTransform X_CT = CameraFromTarget(estimate, kSide, v);
    const Lens& lens = estimate.lens[kSide];
    const Eigen::Matrix3d R_CC0 = kSide == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                             : Eigen::Matrix3d(estimate.X_C0C1.R.transpose());
    for (const CentrePoint& point : centres_[v][kSide]) {
      const auto at = ProjectThroughLens(lens, X_CT * point.p_TQ);
      if (!at) {
        continue;
      }
      const Eigen::Vector2d error = point.pixel - at->pixel;
      const double weight =
          options_.robust ? 1 / (1 + error.squaredNorm() / (scale_px * scale_px)) : 1.0;
      PointByPose point_by_pose;
      point_by_pose.leftCols<3>() = -R_CC0 * CrossMatrix(estimate.X_C0T[v].R * point.p_TQ);
      point_by_pose.rightCols<3>() = R_CC0;
      const Eigen::Matrix<double, 2, 6> by_pose = at->by_point * point_by_pose;
      Eigen::Matrix<double, 2, kCount> by_camera;
      by_camera.template leftCols<kLensSize>() = at->by_lens;
      if constexpr (kSide == 1) {  // p_C1 = exp(-d) R^T (p_C0 - C): d p_C1 = [p_C1]x d
        by_camera.template middleCols<3>(kRightRotation - kRightLens) =
            at->by_point * CrossMatrix(X_CT * point.p_TQ);
        by_camera.template middleCols<3>(kRightCentre - kRightLens) = -at->by_point * R_CC0;
      }
      n.U.block<kCount, kCount>(kFirst, kFirst) += weight * by_camera.transpose() * by_camera;
      n.gradient.segment<kCount>(kFirst) += weight * by_camera.transpose() * error;
      n.W[v].middleRows<kCount>(kFirst) += weight * by_camera.transpose() * by_pose;
      n.V[v] += weight * by_pose.transpose() * by_pose;
      n.pose_gradient[v] += weight * by_pose.transpose() * error;
    }
  }

  template <typename Visit>
  void ForEachPrior(Visit visit) const {
    for (const int side : {0, 1}) {
      const int base = side == 0 ? 0 : kRightLens;
      for (const auto& [index, sigma] :
           {std::pair(kO1, options_.prior.axis_sigma), std::pair(kO2, options_.prior.axis_sigma),
            std::pair(kRho1, options_.prior.rho1_sigma),
            std::pair(kRho2, options_.prior.rho2_sigma)}) {
        if (options_.free[static_cast<std::size_t>(base + index)]) {
          visit(side, base + index, static_cast<int>(index), sigma);
        }
      }
    }
  }

  double PriorCost(const RigEstimate& estimate, double sigma_px) const {
    double cost = 0;
    ForEachPrior([&](int side, int, int index, double sigma) {
      const double off = estimate.lens[static_cast<std::size_t>(side)][index] / sigma;
      cost += sigma_px * sigma_px * off * off;
    });
    return cost;
  }

  void AddPrior(const RigEstimate& estimate, double sigma_px, NormalEquations& n) const {
    ForEachPrior([&](int side, int at, int index, double sigma) {
      const double weight = sigma_px * sigma_px / (sigma * sigma);
      n.U(at, at) += weight;
      n.gradient[at] -= weight * estimate.lens[static_cast<std::size_t>(side)][index];
    });
  }

  const CalibrationTarget& target_;
  const std::vector<TargetView>& views_;
  const BundleOptions& options_;
  std::vector<std::array<std::vector<CentrePoint>, 2>> centres_;  ///< per view and side
};

double MedianLength(const std::vector<PointResidual>& residuals) {
  std::vector<double> lengths;
  for (const PointResidual& r : residuals) {
    if (r.error_px.allFinite()) {
      lengths.push_back(r.error_px.norm());
    }
  }
  if (lengths.empty()) {
    return kNaN;
  }
  return UpperMedian(lengths);
}

/// Standard deviation of one coordinate: sum of squares over the degrees of freedom.
double ResidualSigma(const std::vector<PointResidual>& residuals, int parameters) {
  double sum = 0;
  int count = 0;
  for (const PointResidual& r : residuals) {
    if (r.error_px.allFinite()) {
      sum += r.error_px.squaredNorm();
      count += 2;
    }
  }
  return count > parameters ? std::sqrt(sum / (count - parameters)) : kNaN;
}

/// Minimises for one robust scale. Returns the number of steps taken, negative when the equations
/// cannot be solved at any damping.
int Minimise(const Bundle& bundle, const BundleOptions& options, double sigma_px, double scale_px,
             RigEstimate& estimate, bool& converged) {
  double damping = 1e-3;
  double cost = bundle.Cost(estimate, sigma_px, scale_px);
  converged = false;
  for (int i = 0; i < options.max_iterations; ++i) {
    const NormalEquations n = bundle.Linearise(estimate, sigma_px, scale_px);
    bool solved = false;
    while (damping <= kMostDamping) {
      const auto step = SolveEquations(n, options, damping);
      if (step) {
        solved = true;
        const RigEstimate moved = Apply(estimate, *step);
        const double moved_cost = bundle.Cost(moved, sigma_px, scale_px);
        if (moved_cost <= cost) {
          converged = cost - moved_cost <= options.cost_tolerance * cost;
          estimate = moved;
          cost = moved_cost;
          damping = std::max(damping * 0.1, kLeastDamping);
          break;
        }
      }
      damping *= 10;
    }
    if (!solved) {
      return -1;
    }
    if (damping > kMostDamping) {
      converged = true;  // no step downhill is left
    }
    if (converged) {
      return i + 1;
    }
  }
  return options.max_iterations;
}

}  // namespace

std::vector<PointResidual> Residuals(const CalibrationTarget& target,
                                     const std::vector<TargetView>& views,
                                     const RigEstimate& estimate) {
  PALACE_CHECK(views.size() == estimate.X_C0T.size(), views.size(), estimate.X_C0T.size());
  std::vector<PointResidual> residuals;
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (const int side : {0, 1}) {
      const RigidTransform X_CT = CameraFromTarget(estimate, side, v);
      for (const TargetPoint& point : side == 0 ? views[v].left : views[v].right) {
        const Lens& lens = estimate.lens[static_cast<std::size_t>(side)];
        const Eigen::Vector3d p_TQ = target.p_TQ(point.index);
        const auto centroid = ProjectDot(lens, X_CT, p_TQ, target.DotDiameter_m(point.index));
        const auto centre = ProjectThroughLens(lens, X_CT * p_TQ);
        PointResidual residual{static_cast<int>(v), side, point.index, point.pixel};
        residual.error_px = residual.centre = Eigen::Vector2d::Constant(kNaN);
        if (centroid && centre) {
          residual.error_px = point.pixel - centroid->pixel;
          residual.centre = point.pixel - (centroid->pixel - centre->pixel);
        }
        residuals.push_back(residual);
      }
    }
  }
  return residuals;
}

Result<BundleResult> AdjustBundle(const CalibrationTarget& target,
                                  const std::vector<TargetView>& views, const RigEstimate& start,
                                  const BundleOptions& options) {
  Bundle bundle(target, views, options);
  const int free_cameras =
      static_cast<int>(std::count(options.free.begin(), options.free.end(), true));
  const int parameters =
      free_cameras + (options.poses_free ? 6 * static_cast<int>(views.size()) : 0);
  BundleResult result;
  result.estimate = start;
  // The loss's scale and the priors' weight follow the residuals, which a poor start makes large.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const auto residuals = Residuals(target, views, result.estimate);
    const double median = MedianLength(residuals);
    if (!std::isfinite(median) || static_cast<int>(2 * residuals.size()) <= parameters) {
      return InvalidError("too few points are predicted: " + std::to_string(residuals.size()) +
                          " seen for " + std::to_string(parameters) + " unknowns");
    }
    bundle.CentreObservations(residuals);
    const double scale_px = std::max(kRobustScale * median, kLeastRobustScale_px);
    result.sigma_px =
        options.robust ? median / kMedianPerSigma : ResidualSigma(residuals, parameters);
    const int steps =
        Minimise(bundle, options, result.sigma_px, scale_px, result.estimate, result.converged);
    if (steps < 0) {
      return InvalidError("the views do not determine the cameras: singular normal equations");
    }
    result.iterations += steps;
    if (round > 0 && steps == 1) {
      break;
    }
  }
  const auto residuals = Residuals(target, views, result.estimate);
  const double scale_px = std::max(kRobustScale * MedianLength(residuals), kLeastRobustScale_px);
  result.sigma_px = options.robust ? MedianLength(residuals) / kMedianPerSigma
                                   : ResidualSigma(residuals, parameters);
  const auto covariance = CameraCovariance(
      bundle.Linearise(result.estimate, result.sigma_px, scale_px), options, result.sigma_px);
  if (!covariance) {
    return InvalidError("the views do not determine the cameras: singular normal equations");
  }
  result.covariance = *covariance;
  return result;
}

}  // namespace palace
