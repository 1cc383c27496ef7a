#include "engine/simulation/simulated_vehicle.h"

#include <cmath>

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr double kAuthorityPeriod_s = 1;

Vector3d StartPosition(const SimulatorOptions& options) {
  const double ground = options.scene.ground.Height(options.start_north_m, options.start_east_m);
  return {options.start_north_m, options.start_east_m, -(ground + options.hover_height_m)};
}

Timestamp LeadInStart() { return AddSeconds(Simulator::kEpoch, -SimulatedVehicle::kLeadIn_s); }

AutopilotOptions MakeAutopilotOptions(const SimulatorOptions& options, std::uint64_t boot_id) {
  AutopilotOptions result;
  result.trust.boot_id = boot_id;
  result.trust.takes_unsealed = !options.keys;
  result.trust.keys = options.keys.value_or(std::vector<SecretKey>());
  if (options.boot_id == 0) {
    // The same flight for the same seed: no bus reaches it.
    auto words = std::make_shared<RandomStream>(options.seed, "authority");
    result.trust.random_word = [words] { return words->NextBits() | 1; };
  }
  result.hover_p_WB = StartPosition(options);
  result.hover_yaw_rad = options.heading_rad;
  const VehicleDescription& vehicle = options.vehicle;
  result.vehicle = {vehicle.rig.position_body_m, vehicle.lander.skid_centre_B(),
                    vehicle.limits.settle_s};
  result.limits = vehicle.limits;
  result.gains = vehicle.gains;
  result.control_period_s = 1 / vehicle.actuators.control_rate_hz;
  return result;
}

/// What a clock shows that was right at kEpoch and gains `drift`.
Timestamp Reading(Timestamp true_time, double drift) {
  return AddSeconds(true_time, drift * SecondsBetween(Simulator::kEpoch, true_time));
}

/// A number no earlier flight had: an approval for another flight is refused.
std::uint64_t BootId(const SimulatorOptions& options) {
  return options.boot_id != 0 ? options.boot_id : RandomStream(options.seed, "boot").NextBits() | 1;
}

}  // namespace

SimulatedVehicle::SimulatedVehicle(const SimulatorOptions& options)
    : world_(options.scene),
      vehicle_(options.vehicle),
      X_BC_(vehicle_.rig.X_BC()),
      true_now_(LeadInStart()),
      now_(Reading(true_now_, vehicle_.clock_drift)),
      boot_id_(BootId(options)),
      aircraft_(vehicle_, options.wind, options.seed,
                {now_, StartPosition(options), options.heading_rad}),
      laser_(vehicle_.sensors.laser, options.seed),
      autopilot_(MakeAutopilotOptions(options, boot_id_)) {
  FrameBundle discarded;
  AdvanceTo(Simulator::kEpoch, discarded);
}

void SimulatedVehicle::Receive(const VehicleMessage& message) {
  autopilot_.Receive(message, {now_, aircraft_.navigator().now().p_WB, ground_down_m_});
}

void SimulatedVehicle::SetRig(const StereoRig& rig) {
  vehicle_.rig = rig;
  X_BC_ = rig.X_BC();
}

void SimulatedVehicle::AdvanceTo(Timestamp until, FrameBundle& bundle) {
  while (true_now_ < until) {
    Step(bundle);
  }
  for (CommandAck& ack : autopilot_.TakeAcks()) {
    bundle.acks.push_back(std::move(ack));
  }
  if (autopilot_.authority().TakeNews() ||
      SecondsBetween(authority_told_, now_) >= kAuthorityPeriod_s) {
    bundle.authority = autopilot_.authority().Report(now_);
    authority_told_ = now_;
  }
}

void SimulatedVehicle::Step(FrameBundle& bundle) {
  if (aircraft_.IsDue(vehicle_.actuators.control_rate_hz)) {
    aircraft_.Command(autopilot_.Control(now_, aircraft_.Believed(), aircraft_.frozen()));
  }
  aircraft_.StepPhysics(HeightAboveGround());
  true_now_.us += kStep_us;
  now_ = Reading(true_now_, vehicle_.clock_drift);
  CheckGround();
  if (const auto inertial = aircraft_.StepInertial(now_)) {
    autopilot_.Propagate(now_, inertial->a_W - aircraft_.navigator().bias_W());
    bundle.imu.push_back(inertial->sample);
  }
  StepSlowSensors(bundle);
  history_.Add(X_WB(), Pose());
}

