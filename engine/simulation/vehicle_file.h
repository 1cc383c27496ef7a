// Vehicle files: TOML a person edits, one a vehicle (config/vehicles, README "Vehicles").
//
// Each table and key is required but actuators.rate_per_s, [clock] and what further errors sensors
// may have (sensor_tables.h), each is checked against limits; numbers that describe the real vehicle carry a mark: `Xu = { value = -0.0505, mark = "recalled" }`, one
// of sourced, recalled, computed, chosen. Errors name file, line, key, value, limit and remedy.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/simulation/vehicle_description.h"

namespace palace {

inline constexpr const char* kDefaultVehicle = "r50";

/// Names of the files in config/vehicles, which the programs carry with them.
std::vector<std::string> VehicleNames();

/// One of VehicleNames(), or the path of a file. Neither is a usage error that lists the names.
Result<VehicleDescription> LoadVehicle(const std::string& name_or_file);

/// `name` stands for the file in messages. Camera model files that it names lie relative to
/// `folder`; without one they are refused.
Result<VehicleDescription> ParseVehicle(
    std::string_view text, const std::string& name,
    const std::optional<std::filesystem::path>& folder = std::nullopt);

/// The text of a built-in vehicle's file; empty for no vehicle.
std::string_view VehicleText(std::string_view name);

}  // namespace palace
