#include "engine/simulation/simulator.h"

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/pace.h"
#include "engine/core/units.h"
#include "engine/simulation/simulated_vehicle.h"
#include "engine/simulation/stereo_cameras.h"

namespace palace {
namespace {

constexpr double kSameMoment_s = 1e-6;

Error Ended(const char* why) { return {ErrorCode::kEnd, why}; }

}  // namespace

/// What other threads may touch lies behind the mutex; the rest belongs to the thread of Next().
struct Simulator::State {
  State(SimulatorOptions given, SceneCameraFactory factory)
      : options(std::move(given)),
        camera_factory(std::move(factory)),
        rig(std::make_shared<const StereoRig>(options.vehicle.rig)),
        cameras(options.vehicle, kEpoch, options.seed),
        vehicle(options) {
    status.kind = SourceKind::kSimulation;
    const std::string& flown = options.vehicle.name;
    status.name =
        options.scene.name + (flown == DefaultVehicle().name ? std::string() : ", " + flown);
    status.speed = options.speed;
    status.start = kEpoch;
    status.duration_s = options.duration_limit_s;
    SimulationStatus& simulation = status.simulation.emplace();
    simulation.began.wind_mps = options.wind.mean_mps;
    simulation.began.wind_from_deg = Deg(options.wind.from_rad);
    ReadRig(*rig, simulation.began);
    simulation.in_force = simulation.asked = simulation.began;
    GrantOwnStation();
  }

  bool WaitForTurn(std::stop_token stop);
  void TakeChanges();
  double period_s() const { return 1 / rig->rate_hz; }
  void GrantOwnStation();
  Timestamp heard_at() const { return AddSeconds(kEpoch, heard_s); }
  Result<std::shared_ptr<const StereoFrame>> Deliver();
  void Publish(bool ended);
  void PauseWhereAsked();

  const SimulatorOptions options;
  const SceneCameraFactory camera_factory;
  std::shared_ptr<const StereoRig> rig;
  StereoCameras cameras;
  SimulatedVehicle vehicle;
  std::unique_ptr<SceneCamera> camera;
  std::uint64_t sequence = 0;
  /// Bundles of one rate are counted from where it came into force, so that a rate that is no
  /// multiple of the grid does not drift.
  double rate_since_s = 0;
  std::uint64_t rate_since = 0;
  Pace pace;

