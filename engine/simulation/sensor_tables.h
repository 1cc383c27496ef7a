// [camera], [gps], [imu], [attitude], [laser] and [clock] of a vehicle file: how its sensors err.
//
// The figures that every vehicle has are required; each further error is a key that may be left
// out, which leaves it off. Included by .cpp files only: it brings toml++.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/toml_text.h"
#include "engine/simulation/vehicle_description.h"

namespace palace {

/// All six. `folder`: what model files are relative to; none: the text has no place on disk, and
/// names no files.
Status ReadSensors(const toml::table& root, const std::string& file,
                   const std::optional<std::filesystem::path>& folder, VehicleDescription& v);

}  // namespace palace
