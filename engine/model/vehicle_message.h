// What the station sends to a vehicle. Only a VehicleLink transmits it; replay has none.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/time.h"

namespace palace {

/// An approval binds one site, map, parameter set, calibration and vehicle boot, and expires.
struct Approval {
  std::uint64_t id = 0;  ///< random part and counter; strictly increasing per session
  std::uint64_t session_id = 0;
  std::uint64_t counter = 0;
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
  std::vector<std::uint8_t> signature;  ///< Ed25519 over the canonical encoding of all of the above
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
};

struct HoldRequest {
  std::uint64_t command_id = 0;
  std::string reason;
};
struct AbortRequest {
  std::uint64_t command_id = 0;
  std::string reason;
};

using VehicleMessage = std::variant<Approval, PositionEstimate, HoldRequest, AbortRequest>;

}  // namespace palace