  mutable std::mutex mutex;
  std::condition_variable_any changed;
  std::vector<VehicleMessage> inbox;
  std::optional<StationSession> own_station;
  double heard_s = 0;  ///< seconds of simulated time that the own station knows of
  SourceStatus status;
  int steps_wanted = 0;   ///< while paused
  bool pace_anew = true;  ///< the speed reached so far is of another speed
};

/// The very exchange of messages that goes over a bus, with both ends here.
void Simulator::State::GrantOwnStation() {
  if (!options.own_station) {
    return;
  }
  own_station.emplace(*options.own_station);
  own_station->Hear(vehicle.authority().Report(vehicle.now()), heard_s);
  if (const std::optional<SessionRequest> request = own_station->Tick(heard_at(), heard_s)) {
    vehicle.Receive(*request);
    own_station->Hear(vehicle.authority().Report(vehicle.now()), heard_s);
  }
}

/// Pacing only. False when stopped.
bool Simulator::State::WaitForTurn(std::stop_token stop) {
  std::unique_lock lock(mutex);
  if (status.paused) {
    pace.Pause();
  }
  if (!changed.wait(lock, stop, [&] { return !status.paused || steps_wanted > 0; })) {
    return false;
  }
  if (steps_wanted > 0) {
    --steps_wanted;
    pace.Pause();
    return !stop.stop_requested();
  }
  if (std::exchange(pace_anew, false)) {
    pace.Restart();
  }
  const double begin_s = MonotonicSeconds();
  const double speed = status.speed;
  const double due_s = pace.DueAt(begin_s, period_s(), speed);
  // A change of speed or a pause ends the wait early; this bundle still comes.
  changed.wait_for(lock, stop, std::chrono::duration<double>(std::max(0.0, due_s - begin_s)),
                   [&] { return status.paused || status.speed != speed; });
  pace.Begin(MonotonicSeconds(), due_s, period_s());
  status.speed_reached = pace.reached().value_or(status.speed_reached);
  return !stop.stop_requested();
}

Result<std::shared_ptr<const StereoFrame>> Simulator::State::Deliver() {
  if (!camera) {
    if (!camera_factory) {
      return UsageError("the simulator was asked for pictures without a scene camera");
    }
    Result<std::unique_ptr<SceneCamera>> made = camera_factory(options.scene);
    if (!made) {
      return made.error();
    }
    camera = std::move(made).value();
  }
  return cameras.Deliver(*camera, vehicle.history(), vehicle.now());
}

/// Of the thread of Next(), which alone reads the rig.
void Simulator::State::TakeChanges() {
  SimulationSetup was, becomes;
  {
    const std::lock_guard lock(mutex);
    was = std::exchange(status.simulation->in_force, status.simulation->asked);
    becomes = status.simulation->asked;
  }
  if (was.wind_mps != becomes.wind_mps || was.wind_from_deg != becomes.wind_from_deg) {
    vehicle.SetWind(GustyWind(becomes.wind_mps, Rad(becomes.wind_from_deg)));
  }
  const bool other_rate = was.rate_hz != becomes.rate_hz;
  if (other_rate) {
    rate_since_s += static_cast<double>(sequence - rate_since) * period_s();
    rate_since = sequence;
  }
  if (other_rate || was.field_of_view_deg != becomes.field_of_view_deg ||
      was.baseline_m != becomes.baseline_m || was.tilt_deg != becomes.tilt_deg) {
    rig = std::make_shared<const StereoRig>(RigAfter(*rig, was, becomes));
    vehicle.SetRig(*rig);
    cameras.SetRig(*rig);
  }
}

void Simulator::State::Publish(bool ended) {
  const std::lock_guard lock(mutex);
  status.ended = ended;
  status.position_s = SecondsBetween(kEpoch, vehicle.now());
  status.frame_index = sequence;
  PauseWhereAsked();
}

/// Under the mutex.
void Simulator::State::PauseWhereAsked() {
  std::optional<double>& run_to_s = status.simulation->run_to_s;
  if (run_to_s && status.position_s >= *run_to_s - kSameMoment_s) {
    run_to_s.reset();
    status.paused = true;
  }
}

Simulator::Simulator(SimulatorOptions options, SceneCameraFactory camera_factory)
    : state_(std::make_unique<State>(std::move(options), std::move(camera_factory))) {}

Simulator::~Simulator() = default;

Result<std::shared_ptr<const FrameBundle>> Simulator::Next(std::stop_token stop) {
  State& s = *state_;
  if (!s.WaitForTurn(stop)) {
    return Ended("stopped");
  }
  if (SecondsBetween(kEpoch, s.vehicle.now()) >= s.options.duration_limit_s) {
    s.Publish(true);
    return Ended("the simulated flight reached its time limit");
  }
  std::vector<VehicleMessage> messages;
  {
    const std::lock_guard lock(s.mutex);
    messages.swap(s.inbox);
  }
  for (const VehicleMessage& message : messages) {
    s.vehicle.Receive(message);
  }
  s.TakeChanges();
  auto bundle = std::make_shared<FrameBundle>();
  bundle->sequence = ++s.sequence;
  const double periods = static_cast<double>(s.sequence - s.rate_since);
  s.vehicle.AdvanceTo(AddSeconds(kEpoch, s.rate_since_s + periods / s.rig->rate_hz), *bundle);
  bundle->time = s.vehicle.now();
  bundle->rig = s.rig;
  bundle->pose_at_exposure = s.vehicle.history().ToldAt(
      AddSeconds(s.vehicle.now(), -s.cameras.age_s()), s.options.vehicle.sensors.attitude.delay_s);
  bundle->status = s.vehicle.Status();
  if (s.options.render) {
    Result<std::shared_ptr<const StereoFrame>> frame = s.Deliver();
    if (!frame) {
      s.Publish(true);
      return frame.error();
    }
    bundle->stereo = std::move(frame).value();
    if (!bundle->stereo) {
      bundle->pose_at_exposure.reset();  // a pair that never came
    }
  }
  s.Publish(false);
  return std::shared_ptr<const FrameBundle>(std::move(bundle));
}

SourceStatus Simulator::Status() const {
  const std::lock_guard lock(state_->mutex);
  return state_->status;
}

void Simulator::Control(const PlaybackControl& control) {
  const std::lock_guard lock(state_->mutex);
  std::optional<double>& run_to_s = state_->status.simulation->run_to_s;
  if (control.kind != PlaybackControl::Kind::kSpeed) {
    run_to_s.reset();
  }
  switch (control.kind) {
    case PlaybackControl::Kind::kRunTo:
      if (!std::isfinite(control.value)) {
        break;
      }
      run_to_s = control.value;
      state_->status.paused = false;
      state_->steps_wanted = 0;
      state_->PauseWhereAsked();
      break;
    case PlaybackControl::Kind::kPlay:
      state_->status.paused = false;
      state_->steps_wanted = 0;
      break;
    case PlaybackControl::Kind::kPause:
      state_->status.paused = true;
      state_->steps_wanted = 0;
      break;
    case PlaybackControl::Kind::kStepForward:
      state_->status.paused = true;
      ++state_->steps_wanted;
      break;
    case PlaybackControl::Kind::kSpeed:
      if (std::isfinite(control.value) && control.value >= 0) {
        state_->pace_anew = state_->pace_anew || state_->status.speed != control.value;
        state_->status.speed = control.value;
      }
      break;
    case PlaybackControl::Kind::kStepBack:  // a simulation has no past to return to
    case PlaybackControl::Kind::kSeek:
      break;
  }
  state_->changed.notify_all();
}

::palace::Status Simulator::Change(const SimulationChange& change) {
  if (const ::palace::Status fit = CheckChange(change); !fit) {
    return fit;
  }
  if (std::string why = WhyLensStays(state_->options.vehicle.rig, change.name); !why.empty()) {
    return UnavailableError(std::move(why));
  }
  const std::lock_guard lock(state_->mutex);
  state_->status.simulation->asked.*FindSimulationRow(change.name)->field = change.value;
  return Ok();
}

bool Simulator::Send(const VehicleMessage& message) {
  const std::lock_guard lock(state_->mutex);
  state_->inbox.push_back(message);
  return true;
}

void Simulator::Seal(VehicleMessage& message) {
  const std::lock_guard lock(state_->mutex);
  if (state_->own_station) {
    state_->own_station->Seal(message, state_->heard_at(), state_->heard_s);
  }
}

void Simulator::Hear(const FrameBundle& bundle) {
  const std::lock_guard lock(state_->mutex);
  state_->heard_s = SecondsBetween(kEpoch, bundle.time);
  if (state_->own_station && bundle.authority) {
    state_->own_station->Hear(*bundle.authority, state_->heard_s);
  }
}

void Simulator::Announce(const EngineSnapshot&) {
  const std::lock_guard lock(state_->mutex);
  if (!state_->own_station) {
    return;
  }
  if (auto request = state_->own_station->Tick(state_->heard_at(), state_->heard_s)) {
    state_->inbox.push_back(std::move(*request));
  }
}

AuthorityStatus Simulator::Authority() const {
  const std::lock_guard lock(state_->mutex);
  return state_->own_station ? state_->own_station->Status(state_->heard_s) : AuthorityStatus{};
}

std::uint64_t Simulator::boot_id() const { return state_->vehicle.boot_id(); }

const StereoRig& Simulator::rig() const { return *state_->rig; }

ImuBiases Simulator::imu_biases() const {
  const ImuSensor& imu = state_->vehicle.imu();
  return {imu.gyro_bias(), imu.accel_bias()};
}

RigidTransform Simulator::TruePoseAt(Timestamp time) const {
  return state_->vehicle.history().TrueAt(time);
}

const Touchdown* Simulator::touchdown() const {
  const std::optional<Touchdown>& touchdown = state_->vehicle.touchdown();
  return touchdown ? &*touchdown : nullptr;
}

}  // namespace palace
