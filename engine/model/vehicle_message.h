// What the station sends to a vehicle. Only a VehicleLink transmits it; replay has none.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>

#include <Eigen/Dense>

#include "engine/core/time.h"

namespace palace {

/// Proof that a message comes from the station that commands (engine/trust/message_bytes.h).
struct Seal {
  std::uint64_t session_id = 0;  ///< granted by the vehicle; 0: not sealed
  std::uint64_t counter = 0;     ///< strictly rising per session and channel
  Timestamp sent_at;             ///< vehicle time; not of an estimate, which has its own
  std::array<std::uint8_t, 32> mac{};
};

/// An approval binds one site, map, parameter set, calibration and vehicle boot, and expires.
struct Approval {
  std::uint64_t id = 0;  ///< random part and counter; strictly increasing per station
  std::uint64_t site_id = 0;
  std::uint64_t map_hash = 0;
  std::uint64_t settings_hash = 0;
  std::uint64_t calibration_hash = 0;
  std::uint64_t vehicle_boot_id = 0;
  Timestamp approved_at;  ///< vehicle time
  Timestamp expires_at;   ///< vehicle time
  bool provisional = false;
  Eigen::Vector3d p_WS = Eigen::Vector3d::Zero();  ///< site, NED metres
  double approach_heading_rad = 0;
  double glide_slope_rad = 0;   ///< down from the horizon
  double descent_rate_mps = 0;  ///< down the glide slope, the vertical part
  double clear_radius_m = 0;
  /// A look: the vehicle flies down the slope until its skids are so far above the site, hovers
  /// there, and the approval is over. 0: it lands.
  double stop_height_m = 0;
  Seal seal{};

  bool IsLook() const { return stop_height_m != 0; }
};

enum class EstimateSource : std::uint8_t { kNone, kGps, kVision };

/// Position of B relative to W, on the station's filter.
struct PositionEstimate {
  Timestamp time;
  EstimateSource source = EstimateSource::kNone;
  bool healthy = false;  ///< may be flown on
  std::uint64_t approval_id = 0;
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_p_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_v_mps = Eigen::Vector3d::Zero();
  Seal seal{};
};

struct HoldRequest {
  std::uint64_t command_id = 0;
  std::string reason;
  Seal seal{};
};
/// To a hover elsewhere, on GPS: up and round where it is, then level and straight. Nothing is
/// approved to land.
struct GoRequest {
  std::uint64_t command_id = 0;
  std::uint64_t vehicle_boot_id = 0;
  Timestamp expires_at;                            ///< vehicle time; refused afterwards
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< NED metres
  double heading_rad = 0;                          ///< from north over east
  Seal seal{};
};
/// Never sealed: an unwanted climb is the safe side.
struct AbortRequest {
  std::uint64_t command_id = 0;
  std::string reason;
};

/// Who may command the vehicle: asked for, kept and given back (engine/trust/station_session.h).
struct SessionRequest {
  enum class Kind : std::uint8_t {
    kAsk,       ///< where nobody commands, or who does was silent
    kTakeOver,  ///< also from a station that is heard
    kKeep,      ///< "I am still here"
    kRelease,
  };
  Kind kind = Kind::kAsk;
  std::uint64_t station_id = 0;  ///< random at each start of a station
  std::string station_name;      ///< for people
  std::uint64_t key_id = 0;      ///< of the pair key
  std::uint64_t vehicle_boot_id = 0;
  std::uint64_t challenge = 0;  ///< kAsk, kTakeOver: the vehicle's newest
  std::uint64_t nonce = 0;      ///< kAsk, kTakeOver: the station's, random
  /// kAsk, kTakeOver: mac by the pair key, no session; else of the session.
  Seal seal{};
};

using VehicleMessage =
    std::variant<Approval, PositionEstimate, HoldRequest, AbortRequest, SessionRequest, GoRequest>;

}  // namespace palace
