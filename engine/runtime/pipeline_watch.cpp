// What the pipeline holds against the vehicle's own motion: laser, image time, the frame of GPS.
#include <cmath>

#include "engine/runtime/pipeline_pass.h"

namespace palace {
namespace {

constexpr double kLaserAge_s = 0.1;  // a laser range older than this is of another place
// Nearer, a decimetre of depth is a twentieth of the travel, and the ground stops the vehicle.
constexpr double kImageTimeDepth_m = 2;

}  // namespace

BeamPose Pipeline::BeamAt(Timestamp time) const {
  const RigidTransform X_WC = navigator_.PredictBodyPose(time) * rig_->X_BC();
  return {HeightFromDown(X_WC.p.z()), X_WC.R(2, 2)};
}

void Pipeline::WatchMotion(Pass& pass) {
  if (!rectifier_ || HasPicturesOnly(role_)) {
    return;
  }
  if (navigator_.frame_moves() != frame_moves_) {
    frame_moves_ = navigator_.frame_moves();
    beam_ground_m_ = NAN;
    slad_.Forget(SiteNames::kGoOn);
    pass.forgotten = true;
  }
  for (const LaserRange& range : pass.bundle->laser) {
    const BeamPose beam = BeamAt(range.time);
    laser_watch_.AddRange(range, beam);
    if (std::isnan(beam_ground_m_) && laser_watch_.usable()) {
      beam_ground_m_ = beam.camera_height_m - range.range_m * beam.beam_down;
    }
  }
  laser_watch_.Update(pass.bundle->time);
  WatchImageTime(pass);
}

void Pipeline::WatchImageTime(const Pass& pass) {
  // By the ground that stereo saw last, also where it is too near to be seen.
  const BeamPose beam = BeamAt(pass.bundle->time);
  if (std::isnan(beam_ground_m_) || !(beam.beam_down > 0)) {
    return;  // travel cannot be told from turning
  }
  const double depth_m = (beam.camera_height_m - beam_ground_m_) / beam.beam_down;
  if (depth_m < kImageTimeDepth_m) {
    image_time_.Reset();
    return;
  }
  image_time_.AddPoses(pass.bundle->poses, rectifier_->camera(), rectifier_->X_BC(*rig_), depth_m);
}

void Pipeline::WatchLaserSpot(const RangeMap& range) {
  const std::optional<double> depth_m = DepthAtSpot(range, BeamDirection());
  const double along_beam_m = depth_m ? *depth_m / BeamDirection().z() : NAN;
  const BeamPose beam = BeamAt(range.time);
  laser_watch_.AddStereo(range.time, along_beam_m, beam);
  if (depth_m) {
    beam_ground_m_ = beam.camera_height_m - along_beam_m * beam.beam_down;
  }
}

std::optional<Eigen::Vector3d> Pipeline::LaserSpot(const EngineSnapshot& snapshot) const {
  if (!laser_watch_.usable() || !snapshot.sensors->laser ||
      !std::isfinite(snapshot.sensors->laser->range_m) || !rectifier_ || !snapshot.sensors->frame ||
      std::abs(SecondsBetween(snapshot.sensors->laser->time, snapshot.sensors->frame->time)) >
          kLaserAge_s) {
    return std::nullopt;
  }
  return snapshot.sensors->laser->range_m * BeamDirection();
}

Eigen::Vector3d Pipeline::BeamDirection() const {
  // The beam runs along the axis of the raw camera, which is not the rectified one.
  return rectifier_->R_C_Rect().transpose().col(2);
}

}  // namespace palace
