// Channel names. config/channels.toml may rename any of them; these are the defaults.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace palace {

struct ChannelNames {
  // From the vehicle.
  std::string camera_left = "CAMERA_LEFT";
  std::string camera_right = "CAMERA_RIGHT";
  std::string camera_rig = "CAMERA_RIG";
  std::string vehicle_pose = "VEHICLE_POSE";
  std::string imu = "IMU";
  std::string gps = "GPS";
  std::string laser_range = "LASER_RANGE";
  std::string vehicle_status = "VEHICLE_STATUS";
  std::string command_ack = "COMMAND_ACK";
  std::string authority = "AUTHORITY";
  std::string truth = "TRUTH";
  std::string arrival = "ARRIVAL";  ///< in recordings only
  // From the station.
  std::string mission = "MISSION";
  std::string slad_settings = "SLAD_SETTINGS";
  std::string site_proposal = "SITE_PROPOSAL";
  std::string site_decision = "SITE_DECISION";
  std::string command = "COMMAND";
  std::string position_estimate = "POSITION_ESTIMATE";
  std::string tracker_status = "TRACKER_STATUS";
  std::string station_status = "STATION_STATUS";
  std::string session_request = "SESSION_REQUEST";
  std::string abort = "ABORT";
  std::string event = "EVENT";
  std::string refused = "REFUSED";  ///< in recordings only

  friend bool operator==(const ChannelNames&, const ChannelNames&) = default;
  /// The channels a station listens to.
  std::vector<std::string> FromVehicle() const;
  /// The channels a vehicle listens to: COMMAND, POSITION_ESTIMATE, SESSION_REQUEST, ABORT.
  std::vector<std::string> ToVehicle() const;
};

/// `[channels]` with any of the keys above. Unknown keys, names that are empty, longer than LCM's
/// 63 bytes, not printable, or used twice are errors naming file, line and key.
Result<ChannelNames> LoadChannels(const std::filesystem::path& file);
/// The same from text; `origin` names it in errors.
Result<ChannelNames> ParseChannels(std::string_view text, const std::string& origin);

}  // namespace palace
