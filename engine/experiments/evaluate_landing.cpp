#include "engine/experiments/evaluate_landing.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/units.h"
#include "engine/experiments/flight_options.h"
#include "engine/faults/fault_plan.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

constexpr double kWanted_m = 0.5;  // touchdown beside the site

struct LandingOptions {
  FlightOptions mission;
  std::vector<std::string> faults;
  std::string faults_file;
};

Result<std::vector<TrialRow>> RunTrial(const LandingOptions& options, std::uint64_t seed,
                                       const SceneCameraFactory& camera) {
  Result<MissionFlight> flight = options.mission.Flight(seed);
  if (!flight) {
    return flight.error();
  }
  const Result<FaultPlan> plan = ReadFaultPlan(options.faults_file, options.faults);
  if (!plan) {
    return plan.error();
  }
  flight->faults = *plan;
  const Result<FlownMission> done = FlyMission(*flight, camera);
  if (!done) {
    return done.error();
  }
  const FlightSummary* flown = &done->summary;
  const std::optional<Touchdown>& touchdown = done->touchdown;
  const auto of_touchdown = [&](double value) { return CsvNumber(touchdown ? value : NAN); };
  const Touchdown t = touchdown.value_or(Touchdown{});
  const auto or_nan = [](const std::optional<double>& value) { return value.value_or(NAN); };
  const auto series = [](const SeriesStats& stats, double value) {
    return CsvNumber(stats.count > 0 ? value : NAN);
  };
  return std::vector<TrialRow>{
      {MissionStateName(flown->final_state), CsvNumber(flown->duration_s),
       CsvNumber(or_nan(flown->touchdown_miss_m)),
       CsvNumber(or_nan(flown->site_obstacle_distance_m)), CsvNumber(flown->lander_radius_m),
       series(flown->estimate_error_m, flown->estimate_error_m.mean),
       series(flown->estimate_error_m, flown->estimate_error_m.max),
       series(flown->gps_error_m, flown->gps_error_m.mean), of_touchdown(t.vertical_speed_mps),
       of_touchdown(t.horizontal_speed_mps), of_touchdown(Deg(t.tilt_rad)),
       of_touchdown(t.hard() ? 1 : 0)}};
}

std::string ShareLine(const std::string& what, int hits, int trials) {
  const Interval share = WilsonInterval(hits, trials);
  char text[160];
  std::snprintf(text, sizeof text, "%s: %d of %d (95 %% interval %.1f to %.1f %%)", what.c_str(),
                hits, trials, 100 * share.low, 100 * share.high);
  return text;
}

std::string SpreadLine(const std::string& what, const std::vector<double>& mean,
                       const std::vector<double>& max) {
  char text[160];
  std::snprintf(text, sizeof text, "%s: mean %.3f m, max %.3f m", what.c_str(), SpreadOf(mean).mean,
                SpreadOf(max).max);
  return text;
}

std::string SpeedLine(const TrialTable& table) {
  char text[160];
  const Spread down = SpreadOf(table.Numbers("sink_mps"));
  const Spread across = SpreadOf(table.Numbers("across_mps"));
  const Spread tilt = SpreadOf(table.Numbers("tilt_deg"));
  std::snprintf(text, sizeof text,
                "Touchdown: down %.2f m/s (max %.2f), across %.2f m/s (max %.2f), tilt %.1f deg "
                "(max %.1f)",
                down.mean, down.max, across.mean, across.max, tilt.mean, tilt.max);
  return text;
}

