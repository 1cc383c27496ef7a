// Simulator: the simulated helicopter over a simulated scene, as a source and a vehicle link.
//
// Lockstep: simulated time moves only inside Next(), by exactly one camera period. Messages given
// to Send() and changes given to Change() take effect at the start of the following Next(), in the
// order they came. One seed and one sequence of messages and changes give one flight to the bit;
// pacing, pause and speed change nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "engine/runtime/source.h"
#include "engine/runtime/vehicle_link.h"
#include "engine/simulation/scene_camera.h"
#include "engine/simulation/vehicle_description.h"
#include "engine/simulation/wind.h"
#include "engine/trust/station_session.h"
#include "engine/trust/vehicle_authority.h"
#include "engine/world/scene_library.h"
#include "engine/world/world.h"

namespace palace {

/// Called on the thread that first calls Next(), so that a GL context belongs to that thread.
using SceneCameraFactory = std::function<Result<std::unique_ptr<SceneCamera>>(const World&)>;

struct SimulatorOptions {
  World scene;
  VehicleDescription vehicle = DefaultVehicle();
  std::uint64_t seed = 1;
  double hover_height_m = 15.24;  ///< of B above the bare ground at the start
  double heading_rad = 0;
  double start_north_m = 0;
  double start_east_m = 0;
  WindOptions wind;
  double duration_limit_s = 600;
  double speed = 0;           ///< times real time; 0 as fast as possible
  bool render = true;         ///< false: bundles carry no pictures and no factory is needed
  std::uint64_t boot_id = 0;  ///< 0: of the seed
  /// Pair keys of the stations that may command; none: whoever speaks is obeyed.
  std::optional<std::vector<SecretKey>> keys{};
  /// The station at this end of the link, which no bus reaches: it is granted command before the
  /// first bundle.
  std::optional<StationTrust> own_station{};
};

/// What the IMU adds to what it measures, in B.
struct ImuBiases {
  Eigen::Vector3d gyro_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_mps2 = Eigen::Vector3d::Zero();
};

/// How the vehicle met the ground, by the truth.
struct Touchdown {
  Timestamp time;
  Eigen::Vector3d p_W_skid = Eigen::Vector3d::Zero();
  double vertical_speed_mps = 0;  ///< positive down
  double horizontal_speed_mps = 0;
  double tilt_rad = 0;
  bool on_object = false;      ///< else on the bare ground
  double ground_tilt_rad = 0;  ///< of what the four ends of the gear stand above
  GearLimits limits;           ///< of the vehicle that landed

  /// Harder than the gear is made for.
  bool hard() const {
    return vertical_speed_mps > limits.sink_mps || horizontal_speed_mps > limits.across_mps ||
           tilt_rad > limits.tilt_rad;
  }
};

class Simulator final : public Source, public VehicleLink {
 public:
  Simulator(SimulatorOptions options, SceneCameraFactory camera_factory);
  ~Simulator() override;
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// kEnd at the duration limit or when stopped; the camera's error when it cannot draw.
  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override;
  bool IsLockstep() const override { return true; }
  SourceStatus Status() const override;
  void Control(const PlaybackControl& control) override;
  ::palace::Status Change(const SimulationChange& change) override;
  bool Send(const VehicleMessage& message) override;
  void Seal(VehicleMessage& message) override;
  void Hear(const FrameBundle& bundle) override;
  void Announce(const EngineSnapshot& snapshot) override;
  AuthorityStatus Authority() const override;

  /// Stamp of the moment simulated time starts at; the first bundle is one camera period later.
  static constexpr Timestamp kEpoch{1'000'000'000'000};
  std::uint64_t boot_id() const;
  const StereoRig& rig() const;  ///< of the newest bundle, until the next
  /// The truth now. From the thread that calls Next().
  ImuBiases imu_biases() const;
  /// True X_WB at a time of the last three seconds. From the thread that calls Next().
  RigidTransform TruePoseAt(Timestamp time) const;
  /// Set once the skids have met the ground. Call from the thread that calls Next().
  const Touchdown* touchdown() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace palace
