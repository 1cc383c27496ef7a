#include "engine/experiments/cone_approach.h"

#include <utility>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/world/solids.h"

namespace palace {
namespace {

constexpr double kHover_m = 15.24;  // 50 ft
constexpr double kAround_m = 8;     // where it hovers, north and east
constexpr double kLimit_s = 90;

}  // namespace

ConeApproach::ConeApproach(const ConeApproachPlan& plan, SceneCameraFactory camera) : plan_(plan) {
  RandomStream random(plan.seed, "cone approach");
  const StereoRig& rig = plan.vehicle.rig;
  SimulatorOptions options;
  options.vehicle = plan.vehicle;
  options.seed = plan.seed;
  options.hover_height_m = kHover_m;
  options.start_north_m = random.Uniform(-kAround_m, kAround_m);
  options.start_east_m = random.Uniform(-kAround_m, kAround_m);
  options.wind = GustyWind(plan.wind_mps, 0);
  options.duration_limit_s = kLimit_s;
  options.render = plan.render;
  const RigidTransform X_WC =
      RigidTransform{Eigen::Matrix3d::Identity(),
                     {options.start_north_m, options.start_east_m, -kHover_m}} *
      rig.X_BC();
  const Eigen::Vector3d axis_W = X_WC.R.col(2);
  p_W_cone_ = X_WC.p - X_WC.p.z() / axis_W.z() * axis_W;
  options.scene.name = "road cone";
  options.scene.ground.texture_seed = plan.seed;
  options.scene.solids = MakeTrafficCone(p_W_cone_.x(), p_W_cone_.y(), plan.cone_height_m);
  simulator_ = std::make_shared<Simulator>(std::move(options), std::move(camera));
}

void ConeApproach::Approve(const FrameBundle& bundle) {
  Approval approval;
  approval.id = approval.site_id = approval.map_hash = approval.settings_hash =
      approval.calibration_hash = 1;
  approval.vehicle_boot_id = bundle.status->boot_id;
  approval.approved_at = bundle.time;
  approval.expires_at = AddSeconds(bundle.time, 30);
  approval.p_WS = p_W_cone_;
  approval.glide_slope_rad = -plan_.vehicle.rig.tilt_rad;
  approval.descent_rate_mps = 1;
  approval.clear_radius_m = plan_.vehicle.lander.clear_radius_m();
  simulator_->Send(approval);
  approval_ = approval;
}

void ConeApproach::GuideByTruth(const FrameBundle& bundle) {
  const Truth& truth = bundle.truth.back();
  PositionEstimate estimate;
  estimate.time = truth.time;
  estimate.source = EstimateSource::kVision;
  estimate.healthy = true;
  estimate.approval_id = approval_->id;
  estimate.p_WB = truth.X_WB.p;
  estimate.v_WB = truth.v_WB;
  simulator_->Send(estimate);
}

Result<std::optional<ApproachPicture>> ConeApproach::Next() {
  Result<std::shared_ptr<const FrameBundle>> next = simulator_->Next({});
  if (!next) {
    return next.error();
  }
  const FrameBundle& bundle = **next;
  for (const CommandAck& ack : bundle.acks) {
    if (ack.result != AckResult::kAccepted) {
      return UnavailableError("the vehicle does not fly to the cone: " + ack.reason);
    }
  }
  const VehicleMode mode = bundle.status->mode;
  descends_ = descends_ || mode == VehicleMode::kDescend;
  if (descends_ && mode != VehicleMode::kDescend) {
    return std::optional<ApproachPicture>();
  }
  if (!approval_ && SecondsBetween(Simulator::kEpoch, bundle.time) >= plan_.hover_s) {
    Approve(bundle);
  }
  if (approval_) {
    GuideByTruth(bundle);
  }
  ApproachPicture picture;
  picture.approved = approval_.has_value();
  const Timestamp exposure = bundle.stereo ? bundle.stereo->time : bundle.time;
  picture.X_WB = simulator_->TruePoseAt(exposure);
  picture.bundle = std::move(next).value();
  return std::optional<ApproachPicture>(std::move(picture));
}

}  // namespace palace
