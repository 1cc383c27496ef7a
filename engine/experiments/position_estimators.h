// PositionEstimators: the thesis's seven steps and the resection of landmarks, each through its own
// navigator, on the same pictures.
//
//   kResection      the plane tracker's landmarks (tracking/plane_tracker.h)
//   kSevenSteps     the pixel of a feature that is followed without a pose, started where a person
//                   pointed (tracking/feature_follower.h), attitude and laser
//   kThesisTemplate the same from the thesis's template, refreshed every picture, started where the
//                   site was believed to be (tracking/template_tracker.h)
//
// Each is told where the site is as a map would: the feature's pixel on the ground that stereo
// measured, from the poses that the estimator believed, averaged over the hover. Errors are of the
// position relative to the feature, told against true, so that what the station's frame and GPS
// share does not count and what a landing feels does.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/experiments/cone_approach.h"
#include "engine/experiments/position_pictures.h"
#include "engine/navigation/navigator.h"
#include "engine/simulation/attitude_sensor.h"
#include "engine/tracking/feature_follower.h"
#include "engine/tracking/site_tracker.h"

namespace palace {

enum class PositionEstimator : std::uint8_t { kResection, kSevenSteps, kThesisTemplate };
inline constexpr std::array kPositionEstimators = {PositionEstimator::kResection,
                                                   PositionEstimator::kSevenSteps,
                                                   PositionEstimator::kThesisTemplate};
/// "resection", "seven-steps", "thesis-template".
const char* NameOf(PositionEstimator estimator);

enum class AttitudeQuality : std::uint8_t {
  kPerfect,
  kVehicle,  ///< as the vehicle's file says
  kPoor,     ///< 0.3 deg of noise on every pose and a bias of 0.3 deg (one standard deviation)
};
inline constexpr std::array kAttitudeQualities = {
    AttitudeQuality::kPerfect, AttitudeQuality::kVehicle, AttitudeQuality::kPoor};
/// "perfect", "vehicle", "0.3 deg".
const char* NameOf(AttitudeQuality attitude);
/// What a navigator is told of it, `vehicle` being what the vehicle's file says.
AttitudeErrors StatedErrors(AttitudeQuality attitude, const AhrsNoise& vehicle);

/// An error of a position with the covariance that was stated for it.
struct PositionError {
  Eigen::Vector3d e_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Identity();

  /// e' P^-1 e / 3; 1 in the mean where the covariance is honest.
  double NeesPerDof() const;
  /// e_i^2 / P_ii.
  Eigen::Vector3d NeesOfAxes() const;
};

/// What one picture gave, after the site was told.
struct PositionSample {
  Timestamp time;
  Eigen::Vector3d true_m = Eigen::Vector3d::Zero();  ///< B from the feature: north, east, down
  std::optional<PositionError> raw;
  std::optional<PositionError> filtered;
  /// Normalised innovation squared of that raw position, per degree of freedom; NaN: none judged.
  double nis_per_dof = NAN;
  bool refused = false;
};

/// Attitudes of one quality, for all estimators alike: the bundle with its poses replaced.
class AttitudeOf {
 public:
  AttitudeOf(AttitudeQuality quality, std::uint64_t seed);
  std::shared_ptr<const FrameBundle> Told(const std::shared_ptr<const FrameBundle>& bundle,
                                          const ConeApproach& approach);

 private:
  AttitudeQuality quality_;
  AhrsSensor sensor_;
};

class EstimatorRun {
 public:
  EstimatorRun(PositionEstimator estimator, const TrackingSettings& settings,
               const AttitudeErrors& attitude, const Eigen::Vector3d& p_W_feature);

  /// What the vehicle told with a picture, or without one where a pair never came; every bundle, in
  /// order, before its picture.
  void AddSensors(const FrameBundle& bundle) { navigator_.AddSensors(bundle); }
  /// The picture of that bundle. `followed`: what the follower says of the feature; only of
  /// kSevenSteps and after the site was told. `tell`: from this picture on the site is told and
  /// tracked.
  void AddPicture(const FrameBundle& bundle, const StereoRig& rig, const MeasuredPicture& picture,
                  const RigidTransform& X_WB_true, const FollowedFeature* followed, bool tell);
  const std::vector<PositionSample>& samples() const { return samples_; }
  const NavigationStatus& navigation() const { return navigator_.status(); }

 private:
  void MapSite(const MeasuredPicture& picture, const RigidTransform& X_WC,
               const Eigen::Vector2d& pixel);
  TrackResult Track(const MeasuredPicture& picture, const RigidTransform& X_WC,
                    const FollowedFeature* followed, Timestamp time);
  PositionError ErrorOf(const Eigen::Vector3d& p_WB, const Eigen::Matrix3d& covariance_m2,
                        const Eigen::Vector3d& p_WB_true) const;

  PositionEstimator estimator_;
  TrackingSettings settings_;
  Eigen::Vector3d p_W_feature_;
  Navigator navigator_;
  SiteTracker tracker_;
  Eigen::Vector3d site_sum_ = Eigen::Vector3d::Zero();
  int site_count_ = 0;
  std::optional<LandingSite> site_;
  std::vector<PositionSample> samples_;
};

}  // namespace palace
