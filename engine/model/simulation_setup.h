// What of a simulation a person may change while it flies (thesis 2.1: field of view, separation,
// pointing angle, rate of capture), and the wind: one table, for source, panel and scripts.
//
// Values are in the units of their names, as settings are. A change takes effect with the next
// bundle; one seed and one sequence of changes give one flight.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/rig.h"
#include "engine/model/settings/settings.h"

namespace palace {

enum class MissionState : std::uint8_t;

struct SimulationSetup {
  double wind_mps = 0;           ///< mean, at 20 ft above the ground; its gusts grow with it
  double wind_from_deg = 0;      ///< where it comes from, clockwise from north
  double field_of_view_deg = 0;  ///< horizontal, of both cameras
  double baseline_m = 0;
  double tilt_deg = 0;  ///< of the cameras, -90 straight down, 0 to the horizon
  double rate_hz = 0;   ///< pairs of pictures a second
};

/// Sets one value, by its name: "simulation.wind_mps".
struct SimulationChange {
  std::string name;
  double value = 0;
};

struct SimulationRow {
  SettingInfo info;
  double SimulationSetup::*field = nullptr;
  bool of_rig = false;  ///< another calibration: maps and approvals of the old one end
};

/// All that can be changed, in the order of the screen. `info.default_value` is the R-50's.
const std::vector<SimulationRow>& SimulationTable();
/// Null when nothing has that name.
const SimulationRow* FindSimulationRow(std::string_view name);
/// Refuses unknown names and values out of range, naming the limit.
Status CheckChange(const SimulationChange& change);
/// Why the rig stays as it is in that state; empty: it may be changed. What is armed was judged,
/// and is flown, with the cameras of then.
std::string WhyRigStays(MissionState state);

/// Why that value of this rig stays as it is: a lens of a camera file tells its own field of view
/// and place. Empty: it may be changed.
std::string WhyLensStays(const StereoRig& rig, std::string_view name);

/// What the rig says of itself; the wind is left alone.
void ReadRig(const StereoRig& rig, SimulationSetup& setup);
/// The rig with those of its numbers that become others; the rest to the bit.
StereoRig RigAfter(const StereoRig& rig, const SimulationSetup& was,
                   const SimulationSetup& becomes);

/// How a simulation stands, beside what SourceStatus tells of every source.
struct SimulationStatus {
  SimulationSetup began;           ///< as the flight began
  SimulationSetup in_force;        ///< of the newest bundle
  SimulationSetup asked;           ///< in force with the next bundle
  std::optional<double> run_to_s;  ///< plays until then, seconds since start
};

}  // namespace palace
