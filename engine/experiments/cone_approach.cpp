#include "engine/experiments/cone_approach.h"

#include <utility>

#include "engine/core/random.h"
#include "engine/experiments/slope_foot.h"
#include "engine/world/solids.h"

namespace palace {
namespace {

constexpr double kHover_m = 15.24;  // 50 ft
constexpr double kAround_m = 8;     // where it hovers, north and east
constexpr double kLimit_s = 90;

}  // namespace

Result<ConeApproach> ConeApproach::Make(const ConeApproachPlan& plan, SceneCameraFactory camera) {
  RandomStream random(plan.seed, "cone approach");
  SimulatorOptions options;
  options.vehicle = plan.vehicle;
  options.seed = plan.seed;
  options.hover_height_m = kHover_m;
  options.start_north_m = random.Uniform(-kAround_m, kAround_m);
  options.start_east_m = random.Uniform(-kAround_m, kAround_m);
  options.wind = GustyWind(plan.wind_mps, 0);
  options.duration_limit_s = kLimit_s;
  options.render = plan.render;
  const Result<Eigen::Vector3d> p_W_cone =
      SlopeFoot(plan.vehicle, {options.start_north_m, options.start_east_m, -kHover_m});
  if (!p_W_cone) {
    return p_W_cone.error();
  }
  options.scene.name = "road cone";
  options.scene.ground.texture_seed = plan.seed;
  options.scene.solids = MakeTrafficCone(p_W_cone->x(), p_W_cone->y(), plan.cone_height_m);
  return ConeApproach(plan, *p_W_cone,
                      std::make_shared<Simulator>(std::move(options), std::move(camera)));
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
