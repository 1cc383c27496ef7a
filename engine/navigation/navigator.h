// Navigator: where the vehicle is. Two parallel filters, and the rule which of them is in force.
//
// The GPS filter always runs on GPS and IMU and never sees vision. The vision filter starts at
// StartVision, velocity and accelerometer bias seeded from the GPS filter, position from its first
// fix, and takes over only when it has settled and AllowVision(true) was given
// (reference: simulation.md 4). Everything goes by time
// stamp: late measurements are put where they belong and the inertial data replayed.
//
// Without any GPS (folders of pictures) the autopilot's VehiclePose is the estimate in force.
// Any one thread. Deterministic.
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/time.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/landing_site.h"
#include "engine/model/navigation_status.h"
#include "engine/model/rig.h"
#include "engine/model/settings/settings.h"
#include "engine/navigation/attitude_history.h"
#include "engine/navigation/gps_watch.h"
#include "engine/navigation/gravity_watch.h"
#include "engine/navigation/handover.h"
#include "engine/navigation/position_filter.h"
#include "engine/navigation/velocity_fade.h"
#include "engine/navigation/vision_fix.h"
#include "engine/tracking/site_tracker.h"

namespace palace {

class Navigator {
 public:
  Navigator();
  void Reset();
  /// IMU, poses and GPS of the bundle; call once per bundle, before anything else of that bundle.
  void AddSensors(const FrameBundle& bundle);
  /// X_WB at the exposure: position on the estimate in force, attitude from the AHRS, with vision's
  /// attitude correction once vision is in force. Identity before anything arrived.
  RigidTransform PredictBodyPose(Timestamp exposure) const;
  /// Starts the parallel filter at its first fix. A filter that runs already is dropped.
  void StartVision(const LandingSite& site, Timestamp time);
  /// Back to GPS, velocity cross-faded.
  void StopVision();
  /// One tracked picture: position from the landmarks by resection, or, in template mode, from the
  /// site's pixel and the laser (equations 3.1-3.12), then the vision filter.
  void AddVision(const TrackResult& track, const PinholeCamera& camera, const StereoRig& rig,
                 const FrameBundle& bundle, const TrackingSettings& settings);
  /// Approval accepted: vision may take over when it is ready. False withdraws the permission but
  /// does not switch back.
  void AllowVision(bool allowed);
  /// Grows when the GPS filter was started anew elsewhere, for GPS has settled there or the filter
  /// had refused it for 3 s: maps made before lie elsewhere, too. Never while a site is tracked.
  int frame_moves() const { return frame_moves_; }
  /// As of the last AddSensors or AddVision.
  const NavigationStatus& status() const { return status_; }
  /// How well attitudes are known from now on, in place of what poses tell of their noise.
  void SetAttitudeErrors(const AttitudeErrors& errors) { attitude_errors_ = errors; }
  /// The newest raw position that vision gave, with its whole covariance; nothing before the first.
  std::optional<PositionMeasurement> VisionPosition() const;
  /// What the vision filter says, with the errors that all fixes share; nothing while it does not
  /// run.
  std::optional<FilterEstimate> VisionFilterAt(Timestamp time) const;
  /// Vision after the hand-over, GPS before, propagated to `now`. kNone: only a pose, or nothing.
  PositionEstimate EstimateInForce(Timestamp now) const;

 private:
  struct ImuRecord {
    Timestamp time;
    Eigen::Vector3d specific_force_B = Eigen::Vector3d::Zero();
    Eigen::Vector3d mean_force_B = Eigen::Vector3d::Zero();  ///< over the step to this sample
    Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();      ///< half-way through it
  };

  void AddImu(const ImuSample& sample);
  void AddGps(const GpsFix& fix);
  void RestartGps(const GpsFix& fix);
  /// Starts the filter in the past and replays the IMU since.
  void StartFilter(PositionFilter& filter, const FilterSeed& seed, const ProcessNoise& noise) const;
  bool AttitudeKnown(Timestamp time) const;
  Result<VisionFix> MakeFix(const TrackResult& track, const PinholeCamera& camera,
                            const StereoRig& rig, const FrameBundle& bundle);
  /// By vision's filter once it runs, by that of GPS before.
  std::optional<FeltBias> Felt(Timestamp time, const Eigen::Matrix3d& R_WB) const;
  /// False: it was refused, or came too late.
  bool AddVisionFix(const PositionMeasurement& fix, double accel_noise_mps2);
  /// Moves the correction of predicted attitudes towards what a fix says.
  void Correct(const Eigen::Vector3d& attitude_W);
  FilterSeed VisionSeed(const PositionMeasurement& fix) const;
  double VelocityGap(Timestamp time) const;
  void UpdateHandover(Timestamp time);
  void UpdateStatus();
  PositionEstimate PoseEstimate(Timestamp now) const;
  PositionEstimate GpsEstimate(Timestamp now) const;
  PositionEstimate VisionEstimate(Timestamp now) const;

  AttitudeHistory poses_;
  std::deque<ImuRecord> imu_;
  PositionFilter gps_;
  GpsWatch gps_watch_;
  GravityWatch gravity_watch_;
  int frame_moves_ = 0;
  PositionFilter vision_{/*measures_scatter=*/true};
  Handover handover_;
  std::optional<LandingSite> site_;
  std::optional<AttitudeErrors> attitude_errors_;
  LandmarkFrame landmark_frame_;         ///< by the fixes that were taken
  std::optional<VisionFix> vision_fix_;  ///< the newest; of one that was refused, its position
  bool have_pose_stream_ = false;
  std::optional<LaserRange> laser_;  ///< newest with a return
  VelocityFade fade_;                ///< from what was in force before
  /// In force at `now_` before the newest bundle's GPS: what was sent last, carried on by inertia.
  Eigen::Vector3d carried_v_WB_ = Eigen::Vector3d::Zero();
  /// As in VisionFix, smoothed.
  Eigen::Vector3d attitude_correction_W_ = Eigen::Vector3d::Zero();
  Timestamp now_;
  NavigationStatus status_;
};

}  // namespace palace