ExperimentReport Report(const TrialTable& table) {
  const int trials = static_cast<int>(table.rows.size());
  const int landed = static_cast<int>(
      table.Where("final_state", MissionStateName(MissionState::kLanded)).rows.size());
  const std::vector<double> miss = table.Numbers("touchdown_miss_m");
  const std::vector<double> obstacle = table.Numbers("site_obstacle_distance_m");
  const std::vector<double> radius = table.Numbers("lander_radius_m");
  const std::size_t state = table.Index("final_state");
  const std::vector<double> hard = table.Numbers("hard");
  int within = 0, clear = 0, soft = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const bool down = table.rows[i][state] == MissionStateName(MissionState::kLanded);
    within += down && miss[i] <= kWanted_m ? 1 : 0;
    clear += obstacle[i] >= radius[i] ? 1 : 0;
    soft += down && hard[i] == 0 ? 1 : 0;
  }
  ExperimentReport report{HtmlPage("PALACE: landing missions")};
  report.passed = landed == trials;
  report.lines = {
      ShareLine("Landed", landed, trials),
      ShareLine("Touchdown within 0.5 m", within, trials),
      ShareLine("Site clear of every true obstacle by the lander radius", clear, trials),
      ShareLine("Touchdown as soft as the gear is made for", soft, trials),
      SpreadLine("Touchdown miss", miss, miss),
      SpeedLine(table),
      SpreadLine("Vision estimate against truth", table.Numbers("vision_error_mean_m"),
                 table.Numbers("vision_error_max_m"))};
  LinePlot plot{"Touchdown miss and vision error by mission", "seed", "distance, m", {}};
  const std::vector<double> seed = table.Numbers("seed");
  plot.series = {{.name = "touchdown miss", .x = seed, .y = miss, .line = false},
                 {.name = "vision error, mean",
                  .x = seed,
                  .y = table.Numbers("vision_error_mean_m"),
                  .line = false},
                 {.name = "vision error, largest",
                  .x = seed,
                  .y = table.Numbers("vision_error_max_m"),
                  .line = false}};
  plot.limits = {{kWanted_m, "0.5 m wanted"}};
  plot.y_min = 0;
  report.page.List(report.lines).Figure(LinePlotSvg(plot), "One point a mission.");
  std::vector<std::vector<std::string>> missions;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto metres = [&](const char* column) {
      char text[24];
      std::snprintf(text, sizeof text, "%.3f", table.Numbers(column)[i]);
      return std::string(text);
    };
    missions.push_back({table.rows[i][1], table.rows[i][state], metres("touchdown_miss_m"),
                        metres("site_obstacle_distance_m"), metres("vision_error_mean_m"),
                        metres("vision_error_max_m"), metres("gps_error_mean_m")});
  }
  report.page.Heading("Missions")
      .Table({"Seed", "End", "Miss, m", "Nearest obstacle, m", "Vision error, mean, m",
              "Vision error, largest, m", "GPS error, mean, m"},
             missions);
  return report;
}

}  // namespace

Experiment LandingExperiment(SceneCameraFactory camera) {
  auto options = std::make_shared<LandingOptions>();
  Experiment experiment;
  experiment.name = "landing";
  experiment.purpose = "Whole missions, one a seed, flown by a scripted operator";
  experiment.columns = {
      "final_state",     "duration_s",          "touchdown_miss_m",   "site_obstacle_distance_m",
      "lander_radius_m", "vision_error_mean_m", "vision_error_max_m", "gps_error_mean_m",
      "sink_mps",        "across_mps",          "tilt_deg",           "hard"};
  experiment.add_options = [options](CLI::App& verb) {
    options->mission.AddScenario(verb);
    options->mission.AddVehicle(verb);
    options->mission.AddWind(
        verb, 15,
        "; with more at the vehicle than its limit (8 for the R-50) nothing can be approved");
    options->mission.AddSet(verb);
    options->mission.AddRecord(verb);
    verb.add_option("--fault", options->faults, kFaultHelp);
    verb.add_option("--faults", options->faults_file, kFaultsHelp);
  };
  experiment.setup = [options] {
    std::string text = options->mission.SceneText() + ", " + options->mission.WindText();
    text +=
        options->mission.vehicle == kDefaultVehicle ? "" : ", vehicle " + options->mission.vehicle;
    text += options->mission.SetText();
    text += options->faults_file.empty() ? "" : ", faults " + options->faults_file;
    for (const std::string& fault : options->faults) {
      text += ", fault " + fault;
    }
    return text;
  };
  experiment.run = [options, camera = std::move(camera)](int, std::uint64_t seed) {
    return RunTrial(*options, seed, camera);
  };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
