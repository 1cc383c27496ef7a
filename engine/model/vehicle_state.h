// What the vehicle tells the station: sensors, state, and answers to commands.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/time.h"
#include "engine/model/view_pose.h"

namespace palace {

struct ImuSample {
  Timestamp time;
  Eigen::Vector3d specific_force_B =
      Eigen::Vector3d::Zero();  ///< m/s^2, without gravity: hover reads -g on z
  Eigen::Vector3d angular_rate_B = Eigen::Vector3d::Zero();  ///< rad/s
};

struct GpsFix {
  Timestamp time;  ///< of validity, not of arrival
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();
  double sigma_horizontal_m = 0;
  double sigma_vertical_m = 0;
};

/// Laser range finder, from the left camera's focal point along its optical axis.
struct LaserRange {
  Timestamp time;
  double range_m = 0;  ///< NaN when no return
};

/// The autopilot's own navigation solution (GPS, IMU, AHRS).
struct VehiclePose {
  Timestamp time;
  RigidTransform X_WB;
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_rate_B = Eigen::Vector3d::Zero();
  PoseSigmas sigmas{};  ///< not on the wire: the default of all poses
};

enum class VehicleMode : std::uint8_t {
  kUnknown,
  kHover,
  kAlign,
  kDescend,
  kSettle,
  kSink,
  kLanded,
  kHold,
  kAbort,
  kGo,  ///< to another hover
};

struct VehicleStatus {
  Timestamp time;
  std::uint64_t boot_id = 0;
  VehicleMode mode = VehicleMode::kUnknown;
  bool on_ground = false;
  bool flies_on_vision = false;   ///< control uses the station's POSITION_ESTIMATE
  std::uint64_t approval_id = 0;  ///< approval being executed, 0 none
  double wind_speed_mps = 0;      ///< NaN: not measured
  double wind_from_rad = 0;       ///< from north over east; NaN likewise
  double battery_or_fuel = 1;     ///< share left, 0..1; NaN: not known
  bool simulated = false;         ///< the session is labelled simulated
};

enum class AckResult : std::uint8_t { kAccepted, kRefused };
struct CommandAck {
  Timestamp time;
  std::uint64_t command_id = 0;
  AckResult result = AckResult::kAccepted;
  std::string reason;
};

/// Who commands the vehicle, by its own word; sent once a second and on every change.
struct AuthorityReport {
  Timestamp time;
  std::uint64_t boot_id = 0;
  bool checks = true;            ///< false: it takes unsealed commands of anybody
  std::uint64_t challenge = 0;   ///< what the next request for command must name
  std::uint64_t session_id = 0;  ///< 0: nobody commands
  // Of the station that commands:
  std::uint64_t station_id = 0;
  std::string station_name;
  std::uint64_t key_id = 0;
  std::uint64_t station_nonce = 0;
  Timestamp since;
  Timestamp heard_at;  ///< its last sealed message
  // The newest request that was refused:
  std::uint64_t refused_station_id = 0;
  std::string refusal;
  std::array<std::uint8_t, 32> mac{};  ///< by the pair key of the station that commands
};

/// True state, from a simulator only; never an input of any decision.
struct Truth {
  Timestamp time;
  RigidTransform X_WB;
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();
};

}  // namespace palace
