#include "engine/experiments/flight_options.h"

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/text.h"
#include "engine/report/trial_table.h"
#include "engine/runtime/settings_io.h"

namespace palace {

void FlightOptions::AddScenario(CLI::App& app) {
  app.add_option("--scenario", scenario, "Scene")->capture_default_str();
}

void FlightOptions::AddVehicle(CLI::App& app) {
  app.add_option("--vehicle", vehicle,
                 "A vehicle by name (" + Joined(VehicleNames()) + ") or by its file")
      ->capture_default_str();
}

void FlightOptions::AddWind(CLI::App& app, double most_mps, const std::string& note) {
  app.add_option("--wind", wind_mps, "Mean wind 6 m above ground, m/s" + note)
      ->check(FiniteRange(0.0, most_mps))
      ->capture_default_str();
}

void FlightOptions::AddSet(CLI::App& app) {
  app.add_option("--set", set, "One setting, e.g. slad.max_slope_deg=8");
}

void FlightOptions::AddRecord(CLI::App& app) {
  app.add_option("--record", record,
                 "Folder for the log of every flight, SCENARIO-SEED/flight.lcm; about 6.3 MB a second "
                 "of flight");
}

Result<MissionFlight> FlightOptions::Flight(std::uint64_t seed) const {
  const Result<VehicleDescription> described = LoadVehicle(vehicle);
  if (!described) {
    return described.error();
  }
  const Result<Settings> settings = SettingsOfCommandLine(SettingsFor(*described), {}, set);
  if (!settings) {
    return settings.error();
  }
  return MissionFlight{.scenario = scenario,
                       .seed = seed,
                       .vehicle = *described,
                       .settings = *settings,
                       .wind_mps = wind_mps,
                       .record_in = record};
}

std::string FlightOptions::WindText() const { return "wind " + CsvNumber(wind_mps) + " m/s"; }

std::string FlightOptions::SetText() const {
  std::string text;
  for (const std::string& assignment : set) {
    text += ", " + assignment;
  }
  return text;
}

}  // namespace palace
