// ReplaySettings: what --settings and --set ask of a log, over what its flight began with.
//
// What the ranges, the fused map and the tracker
// are made with then holds from the start; limits, lander and choice of site stay as recorded, and
// the wanted ones are judged beside them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/flight_record.h"
#include "engine/model/settings/settings.h"

namespace palace {

struct SettingsRequest {
  std::string file;              ///< TOML; empty: none
  std::vector<std::string> set;  ///< "slad.max_slope_deg=8"
};

/// What a log is decided with.
struct ReplaySettings {
  Settings settings;                      ///< of the pipeline, from the start
  std::optional<Settings> redecide_with;  ///< judged beside them; empty: nothing else was asked
  /// Names of what maps are made with and was asked for: what the flight's operator did to them,
  /// then or before a jump, is not followed.
  std::vector<std::string> held{};
};
/// A log without settings on record began with what is wanted: there is nothing to hold it against.
Result<ReplaySettings> SettingsOfReplay(const SettingsRequest& request, const FlightRecord& record);

}  // namespace palace
