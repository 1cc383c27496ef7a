#include "engine/experiments/evaluate_velocity_estimate.h"

#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/experiments/flight_options.h"
#include "engine/experiments/velocity_report.h"

namespace palace {
namespace {

struct VelocityOptions {
  FlightOptions flight;
  double hover_s = VelocityFlightPlan{}.hover_s;
  bool no_missions = false;
};

Result<std::vector<TrialRow>> RunTrial(const VelocityOptions& options, int trial,
                                       std::uint64_t seed, const SceneCameraFactory& camera) {
  const Result<MissionFlight> flight = options.flight.Flight(seed);
  if (!flight) {
    return flight.error();
  }
  std::vector<TrialRow> rows, tracks;
  for (const LoopIntegral& integral : LoopIntegrals()) {
    for (const VelocityMethod& method : VelocityMethods()) {
      const Result<VelocityFlight> flown = FlyOn(method, integral,
                                                 {.vehicle = flight->vehicle,
                                                  .seed = seed,
                                                  .wind_mps = flight->wind_mps,
                                                  .hover_s = options.hover_s});
      if (!flown) {
        return flown.error();
      }
      rows.push_back(RowOf(method, integral, *flown));
      for (const VelocityFlight::Sample& sample : flown->track) {
        if (trial == 0 && IsTracked(integral)) {
          tracks.push_back(TrackRowOf(method, integral, sample));
        }
      }
    }
  }
  if (!options.no_missions) {
    const Result<HandoverFlight> mission = FlyHandover(*flight, camera);
    if (!mission) {
      return mission.error();
    }
    rows.push_back(RowOf(*mission));
  }
  rows.insert(rows.end(), tracks.begin(), tracks.end());
  return rows;
}

}  // namespace

Experiment VelocityEstimateExperiment(SceneCameraFactory camera) {
  auto options = std::make_shared<VelocityOptions>();
  Experiment experiment;
  experiment.name = "velocity-estimate";
  experiment.purpose = "Velocities from vision fixes, the thesis's ways and ours, flown on";
  experiment.default_trials = 10;
  experiment.columns = VelocityColumns();
  experiment.add_options = [options](CLI::App& verb) {
    options->flight.AddVehicle(verb);
    options->flight.AddWind(verb, 15);
    verb.add_option("--hover", options->hover_s, "Hover on vision before the slope, s")
        ->check(FiniteRange(5, 600))
        ->capture_default_str();
    verb.add_flag("--no-missions", options->no_missions,
                  "No whole mission a trial, with pictures, for the hand-over");
  };
  experiment.setup = [options] {
    return "vehicle " + options->flight.vehicle + ", " + options->flight.WindText() + ", hover " +
           CsvNumber(options->hover_s) + " s" + (options->no_missions ? ", no missions" : "");
  };
  experiment.run = [options, camera = std::move(camera)](int trial, std::uint64_t seed) {
    return RunTrial(*options, trial, seed, camera);
  };
  experiment.report = VelocityReport;
  return experiment;
}

}  // namespace palace
