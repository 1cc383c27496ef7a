#include "engine/simulation/vehicle_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "engine/core/files.h"
#include "engine/core/check.h"
#include "engine/core/plain_text.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/simulation/sensor_tables.h"
#include "engine/simulation/vehicle_tables.h"
#include "vehicle_text.h"

namespace palace {
namespace {

constexpr NumberLimits kSpeed{0.01, 50, "give metres a second"};
constexpr NumberLimits kSeconds{0, 10, "give seconds"};
constexpr NumberLimits kGain{0, 100, "0 switches the term off"};
constexpr NumberLimits kTilt{1, 60, "give degrees"};

Status ReadVehicle(const toml::table& root, const std::string& file, VehicleDescription& v,
                   bool& multirotor) {
  MarkedTable table(root, file, "vehicle");
  v.name = table.plain().Text("name");
  const std::string kind = table.plain().Text("kind");
  multirotor = kind == "multirotor";
  if (!kind.empty() && !multirotor && kind != "helicopter") {
    table.plain().FailKey("kind", " = \"" + kind + "\" must be helicopter or multirotor");
  }
  table.Read("mass_kg", v.mass_kg, {0.1, 2000, "give kilograms, ready to fly"});
  return table.Finish(v.marked);
}

NumberLimits LimitsOfSetting(const char* name, const char* remedy) {
  const SettingInfo* info = FindSetting(name);
  PALACE_CHECK(info != nullptr, name);
  return {info->min, info->max, remedy};
}

Status ReadAirframe(const toml::table& root, const std::string& file, VehicleDescription& v) {
  TomlTable table(root, file, "airframe");
  Lander& l = v.lander;
  const auto metres = [](const char* setting) { return LimitsOfSetting(setting, "give metres"); };
  ReadNumbers(table, {{"base_size_m", &l.base_size_m, metres("slad.lander_base_size_m")},
                      {"gear_length_m", &l.gear_length_m, metres("slad.gear_length_m")},
                      {"gear_width_m", &l.gear_width_m, metres("slad.gear_width_m")},
                      {"belly_clearance_m", &l.belly_clearance_m, metres("slad.belly_clearance_m")},
                      {"rotor_diameter_m", &l.rotor_diameter_m, metres("slad.rotor_diameter_m")},
                      {"max_rock_size_m", &l.max_rock_size_m, metres("slad.max_rock_size_m")}});
  const std::string gear = table.Text("gear");
  if (!gear.empty() && gear != "skids" && gear != "pads") {
    table.FailKey("gear", " = \"" + gear + "\" must be skids or pads");
  }
  l.gear = gear == "pads" ? LandingGear::kPads : LandingGear::kSkids;
  const std::vector<double> centre =
      table.Numbers("gear_centre_body_m", 3, 3, metres("slad.gear_below_m"));
  if (centre.size() == 3) {
    l.gear_forward_m = centre[0], l.gear_right_m = centre[1], l.gear_below_m = centre[2];
  }
  if (const double across_m = std::hypot(l.gear_length_m, l.gear_width_m);
      table.Finish() && across_m > l.base_size_m) {
    table.FailKey("base_size_m", " = " + NumberText(l.base_size_m) + " does not hold the gear, " +
                                     NumberText(across_m) + " m from corner to corner");
  }
  return table.Finish();
}

Status ReadTouchdown(const toml::table& root, const std::string& file, VehicleDescription& v) {
  TomlTable table(root, file, "touchdown");
  ReadNumbers(table, {{"max_sink_mps", &v.gear.sink_mps, kSpeed},
                      {"max_across_mps", &v.gear.across_mps, kSpeed},
                      {"max_tilt_deg", &v.gear.tilt_rad, kTilt, kRadPerDeg}});
  return table.Finish();
}

Status ReadLimits(const toml::table& root, const std::string& file, VehicleDescription& v) {
  TomlTable table(root, file, "limits");
  FlightLimits& l = v.limits;
  ReadNumbers(
      table,
      {{"min_glide_slope_deg", &l.min_glide_slope_rad, {1, 89, "give degrees"}, kRadPerDeg},
       {"min_descent_rate_mps", &l.min_descent_rate_mps, kSpeed},
       {"max_descent_rate_mps", &l.max_descent_rate_mps, kSpeed},
       {"climb_rate_mps", &l.climb_rate_mps, kSpeed},
       {"max_wind_mps", &l.max_wind_mps, LimitsOfSetting("mission.max_wind_mps", "give m/s")},
       {"settle_s", &l.settle_s, LimitsOfSetting("mission.settle_s", "give seconds")},
       {"endurance_s", &l.endurance_s, {10, 1e6, "give seconds"}}});
  if (table.Finish() && l.min_descent_rate_mps > l.max_descent_rate_mps) {
    table.FailKey("max_descent_rate_mps",
                  " = " + NumberText(l.max_descent_rate_mps) +
                      " lies below min_descent_rate_mps = " + NumberText(l.min_descent_rate_mps));
  }
  return table.Finish();
}

Status ReadGroundEffect(const toml::table& root, const std::string& file, VehicleDescription& v) {
  MarkedTable table(root, file, "ground_effect");
  if (!table.plain().Has("on")) {
    table.plain().FailKey("on", " is missing; give true or false");
  }
  v.ground_effect.on = table.plain().BoolOr("on", false);
  table.Read("rotor_radius_m", v.ground_effect.rotor_radius_m, {0.02, 20, "give metres"});
  table.Read("rotor_above_body_m", v.ground_effect.rotor_above_body_m, {-5, 10, "give metres"});
  return table.Finish(v.marked);
}

Status ReadActuators(const toml::table& root, const std::string& file, VehicleDescription& v) {
  TomlTable table(root, file, "actuators");
  ActuatorFigures& a = v.actuators;
  a.control_rate_hz = ReadRate(table, "control_rate_hz");
  ReadNumbers(table, {{"delay_s", &a.delay_s, {0, 0.5, "give seconds"}},
                      {"travel", &a.travel, {0.05, 1, "give a share of full travel"}}});
  a.rate_per_s =
      table.NumberOr("rate_per_s", {0.1, 1000, "give full travels a second, or leave it out"},
                     std::numeric_limits<double>::infinity());
  const double steps = a.delay_s / Rotorcraft::kStep_s;
  if (std::abs(steps - std::round(steps)) > 1e-9) {
    table.FailKey("delay_s", " = " + NumberText(a.delay_s) +
                                 " is no multiple of 0.005 s, the simulator's step");
  }
  return table.Finish();
}

Status ReadGains(const toml::table& root, const std::string& file, VehicleDescription& v) {
  TomlTable table(root, file, "gains");
  CascadeGains& g = v.gains;
  ReadNumbers(table,
              {{"roll_per_rad", &g.roll_per_rad, kGain},
               {"roll_rate_s", &g.roll_rate_s, kGain},
               {"pitch_per_rad", &g.pitch_per_rad, kGain},
               {"pitch_rate_s", &g.pitch_rate_s, kGain},
               {"velocity_per_s", &g.velocity_per_s, kGain},
               {"velocity_integral_per_s2", &g.velocity_integral_per_s2, kGain},
               {"position_per_s", &g.position_per_s, kGain},
               {"tilt_lag_s", &g.tilt_lag_s, kSeconds},
               {"climb_s_per_m", &g.climb_s_per_m, kGain},
               {"climb_integral_per_m", &g.climb_integral_per_m, kGain},
               {"height_per_s", &g.height_per_s, kGain},
               {"yaw_per_rad", &g.yaw_per_rad, kGain},
               {"yaw_integral_per_rad_s", &g.yaw_integral_per_rad_s, kGain},
               {"max_speed_mps", &g.max_speed_mps, kSpeed},
               {"max_acceleration_mps2", &g.max_acceleration_mps2, {0.1, 20, "give m/s2"}},
               {"max_tilt_deg", &g.max_tilt_rad, kTilt, kRadPerDeg},
               {"max_climb_mps", &g.max_climb_mps, kSpeed},
               {"max_collective", &g.max_collective, {0.01, 1, "give a share of full travel"}},
               {"max_yaw_error_deg", &g.max_yaw_error_rad, {1, 180, "give degrees"}, kRadPerDeg}});
  return table.Finish();
}

Status CheckTables(const toml::table& root, const std::string& file, bool multirotor) {
  const std::string model = multirotor ? "multirotor" : "derivatives";
  const std::set<std::string, std::less<>> known = {
      "vehicle",   "airframe", "touchdown", "camera", "limits",   model,  "ground_effect",
      "actuators", "gains",    "gps",       "imu",    "attitude", "laser",
      "clock"};
  for (const auto& [key, node] : root) {
    if (!known.contains(key.str())) {
      return InvalidError(file + ":" + std::to_string(node.source().begin.line) +
                          ": unknown table [" + Printable(key.str()) +
                          "]; known here: " + Joined({known.begin(), known.end()}));
    }
  }
  return Ok();
}

}  // namespace

Result<VehicleDescription> ParseVehicle(std::string_view text, const std::string& name,
                                        const std::optional<std::filesystem::path>& folder) {
  const Result<toml::table> parsed = ParseToml(text, name);
  if (!parsed) {
    return parsed.error();
  }
  const toml::table& root = *parsed;
  VehicleDescription v;
  v.origin = name;
  bool multirotor = false;
  Status status = ReadVehicle(root, name, v, multirotor);
  const auto then = [&](const auto& step) { status = status ? step() : status; };
  then([&] { return CheckTables(root, name, multirotor); });
  then([&] { return ReadAirframe(root, name, v); });
  then([&] { return ReadTouchdown(root, name, v); });
  then([&] { return ReadLimits(root, name, v); });
  then([&] { return multirotor ? ReadMultirotor(root, name, v) : ReadDerivatives(root, name, v); });
  then([&] { return ReadGroundEffect(root, name, v); });
  then([&] { return ReadActuators(root, name, v); });
  then([&] { return ReadGains(root, name, v); });
  then([&] { return ReadSensors(root, name, folder, v); });
  if (!status) {
    return status.error();
  }
  return v;
}

std::vector<std::string> VehicleNames() {
  std::vector<std::string> names;
  for (const auto& file : vehicle_text::kFiles) {
    names.emplace_back(file.name);
  }
  return names;
}

std::string_view VehicleText(std::string_view name) {
  for (const auto& file : vehicle_text::kFiles) {
    if (name == file.name) {
      return file.text;
    }
  }
  return {};
}

Result<VehicleDescription> LoadVehicle(const std::string& name_or_file) {
  if (const std::string_view text = VehicleText(name_or_file); !text.empty()) {
    return ParseVehicle(text, name_or_file + ".toml (built in)");
  }
  std::error_code none;
  if (!std::filesystem::exists(name_or_file, none)) {
    return UsageError("there is no vehicle \"" + name_or_file + "\"; name a file, or one of " +
                      Joined(VehicleNames()));
  }
  const Result<std::string> text = ReadTextFile(name_or_file);
  return text ? ParseVehicle(*text, name_or_file,
                             std::filesystem::path(name_or_file).parent_path())
              : Result<VehicleDescription>(text.error());
}

}  // namespace palace
