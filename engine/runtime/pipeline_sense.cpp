// What the pipeline makes of sensors and pictures: the rig, rectified pairs, ranges of the ground.
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/text.h"
#include "engine/model/mission/picture_faults.h"
#include "engine/runtime/decision_hash.h"
#include "engine/runtime/pipeline_pass.h"
#include "engine/stereo/range_measurement.h"
#include "engine/stereo/stereo_quality.h"

namespace palace {
namespace {

constexpr double kPoseAge_s = 0.2;  // of the pose to a pair; an older one makes no map

std::string WhyNoMap(const MissionStatus& mission, double commit_height_m) {
  if (mission.state == MissionState::kLanded) {
    return "On the ground no map is made";
  }
  const bool committed = mission.state == MissionState::kDescending && !mission.IsLook() &&
                         mission.height_above_site_m < commit_height_m;
  return committed
             ? WithNumbers("Below %.1f m no map is made, the last verdict stands", commit_height_m)
             : std::string();
}

void TakeFrozen(const FrozenCameras& frozen, StereoQuality& quality) {
  quality.left_frozen = frozen.left;
  quality.right_frozen = frozen.right;
}

}  // namespace

void Pipeline::PrepareRig(Pass& pass) {
  const auto& rig = pass.bundle->rig;
  if (rig && rig != rig_) {
    const std::uint64_t hash = HashOf(*rig);
    if (!rig_ || hash != calibration_hash_) {
      if (rig_) {
        ForgetOldRig(pass);
      }
      Result<StereoRectifier> made = StereoRectifier::Make(*rig);
      rig_problem_ = made ? std::string() : made.error().message;
      rectifier_.reset();
      if (made) {
        rectifier_.emplace(std::move(*made));
      }
      calibration_hash_ = hash;
    }
    rig_ = rig;
  }
  pass.snapshot->sensors.Edit().rig = rig_;
  if (!rig_problem_.empty()) {
    pass.Note(DiagnosticLevel::kError, "camera", rig_problem_);
  }
}

/// Other cameras: what the old ones measured is not fused with what these measure, nor tracked on.
/// What was armed is dropped by the mission, which holds the calibration against it.
void Pipeline::ForgetOldRig(Pass& pass) {
  slad_.Forget(SiteNames::kGoOn);
  pass.forgotten = true;
  tracker_.Reset();
  laser_watch_.Reset();
  image_time_.Reset();
  range_check_.Reset();
  frozen_check_.Reset();
  laser_height_m_.reset();
  beam_ground_m_ = NAN;
  TerrainPart& terrain = pass.snapshot->terrain.Edit();
  terrain.range = nullptr;
  terrain.applied = terrain.preview = terrain.recorded = nullptr;
  terrain.site_review.reset();
}

void Pipeline::See(Pass& pass) {
  SensorsPart& sensors = pass.snapshot->sensors.Edit();
  const FrameBundle& bundle = *pass.bundle;
  for (const CameraCounters& camera : pass.session.source.cameras) {
    if (!camera.problem.empty()) {
      pass.Note(DiagnosticLevel::kError, "camera", camera.problem);
    }
  }
  channels_.Add(bundle, !HasPicturesOnly(role_));
  navigator_.AddSensors(bundle);
  for (const VehiclePose& pose : bundle.poses) {
    rate_attitude_.Add(pose);
  }
  if (bundle.pose_at_exposure) {
    sensors.pose = bundle.pose_at_exposure;
  } else if (!bundle.poses.empty()) {
    sensors.pose = bundle.poses.back();
  }
  if (bundle.status) {
    sensors.vehicle = bundle.status;
  }
  if (!bundle.laser.empty()) {
    sensors.laser = bundle.laser.back();
  }
  if (!bundle.truth.empty()) {
    sensors.truth = bundle.truth.back();
  }
  WatchMotion(pass);
  if (!bundle.stereo || !rectifier_) {
    return;
  }
  sensors.frame = bundle.stereo;
  sensors.X_WC = navigator_.PredictBodyPose(bundle.stereo->time) * rectifier_->X_BC(*rig_);
  if (const auto spot = LaserSpot(*pass.snapshot)) {
    laser_height_m_ = HeightFromDown((sensors.X_WC * *spot).z());
  }
  pass.Run("rectify", [&] {
    Result<RectifiedPair> pair = rectifier_->Rectify(*bundle.stereo);
    if (!pair) {
      pass.Note(DiagnosticLevel::kError, "camera", pair.error().message);
      return;
    }
    pass.pair = *pair;
    sensors.left_rectified = pair->left;
    sensors.right_rectified = pair->right;
    if (!HasPicturesOnly(role_)) {
      image_time_.AddPictures(pair->left.get(), pair->right.get(), bundle.stereo->time);
    }
  });
}

double Pipeline::GroundHeight() const {
  if (const auto& armed = MissionInForce().armed) {
    return HeightFromDown(armed->p_WS.z());
  }
  if (laser_height_m_) {
    return *laser_height_m_;
  }
  return 0;
}

double Pipeline::DepthOfGround(const RigidTransform& X_WC) const {
  const double axis_down = X_WC.R(2, 2);
  const bool known = MissionInForce().armed || laser_height_m_;
  return known && axis_down > 0.1 ? (HeightFromDown(X_WC.p.z()) - GroundHeight()) / axis_down : NAN;
}

double Pipeline::SigmaOfPosition() const {
  const FilterStatus& filter = navigator_.status().InForce();
  return filter.running ? filter.estimate.sigma_p_m.maxCoeff() : NAN;
}

std::optional<ViewPose> Pipeline::PoseOfPair(const Pass& pass) const {
  const auto& pose = pass.snapshot->sensors->pose;
  if (!pose || std::abs(SecondsBetween(pose->time, pass.bundle->stereo->time)) > kPoseAge_s) {
    return std::nullopt;
  }
  return ViewPose{pass.snapshot->sensors->X_WC, pose->sigmas};
}

FrozenCameras Pipeline::WhichFrozen(const Pass& pass, bool posed) {
  const Timestamp exposure = pass.bundle->stereo->time;
  // An attitude that is off has not turned the camera: a picture that stays need be no repeat.
  const auto R_WB = rate_attitude_.At(exposure, FrozenCheck::kOldest_s);
  RigidTransform X_WC = pass.snapshot->sensors->X_WC;
  const double depth_m = posed && R_WB ? DepthOfGround(X_WC) : NAN;
  X_WC.R = R_WB ? *R_WB * rectifier_->X_BC(*rig_).R : X_WC.R;
  return frozen_check_.Add({.time = exposure,
                            .left = pass.pair.left,
                            .right = pass.pair.right,
                            .X_WC = X_WC,
                            .camera = rectifier_->camera(),
                            .depth_m = depth_m,
                            .sigma_p_m = SigmaOfPosition()});
}

void Pipeline::MeasureRange(Pass& pass) {
  if (!pass.pair.left || !pass.pair.right) {
    return;
  }
  const Settings& settings = settings_.recorded();
  const std::string why_not = WhyNoMap(MissionInForce(), settings.slad.fusion.commit_height_m);
  if (pass.snapshot->terrain->why_no_map != why_not) {
    pass.snapshot->terrain.Edit().why_no_map = why_not;
  }
  const bool due =
      stereo_frames_++ % static_cast<std::uint64_t>(settings.stereo.map_every_frames) == 0;
  if (!due) {
    return;
  }
  if (!why_not.empty()) {
    if (MissionInForce().state == MissionState::kDescending) {
      // No map is made near the ground, but what steers there are these pictures.
      StereoQuality& quality = pass.snapshot->terrain.Edit().stereo_quality;
      SuspectPictures(*pass.pair.left, *pass.pair.right, quality);
      TakeFrozen(WhichFrozen(pass, PoseOfPair(pass).has_value()), quality);
      pass.new_stereo = true;
    }
    return;
  }
  const std::optional<ViewPose> pose = PoseOfPair(pass);
  Result<StereoResult> result = MeasureRanges({.raw = *pass.bundle->stereo,
                                               .pair = pass.pair,
                                               .rig = *rig_,
                                               .rectifier = *rectifier_,
                                               .pose = pose,
                                               .ground_height_m = GroundHeight()},
                                              settings.stereo, matcher_);
  if (!result) {
    pass.Note(DiagnosticLevel::kError, "stereo", result.error().message);
    return;
  }
  TakeFrozen(WhichFrozen(pass, pose.has_value()), result->quality);
  pass.snapshot->terrain.Edit().stereo_quality = result->quality;
  pass.new_stereo = true;
  if (result->quality.suspect_covered) {
    pass.Note(DiagnosticLevel::kWarning, "stereo",
              "one camera shows nothing while the other does; it may be covered");
  }
  if (result->quality.suspect_same) {
    pass.Note(DiagnosticLevel::kWarning, "stereo",
              "left and right are the same picture; check the capture devices");
  }
  auto range = std::make_shared<const RangeMap>(std::move(result->range));
  pass.snapshot->terrain.Edit().range = range;
  if (!pose) {
    pass.Note(DiagnosticLevel::kWarning, "slad",
              std::string("attitude and height are unknown, so ranges make no map; ") +
                  (HasPicturesOnly(role_) ? "add [pose] to RIG.toml"
                                          : "no VEHICLE_POSE is within 0.2 s of them"));
    return;
  }
  const PictureFaults faults = JudgePictures(pass.snapshot->terrain->stereo_quality, role_);
  if (faults.frozen() || faults.blank() || faults.swapped) {
    slad_.DoubtViews();
    return;  // what it shows is no ground of now
  }
  WatchLaserSpot(*range);
  if (const auto spot = LaserSpot(*pass.snapshot)) {
    range_check_.Add(*range, *spot);
    pass.snapshot->terrain.Edit().range_agreement = range_check_.agreement();
  }
  slad_.Add({.view = {pass.pair.left, pass.pair.right, range},
             .p_WB = navigator_.PredictBodyPose(range->time).p},
            settings.slad);
  pass.new_map = true;
  maps_to_rebuild_ = std::max(0, maps_to_rebuild_ - 1);
}

}  // namespace palace
