#include "engine/model/simulation_setup.h"

#include <algorithm>
#include <cmath>

#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/model/mission/mission_status.h"

namespace palace {
namespace {

using Setup = SimulationSetup;

SimulationRow Row(const char* name, const char* label, const char* unit, double least, double most,
                  double value, int decimals, double Setup::*field, bool of_rig) {
  SimulationRow row;
  row.info.name = name;
  row.info.label = label;
  row.info.unit = unit;
  row.info.decimals = decimals;
  row.info.min = row.info.soft_min = least;
  row.info.max = row.info.soft_max = most;
  row.info.default_value = value;
  row.field = field;
  row.of_rig = of_rig;
  return row;
}

double FieldOfView(const PinholeCamera& camera) {
  return 2 * Deg(std::atan(camera.width / (2 * camera.fx_px)));
}

/// Pixels stay square where they were.
void Widen(PinholeCamera& camera, double field_of_view_deg) {
  const double fx_px = camera.width / (2 * std::tan(Rad(field_of_view_deg) / 2));
  camera.fy_px *= fx_px / camera.fx_px;
  camera.fx_px = fx_px;
}

}  // namespace

const std::vector<SimulationRow>& SimulationTable() {
  static const std::vector<SimulationRow> table = {
      Row("simulation.wind_mps", "Wind at 6 m, mean", "m/s", 0, 20, 0, 1, &Setup::wind_mps, false),
      Row("simulation.wind_from_deg", "Wind from", "\u00b0", 0, 360, 0, 0, &Setup::wind_from_deg,
          false),
      Row("simulation.field_of_view_deg", "Field of view", "\u00b0", 20, 100, 45, 0,
          &Setup::field_of_view_deg, true),
      Row("simulation.baseline_m", "Baseline", "m", 0.1, 3, 1, 2, &Setup::baseline_m, true),
      Row("simulation.tilt_deg", "Camera tilt", "\u00b0", -90, 0, -45, 0, &Setup::tilt_deg, true),
      Row("simulation.rate_hz", "Picture rate", "Hz", 1, 30, 10, 0, &Setup::rate_hz, false),
  };
  return table;
}

const SimulationRow* FindSimulationRow(std::string_view name) {
  const std::vector<SimulationRow>& table = SimulationTable();
  const auto row = std::find_if(table.begin(), table.end(),
                                [&](const SimulationRow& r) { return r.info.name == name; });
  return row == table.end() ? nullptr : &*row;
}

Status CheckChange(const SimulationChange& change) {
  const SimulationRow* row = FindSimulationRow(change.name);
  if (row == nullptr) {
    std::string names;
    for (const SimulationRow& each : SimulationTable()) {
      names += (names.empty() ? "" : ", ") + each.info.name;
    }
    return UsageError("unknown value '" + change.name + "' of the simulation; it has " + names);
  }
  const SettingInfo& info = row->info;
  if (!(change.value >= info.min && change.value <= info.max)) {
    return UsageError(
        change.name +
        WithNumbers(" = %g must lie between %g and %g ", change.value, info.min, info.max) +
        (info.unit == "\u00b0" ? "deg" : info.unit));
  }
  return Ok();
}

std::string WhyRigStays(MissionState state) {
  switch (state) {
    case MissionState::kArmed:
      return "A site is armed: deselect it before the cameras change";
    case MissionState::kApproved:
    case MissionState::kDescending:
    case MissionState::kHold:
    case MissionState::kAborting:
      return "The cameras stay as they are until the landing is over";
    default:
      return {};
  }
}

std::string WhyLensStays(const StereoRig& rig, std::string_view name) {
  const bool of_lens = name == "simulation.field_of_view_deg" || name == "simulation.baseline_m";
  return rig.left.model && of_lens ? "The camera file of this vehicle tells it" : "";
}

void ReadRig(const StereoRig& rig, SimulationSetup& setup) {
  setup.field_of_view_deg = FieldOfView(rig.left.pinhole);
  setup.baseline_m = rig.baseline_m;
  setup.tilt_deg = Deg(rig.tilt_rad);
  setup.rate_hz = rig.rate_hz;
}

StereoRig RigAfter(const StereoRig& rig, const SimulationSetup& was,
                   const SimulationSetup& becomes) {
  StereoRig after = rig;
  if (becomes.field_of_view_deg != was.field_of_view_deg) {
    Widen(after.left.pinhole, becomes.field_of_view_deg);
    Widen(after.right.pinhole, becomes.field_of_view_deg);
  }
  if (becomes.baseline_m != was.baseline_m) {
    after.baseline_m = becomes.baseline_m;
  }
  if (becomes.tilt_deg != was.tilt_deg) {
    after.tilt_rad = Rad(becomes.tilt_deg);
  }
  if (becomes.rate_hz != was.rate_hz) {
    after.rate_hz = becomes.rate_hz;
  }
  return after;
}

}  // namespace palace