void SimulatedVehicle::StepSlowSensors(FrameBundle& bundle) {
  if (const std::optional<GpsFix> fix = aircraft_.StepGps(now_)) {
    bundle.gps.push_back(*fix);
  }
  if (aircraft_.IsDue(vehicle_.sensors.laser_rate_hz)) {
    bundle.laser.push_back(laser_.Measure(now_, world_, X_WB() * X_BC_));
    const Vector3d p_C(0, 0, bundle.laser.back().range_m);
    ground_down_m_ = (Pose().X_WB * X_BC_ * p_C).z();
  }
  if (aircraft_.IsDue(vehicle_.actuators.control_rate_hz)) {
    untold_.push_back(Pose());
    Truth truth;
    truth.time = now_;
    truth.X_WB = X_WB();
    truth.v_WB = aircraft_.body().v_WB();
    bundle.truth.push_back(truth);
  }
  TellPoses(bundle);
}

void SimulatedVehicle::TellPoses(FrameBundle& bundle) {
  const Timestamp told = AddSeconds(now_, -vehicle_.sensors.attitude.delay_s);
  while (!untold_.empty() && untold_.front().time <= told) {
    bundle.poses.push_back(untold_.front());
    untold_.pop_front();
  }
}

void SimulatedVehicle::CheckGround() {
  if (aircraft_.frozen()) {
    return;
  }
  const RigidTransform X = X_WB();
  for (const Vector3d& p_B : GearPoints(vehicle_.lander)) {
    const Vector3d p_W = X * p_B;
    const double surface = SurfaceHeight(world_, p_W.x(), p_W.y());
    if (HeightFromDown(p_W.z()) > surface) {
      continue;
    }
    Touchdown touchdown;
    touchdown.time = now_;
    touchdown.p_W_skid = X * vehicle_.lander.skid_centre_B();
    const Vector3d v = aircraft_.body().v_WB();
    touchdown.vertical_speed_mps = v.z();
    touchdown.horizontal_speed_mps = v.head<2>().norm();
    touchdown.tilt_rad = std::acos(std::min(1.0, X.R(2, 2)));
    touchdown.on_object = surface > world_.ground.Height(p_W.x(), p_W.y()) + 1e-6;
    touchdown.ground_tilt_rad = GroundTilt(X);
    touchdown.limits = vehicle_.gear;
    touchdown_ = touchdown;
    aircraft_.Freeze();
    return;
  }
}

double SimulatedVehicle::GroundTilt(const RigidTransform& X_WB) const {
  const auto ends = GearPoints(vehicle_.lander);  // the centre, then the four ends
  std::array<Vector3d, 4> on_ground;
  for (std::size_t i = 0; i < 4; ++i) {
    on_ground[i] = X_WB * ends[i + 1];
    on_ground[i].z() = -SurfaceHeight(world_, on_ground[i].x(), on_ground[i].y());
  }
  // Fore right, fore left, aft right, aft left: the diagonals span the mean plane.
  const Vector3d normal =
      (on_ground[0] - on_ground[3]).cross(on_ground[1] - on_ground[2]).normalized();
  return std::acos(std::min(1.0, std::abs(normal.z())));
}

double SimulatedVehicle::HeightAboveGround() const {
  const Vector3d p = aircraft_.body().p_WB;
  return HeightFromDown(p.z()) - world_.ground.Height(p.x(), p.y());
}

VehiclePose SimulatedVehicle::Pose() const {
  VehiclePose pose;
  pose.time = now_;
  const FlightState believed = aircraft_.Believed();
  pose.X_WB = {believed.R_WB, believed.p_WB};
  pose.v_WB = believed.v_WB;
  pose.angular_rate_B = believed.angular_rate_B;
  return pose;
}

VehicleStatus SimulatedVehicle::Status() const {
  VehicleStatus status;
  status.time = now_;
  status.boot_id = boot_id_;
  status.mode = autopilot_.mode();
  status.on_ground = aircraft_.frozen();
  status.flies_on_vision = autopilot_.flies_on_vision();
  status.approval_id = autopilot_.approval_id();
  const Vector3d mean = aircraft_.wind().Mean(HeightAboveGround());
  status.wind_speed_mps = mean.norm();
  status.wind_from_rad = mean.norm() > 0 ? std::atan2(-mean.y(), -mean.x()) : 0;
  status.battery_or_fuel =
      std::max(0.0, 1 - SecondsBetween(Simulator::kEpoch, now_) / vehicle_.limits.endurance_s);
  status.simulated = true;
  return status;
}

}  // namespace palace
