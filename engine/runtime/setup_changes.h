// SetupChanges: what a person changed of a simulation while it flew, as events of the flight.
//
// A slider that is dragged passes through many values: a change is told at once, and then once in
// kEvery_s while it goes on. A flight begins with its setup untold.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/time.h"
#include "engine/model/simulation_setup.h"

namespace palace {

class SetupChanges {
 public:
  static constexpr double kEvery_s = 1;

  /// Once a bundle. "Wind, mean: 0.0 m/s to 6.0 m/s": one for each value that reads otherwise than
  /// when it was told last.
  std::vector<std::string> Note(const SimulationSetup& in_force, Timestamp now);
  /// Of a flight that goes on: that was in force.
  void GoOnAfter(const SimulationSetup& told) { told_ = told; }

 private:
  std::optional<SimulationSetup> told_;
  std::optional<Timestamp> told_at_;
};

}  // namespace palace
