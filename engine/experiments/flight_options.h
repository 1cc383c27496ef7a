// Options that the experiments on whole missions share.
#pragma once

#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/experiments/mission_flight.h"
#include "engine/simulation/vehicle_file.h"

namespace CLI {
class App;
}

namespace palace {

struct FlightOptions {
  std::string scenario = "runway";
  std::string vehicle = kDefaultVehicle;  ///< a name or a file
  double wind_mps = 0;
  std::vector<std::string> set{};
  std::string record{};  ///< a folder for the logs of the flights; empty: none

  /// Each adds the option of its name.
  void AddScenario(CLI::App& app);
  void AddVehicle(CLI::App& app);
  void AddWind(CLI::App& app, double most_mps, const std::string& note = "");
  void AddSet(CLI::App& app);
  void AddRecord(CLI::App& app);

  /// The flight they ask for, settings those of the vehicle under --set. Errors: those of the
  /// vehicle's file, and of --set.
  Result<MissionFlight> Flight(std::uint64_t seed) const;
  /// What a report says of them: "scene runway", "wind 3 m/s", and ", name=value" of each --set.
  std::string SceneText() const { return "scene " + scenario; }
  std::string WindText() const;
  std::string SetText() const;
};

}  // namespace palace
