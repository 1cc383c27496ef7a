#include "engine/calibration/rig_start.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/calibration/tsai_start.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kMostStartSigma_px = 3;  // one camera alone; more is another target or a bad board
constexpr double kStartTolerance = 1e-5;  // a start need not be the minimum
constexpr double kPairAngle_rad = 0.05;   // relative pose of one view against the others'
constexpr double kPairShift = 0.1;        // of the distance to the board

/// One camera, as the left one of a rig without right pictures.
struct OneCamera {
  std::vector<std::size_t> views;  ///< places in the caller's list
  std::vector<TargetView> seen;
  RigEstimate estimate;
  double sigma_px = 0;
};

BundleOptions LensOnly(const std::vector<LensIndex>& free, const LensPrior& prior) {
  BundleOptions options;
  options.prior = prior;
  options.cost_tolerance = kStartTolerance;
  for (const LensIndex index : free) {
    options.free[index] = true;
  }
  return options;
}

/// The pose of one view with the lens fixed, from a given start; nothing when it does not fit.
std::optional<std::pair<RigidTransform, double>> FitPose(const CalibrationTarget& target,
                                                         const TargetView& view, const Lens& lens,
                                                         const RigidTransform& start) {
  RigEstimate estimate;
  estimate.lens[0] = lens;
  estimate.X_C0T = {start};
  const auto fitted = AdjustBundle(target, {view}, estimate, LensOnly({}, LensPrior{}));
  if (!fitted) {
    return std::nullopt;
  }
  return std::pair(fitted->estimate.X_C0T[0], fitted->sigma_px);
}

/// A flat board has a second pose that looks nearly the same, tilted the other way: its normal
/// mirrored about the line of sight.
RigidTransform OtherTilt(const CalibrationTarget& target, const RigidTransform& X_CT) {
  const Eigen::Vector3d middle_T = (target.p_TQ(0) + target.p_TQ(target.point_count() - 1)) / 2;
  const Eigen::Vector3d middle_C = X_CT * middle_T;
  const Eigen::Vector3d sight = middle_C.normalized();
  const Eigen::Vector3d normal = X_CT.R.col(2);
  const Eigen::Vector3d mirrored = 2 * normal.dot(sight) * sight - normal;
  RigidTransform other;
  other.R = Eigen::Quaterniond::FromTwoVectors(normal, mirrored).toRotationMatrix() * X_CT.R;
  other.p = middle_C - other.R * middle_T;
  return other;
}

void TryOtherTilts(const CalibrationTarget& target, OneCamera& camera) {
  for (std::size_t i = 0; i < camera.seen.size(); ++i) {
    RigidTransform& X_CT = camera.estimate.X_C0T[i];
    const auto as_is = FitPose(target, camera.seen[i], camera.estimate.lens[0], X_CT);
    const auto other =
        FitPose(target, camera.seen[i], camera.estimate.lens[0], OtherTilt(target, X_CT));
    if (as_is) {
      X_CT = as_is->first;
    }
    if (other && (!as_is || other->second < 0.9 * as_is->second)) {
      X_CT = other->first;
    }
  }
}

Result<OneCamera> FitOneCamera(const CalibrationTarget& target,
                               const std::vector<TargetView>& views, int side, int width,
                               int height, const LensPrior& prior) {
  const std::string name = side == 0 ? "left" : "right";
  OneCamera camera;
  std::vector<TargetObservation> observations;
  std::vector<std::size_t> places;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const TargetObservation& seen = side == 0 ? views[v].left : views[v].right;
    if (!seen.empty()) {
      observations.push_back(seen);
      places.push_back(v);
    }
  }
  const auto start = StartFromRadialAlignment(target, observations, width, height);
  if (!start) {
    return InvalidError("the " + name +
                        " pictures tell no focal length: the board is parallel to the picture in "
                        "all of them; add views with the board tilted by 20 to 45 degrees");
  }
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (start->X_CT[i]) {
      camera.views.push_back(places[i]);
      camera.seen.push_back({views[places[i]].name, observations[i], {}});
      camera.estimate.X_C0T.push_back(*start->X_CT[i]);
    }
  }
  camera.estimate.lens[0] << start->focal_px, (width - 1) / 2.0, start->focal_px,
      (height - 1) / 2.0, 0, 0, 0, 0;
  const std::vector<std::vector<LensIndex>> stages = {
      {kHs, kVs, kRho1}, {kHs, kHc, kVs, kVc, kRho1}, {kHs, kHc, kVs, kVc, kO1, kO2, kRho1, kRho2}};
  TryOtherTilts(target, camera);
  for (const auto& free : stages) {
    const auto fitted = AdjustBundle(target, camera.seen, camera.estimate, LensOnly(free, prior));
    if (!fitted) {
      return InvalidError("the " + name + " camera alone: " + fitted.error().message);
    }
    camera.estimate = fitted->estimate;
    camera.sigma_px = fitted->sigma_px;
  }
  if (!(camera.sigma_px < kMostStartSigma_px)) {
    return InvalidError("the " + name + " camera alone leaves " + std::to_string(camera.sigma_px) +
                        " px of error; does TARGET.toml describe the board in the pictures, and is "
                        "the board flat?");
  }
  return camera;
}

double AngleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return std::abs(Eigen::AngleAxisd(a.transpose() * b).angle());
}

/// The relative pose that one view gives, with the distance at which the board was.
struct PairPose {
  std::string name;
  RigidTransform X_C0C1;
  double distance_m = 0;
};

/// Difference of two relative poses, 1 at the limits.
double Disagreement(const PairPose& a, const PairPose& b) {
  return AngleBetween(a.X_C0C1.R, b.X_C0C1.R) / kPairAngle_rad +
         (a.X_C0C1.p - b.X_C0C1.p).norm() / (kPairShift * std::max(a.distance_m, b.distance_m));
}

/// The view whose relative pose is nearest to all others'; refuses lists that contradict it.
Result<RigidTransform> AgreedPose(const std::vector<PairPose>& pairs) {
  if (pairs.empty()) {
    return InvalidError(
        "no view shows the board to both cameras; hold it where the pictures overlap");
  }
  const PairPose* best = nullptr;
  double least = 0;
  for (const PairPose& candidate : pairs) {
    double sum = 0;
    for (const PairPose& other : pairs) {
      sum += std::min(Disagreement(candidate, other), 3.0);
    }
    if (best == nullptr || sum < least) {
      best = &candidate;
      least = sum;
    }
  }
  std::string contradicting;
  std::size_t count = 0;
  for (const PairPose& other : pairs) {
    if (Disagreement(*best, other) > 2) {
      contradicting += (contradicting.empty() ? "" : ", ") + other.name;
      ++count;
    }
  }
  if (3 * count >= pairs.size() && count > 0) {
    return InvalidError("the place of the right camera differs from view to view (" +
                        contradicting +
                        "): do both lists of pictures have the same order, and was the board still "
                        "for each pair?");
  }
  return best->X_C0C1;
}

}  // namespace

Result<RigEstimate> StartRig(const CalibrationTarget& target, const std::vector<TargetView>& views,
                             int width, int height, const LensPrior& prior) {
  const auto left = FitOneCamera(target, views, 0, width, height, prior);
  if (!left) {
    return left.error();
  }
  const auto right = FitOneCamera(target, views, 1, width, height, prior);
  if (!right) {
    return right.error();
  }
  std::vector<std::optional<RigidTransform>> X_C0T(views.size()), X_C1T(views.size());
  for (std::size_t i = 0; i < left->views.size(); ++i) {
    X_C0T[left->views[i]] = left->estimate.X_C0T[i];
  }
  for (std::size_t i = 0; i < right->views.size(); ++i) {
    X_C1T[right->views[i]] = right->estimate.X_C0T[i];
  }
  std::vector<PairPose> pairs;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (X_C0T[v] && X_C1T[v]) {
      pairs.push_back(
          {views[v].name + (views[v].right_name.empty() ? "" : " with " + views[v].right_name),
           *X_C0T[v] * X_C1T[v]->Inverse(), X_C0T[v]->p.norm()});
    }
  }
  const auto X_C0C1 = AgreedPose(pairs);
  if (!X_C0C1) {
    return X_C0C1.error();
  }
  RigEstimate estimate;
  estimate.lens = {left->estimate.lens[0], right->estimate.lens[0]};
  estimate.X_C0C1 = *X_C0C1;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!X_C0T[v] && !X_C1T[v]) {
      return InvalidError(views[v].name + ": the board's pose cannot be found; leave it out");
    }
    estimate.X_C0T.push_back(X_C0T[v] ? *X_C0T[v] : *X_C0C1 * *X_C1T[v]);
  }
  return estimate;
}

}  // namespace palace
