#include "engine/simulation/simulated_vehicle.h"

#include <cmath>

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr double kImuRate_hz = 100;
constexpr int kImuSteps = 2;
constexpr int kControlSteps = 4;
constexpr int kLaserSteps = 10;
constexpr int kGpsSteps = 40;
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
  result.p_BC = options.rig.position_body_m;
  return result;
}

/// A number no earlier flight had: an approval for another flight is refused.
std::uint64_t BootId(const SimulatorOptions& options) {
  return options.boot_id != 0 ? options.boot_id : RandomStream(options.seed, "boot").NextBits() | 1;
}

}  // namespace

SimulatedVehicle::SimulatedVehicle(const SimulatorOptions& options)
    : world_(options.scene),
      X_BC_(options.rig.X_BC()),
      now_(LeadInStart()),
      boot_id_(BootId(options)),
      rotorcraft_(R50Hover(), StartPosition(options), options.heading_rad),
      wind_(options.wind, options.seed),
      imu_(ImuNoise{}, kImuRate_hz, options.seed),
      ahrs_(AhrsNoise{}, kImuRate_hz, options.seed),
      gps_(GpsNoise{}, options.seed),
      laser_(LaserNoise{}, options.seed),
      navigator_({LeadInStart(), StartPosition(options), Vector3d::Zero()}),
      autopilot_(MakeAutopilotOptions(options, boot_id_)),
      attitude_(rotorcraft_.state().R_WB()) {
  FrameBundle discarded;
  AdvanceTo(Simulator::kEpoch, discarded);
}

void SimulatedVehicle::Receive(const VehicleMessage& message) {
  autopilot_.Receive(message, {now_, navigator_.now().p_WB, ground_down_m_});
}

void SimulatedVehicle::AdvanceTo(Timestamp until, FrameBundle& bundle) {
  while (now_ < until) {
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
  if (step_ % kControlSteps == 0) {
    StepControl();
  }
  const RotorcraftState& state = rotorcraft_.state();
  wind_W_ =
      wind_.Advance(Rotorcraft::kStep_s, HeightAboveGround(), (state.v_WB() - wind_W_).norm());
  rotorcraft_.Step(stick_, wind_W_);
  ++step_;
  now_.us += kStep_us;
  CheckGround();
  if (step_ % kImuSteps == 0) {
    StepInertial(bundle);
  }
  StepSlowSensors(bundle);
}

void SimulatedVehicle::StepControl() {
  const InertialTrack::Point& nav = navigator_.now();
  stick_ = next_stick_;
  next_stick_ = autopilot_.Control(now_, {nav.p_WB, nav.v_WB, attitude_, angular_rate_B_},
                                   rotorcraft_.frozen());
}

void SimulatedVehicle::StepInertial(FrameBundle& bundle) {
  const RotorcraftState& state = rotorcraft_.state();
  const ImuSample sample = imu_.Measure(now_, rotorcraft_.SpecificForce(), state.angular_rate_B());
  attitude_ = ahrs_.Measure(state.R_WB());
  angular_rate_B_ = sample.angular_rate_B;
  const Vector3d a_W = AccelerationInWorld(sample, attitude_);
  navigator_.Propagate(now_, a_W);
  autopilot_.Propagate(now_, a_W - navigator_.bias_W());
  bundle.imu.push_back(sample);
}

void SimulatedVehicle::StepSlowSensors(FrameBundle& bundle) {
  const RotorcraftState& state = rotorcraft_.state();
  if (step_ % kGpsSteps == 0) {
    gps_.Measure(now_, state.p_WB(), state.v_WB());
  }
  if (const std::optional<GpsFix> fix = gps_.Deliver(now_)) {
    navigator_.Update(*fix);
    bundle.gps.push_back(*fix);
  }
  if (step_ % kLaserSteps == 0) {
    bundle.laser.push_back(laser_.Measure(now_, world_, X_WB() * X_BC_));
    const Vector3d p_C(0, 0, bundle.laser.back().range_m);
    ground_down_m_ = (Pose().X_WB * X_BC_ * p_C).z();
  }
  if (step_ % kControlSteps == 0) {
    bundle.poses.push_back(Pose());
    Truth truth;
    truth.time = now_;
    truth.X_WB = X_WB();
    truth.v_WB = state.v_WB();
    bundle.truth.push_back(truth);
  }
}

void SimulatedVehicle::CheckGround() {
  if (rotorcraft_.frozen()) {
    return;
  }
  const RigidTransform X = X_WB();
  for (const Vector3d& p_B : airframe_.SkidPoints()) {
    const Vector3d p_W = X * p_B;
    const double surface = SurfaceHeight(world_, p_W.x(), p_W.y());
    if (HeightFromDown(p_W.z()) > surface) {
      continue;
    }
    Touchdown touchdown;
    touchdown.time = now_;
    touchdown.p_W_skid = X * airframe_.skid_centre_B;
    const Vector3d v = rotorcraft_.state().v_WB();
    touchdown.vertical_speed_mps = v.z();
    touchdown.horizontal_speed_mps = v.head<2>().norm();
    touchdown.tilt_rad = std::acos(std::min(1.0, X.R(2, 2)));
    touchdown.on_object = surface > world_.ground.Height(p_W.x(), p_W.y()) + 1e-6;
    touchdown_ = touchdown;
    rotorcraft_.Freeze();
    return;
  }
}

double SimulatedVehicle::HeightAboveGround() const {
  const Vector3d p = rotorcraft_.state().p_WB();
  return HeightFromDown(p.z()) - world_.ground.Height(p.x(), p.y());
}

VehiclePose SimulatedVehicle::Pose() const {
  VehiclePose pose;
  pose.time = now_;
  pose.X_WB = {attitude_, navigator_.now().p_WB};
  pose.v_WB = navigator_.now().v_WB;
  pose.angular_rate_B = angular_rate_B_;
  return pose;
}

VehicleStatus SimulatedVehicle::Status() const {
  VehicleStatus status;
  status.time = now_;
  status.boot_id = boot_id_;
  status.mode = autopilot_.mode();
  status.on_ground = rotorcraft_.frozen();
  status.flies_on_vision = autopilot_.flies_on_vision();
  status.approval_id = autopilot_.approval_id();
  const Vector3d mean = wind_.Mean(HeightAboveGround());
  status.wind_speed_mps = mean.norm();
  status.wind_from_rad = mean.norm() > 0 ? std::atan2(-mean.y(), -mean.x()) : 0;
  // about half an hour of fuel.
  status.battery_or_fuel = std::max(0.0, 1 - SecondsBetween(Simulator::kEpoch, now_) / 1800.0);
  status.simulated = true;
  return status;
}

}  // namespace palace
