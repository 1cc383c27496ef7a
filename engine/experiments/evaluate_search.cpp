#include "engine/experiments/evaluate_search.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/text.h"
#include "engine/experiments/flight_options.h"
#include "engine/experiments/landing_truth.h"
#include "engine/report/figure_text.h"
#include "engine/report/statistics.h"
#include "engine/world/families/clearing.h"

namespace palace {
namespace {

constexpr double kCeiling_m = 40;
constexpr double kLimit_s = 900;  // of flown time
constexpr double kStoppedLimit_s = 25;
constexpr int kLooksAgain = 4;
constexpr double kStrays_m = 0.5;
constexpr double kWanted = 0.95;

FlyArea Area() {
  const double half_m = kSearchedHalf_m;
  return {{{-half_m, -half_m}, {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}}, kCeiling_m};
}

Result<std::vector<TrialRow>> RunTrial(const FlightOptions& options, std::uint64_t seed,
                                       const SceneCameraFactory& camera) {
  Result<MissionFlight> flight = options.Flight(seed);
  if (!flight) {
    return flight.error();
  }
  flight->scenario = "search";
  flight->limit_s = flight->unapproved_limit_s = kLimit_s;
  flight->stopped_limit_s = kStoppedLimit_s;
  flight->looks_again = kLooksAgain;
  flight->looks_closer = flight->searches = true;
  flight->area = Area();
  const Result<FlownMission> flown = FlyMission(*flight, camera);
  if (!flown) {
    return flown.error();
  }
  const World world = MakeSearchedGround(seed);
  std::optional<DiscTruth> under;
  double away_m = NAN;
  if (flown->touchdown) {
    const Eigen::Vector2d at = flown->touchdown->p_W_skid.head<2>();
    away_m = at.norm();
    under = DiscAt(world, at, flight->settings.slad.lander.radius_m(),
                   SecondsBetween(Simulator::kEpoch, flown->touchdown->time));
  }
  const MissionOutcome outcome =
      OutcomeOf(flown->summary.final_state, flown->summary.site.has_value(), under,
                TruthLimitsOf(flight->settings));
  std::fprintf(stderr, "seed %llu: %s\n", static_cast<unsigned long long>(seed),
               MissionOutcomeName(outcome));
  return std::vector<TrialRow>{{MissionOutcomeName(outcome), CsvNumber(flown->summary.duration_s),
                                CsvNumber(flown->ways), CsvNumber(flown->outside_m),
                                CsvNumber(away_m),
                                CsvNumber(flown->summary.touchdown_miss_m.value_or(NAN)),
                                flown->why.empty() ? "none" : CsvText(flown->why)}};
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: the search for one safe place")};
  const int trials = static_cast<int>(table.rows.size());
  const auto count = [&](MissionOutcome outcome) {
    return static_cast<int>(table.Where("outcome", MissionOutcomeName(outcome)).rows.size());
  };
  const auto share = [trials](int hits) { return ShareText(hits, trials); };
  double outside_m = 0;
  int left = 0;
  for (const double by_m : table.Numbers("outside_m")) {
    outside_m = std::fmax(outside_m, by_m);
    left += by_m > kStrays_m ? 1 : 0;
  }
  const TrialTable right = table.Where("outcome", MissionOutcomeName(MissionOutcome::kLandedRight));
  const int landed = static_cast<int>(right.rows.size());
  const int on_hazard = count(MissionOutcome::kLandedOnHazard);
  report.passed = landed >= kWanted * trials && on_hazard == 0 && left == 0;
  report.lines = {"Found and landed right: " + share(landed), "On a hazard: " + share(on_hazard),
                  "Outside the area by more than " + WithNumbers("%.1f m", kStrays_m) + ": " +
                      share(left) + WithNumbers("; at most %.2f m", outside_m)};
  if (landed > 0) {
    const std::vector<double> time_s = right.Numbers("duration_s"), ways = right.Numbers("ways");
    report.lines.push_back(WithNumbers("Flown until the touchdown: median %.0f s, most %.0f s",
                                       Percentile(time_s, 0.5), Percentile(time_s, 1)) +
                           WithNumbers("; ways to other hovers: median %.0f, most %.0f",
                                       Percentile(ways, 0.5), Percentile(ways, 1)));
  }
  std::vector<std::vector<std::string>> rows;
  for (const std::vector<std::string>& row : table.rows) {
    rows.push_back({row.begin() + 1, row.end()});
  }
  report.page.List(report.lines)
      .Paragraph(
          "Shares with 95 % intervals (Wilson). Each world is 80 by 80 m of mounds, holes and "
          "rocks "
          "that leave no gap but one clearing, drawn anywhere in it; the vehicle starts over its "
          "middle, and is kept to it by a drawn area.")
      .Table({"Seed", "Outcome", "Flown, s", "Ways", "Outside, m", "Landed from the start, m",
              "Miss, m", "Why not landed"},
             rows);
  return report;
}

}  // namespace

Experiment SearchExperiment(SceneCameraFactory camera) {
  auto options = std::make_shared<FlightOptions>();
  Experiment experiment;
  experiment.name = "search";
  experiment.purpose = "One safe place in 80 by 80 m, searched for and landed on";
  experiment.default_trials = 10;
  experiment.columns = {"outcome", "duration_s",       "ways", "outside_m",
                        "away_m",  "touchdown_miss_m", "why"};
  experiment.add_options = [options](CLI::App& verb) {
    options->AddVehicle(verb);
    options->AddWind(verb, 15);
    options->AddSet(verb);
    options->AddRecord(verb);
  };
  experiment.setup = [options] {
    return "vehicle " + options->vehicle + ", " + options->WindText() + options->SetText();
  };
  experiment.run = [options, camera = std::move(camera)](int, std::uint64_t seed) {
    return RunTrial(*options, seed, camera);
  };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
