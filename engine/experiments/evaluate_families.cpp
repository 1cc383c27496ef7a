#include "engine/experiments/evaluate_families.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/text.h"
#include "engine/experiments/family_options.h"
#include "engine/experiments/flight_options.h"
#include "engine/experiments/landing_truth.h"
#include "engine/report/figure_text.h"
#include "engine/world/families/families.h"
#include "engine/world/ground_truth.h"

namespace palace {
namespace {

constexpr double kUnapprovedLimit_s = 45;  // of hovering in one place
constexpr double kSearchLimit_s = 240;     // of a search from place to place
constexpr double kStoppedLimit_s = 25;     // of a hold or a climb
constexpr int kLooksAgain = 4;             // of the operator
constexpr double kLimit_s = 420;           // time for them
/// Where a hover over the origin with a tilted camera can see ground at all.
constexpr TruthArea kInView{.north_min_m = 4, .north_max_m = 40, .cell_m = 0.1};

struct FamiliesOptions {
  FlightOptions mission;
  FamilyOptions worlds;
  bool no_look = false;
  bool no_search = false;
};

const char* VerdictName(const DiscTruth& disc, const TruthLimits& limits) {
  return WithinLimits(disc, limits)                       ? "within"
         : WithinLimits(disc, limits.Scaled(kTruthGrace)) ? "over"
                                                          : "far_over";
}

TrialRow RowOf(const std::string& family, const World& world, const FlownMission& flown,
               const Settings& settings) {
  const Lander& lander = settings.slad.lander;
  const TruthLimits limits = TruthLimitsOf(settings);
  std::optional<DiscTruth> under, site;
  if (flown.touchdown) {
    under = DiscAt(world, flown.touchdown->p_W_skid.head<2>(), lander.radius_m(),
                   SecondsBetween(Simulator::kEpoch, flown.touchdown->time));
  }
  if (flown.summary.site) {
    site = DiscAt(world, flown.summary.site->p_WS.head<2>(), lander.clear_radius_m(),
                  SecondsBetween(Simulator::kEpoch, flown.summary.approved_at));
  }
  const SafePlaces places =
      FindSafePlaces(TruthOf(world, kInView), lander.clear_radius_m(), limits, 0.5);
  const auto of_disc = [](const std::optional<DiscTruth>& disc, double DiscTruth::*value) {
    return CsvNumber(disc ? (*disc).*value : NAN);
  };
  return {family,
          MissionOutcomeName(
              OutcomeOf(flown.summary.final_state, flown.summary.site.has_value(), under, limits)),
          CsvNumber(flown.summary.duration_s),
          CsvNumber(flown.summary.touchdown_miss_m.value_or(NAN)),
          of_disc(under, &DiscTruth::slope_deg),
          of_disc(under, &DiscTruth::deviation_m),
          of_disc(under, &DiscTruth::step_m),
          of_disc(under, &DiscTruth::water_share),
          of_disc(under, &DiscTruth::moving_share),
          under ? VerdictName(*under, limits) : "none",
          site ? VerdictName(*site, limits) : "none",
          CsvNumber(flown.touchdown ? flown.touchdown->hard() : NAN),
          CsvNumber(places.Count()),
          CsvNumber(flown.summary.looks),
          !flown.summary.site            ? "none"
          : flown.summary.site_confirmed ? "confirmed"
                                         : "provisional",
          flown.why.empty() ? "none" : CsvText(flown.why)};
}

Result<std::vector<TrialRow>> RunTrial(const FamiliesOptions& options, std::uint64_t seed,
                                       const SceneCameraFactory& camera) {
  Result<MissionFlight> flight = options.mission.Flight(seed);
  if (!flight) {
    return flight.error();
  }
  flight->unapproved_limit_s = options.no_search ? kUnapprovedLimit_s : kSearchLimit_s;
  flight->searches = !options.no_search;
  flight->stopped_limit_s = kStoppedLimit_s;
  flight->looks_again = kLooksAgain;
  flight->looks_closer = !options.no_look;
  flight->limit_s = kLimit_s;
  std::vector<TrialRow> rows;
  for (const std::string& family : options.worlds.Families()) {
    const Result<World> world = MakeFamily(family, seed);
    if (!world) {
      return world.error();
    }
    flight->scenario = family;
    const Result<FlownMission> flown = FlyMission(*flight, camera);
    if (!flown) {
      return flown.error();
    }
    rows.push_back(RowOf(family, *world, *flown, flight->settings));
    std::fprintf(stderr, "seed %llu, %s: %s\n", static_cast<unsigned long long>(seed),
                 family.c_str(), rows.back()[1].c_str());
  }
  return rows;
}

int CountOf(const TrialTable& table, MissionOutcome outcome) {
  return static_cast<int>(table.Where("outcome", MissionOutcomeName(outcome)).rows.size());
}

/// How many missions looked closer, and what was then known of the sites that they approved.
std::string LooksLine(const TrialTable& table) {
  const std::vector<double> looks = table.Numbers("looks");
  const std::size_t approved_as = table.Index("approved_as");
  int looked = 0, approved = 0, confirmed = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (looks[i] > 0) {
      ++looked;
      approved += table.rows[i][approved_as] != "none" ? 1 : 0;
      confirmed += table.rows[i][approved_as] == "confirmed" ? 1 : 0;
    }
  }
  return "Looked closer: " + ShareText(looked, static_cast<int>(table.rows.size())) +
         WithNumbers(" missions; of these %.0f approved a site to land on, %.0f a confirmed one",
                     approved, confirmed);
}

/// A row of the page: how the missions of one family, or all of them, ended.
std::vector<std::string> OutcomeRow(const std::string& name, const TrialTable& table) {
  const int trials = static_cast<int>(table.rows.size());
  std::vector<std::string> row = {name};
  for (int i = 0; i < kMissionOutcomeCount; ++i) {
    row.push_back(ShareText(CountOf(table, static_cast<MissionOutcome>(i)), trials));
  }
  int with_place = 0;
  for (const double places : table.Numbers("safe_places")) {
    with_place += places > 0 ? 1 : 0;
  }
  row.push_back(WithNumbers("%.0f", with_place));
  return row;
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: missions on every family of worlds")};
  const int trials = static_cast<int>(table.rows.size());
  std::vector<std::vector<std::string>> rows;
  for (const std::string& family : table.Values("family")) {
    const TrialTable of_family = table.Where("family", family);
    rows.push_back(OutcomeRow(family, of_family));
    std::string line = family + ":";
    for (int i = 0; i < kMissionOutcomeCount; ++i) {
      const auto outcome = static_cast<MissionOutcome>(i);
      const int count = CountOf(of_family, outcome);
      line += count == 0
                  ? ""
                  : std::string(" ") + MissionOutcomeName(outcome) + WithNumbers(" %.0f", count);
    }
    report.lines.push_back(line);
  }
  rows.push_back(OutcomeRow("all", table));
  const int landed = CountOf(table, MissionOutcome::kLandedRight) +
                     CountOf(table, MissionOutcome::kLandedOnHazard);
  const int on_hazard = CountOf(table, MissionOutcome::kLandedOnHazard);
  const TrialTable approved_over = table.Where("site_truth", "far_over");
  report.passed = on_hazard == 0;
  report.lines.push_back(LooksLine(table));
  report.lines.push_back("Landed right, of all missions: " +
                         ShareText(CountOf(table, MissionOutcome::kLandedRight), trials));
  report.lines.push_back("On a hazard (over 1.2 times a limit), of all landings: " +
                         ShareText(on_hazard, landed));
  report.lines.push_back(
      "Approved a site with a touchdown over 1.2 times a limit within the navigation error: " +
      ShareText(static_cast<int>(approved_over.rows.size()), trials));
  report.page.List({report.lines.end() - 4, report.lines.end()})
      .Paragraph(
          "Shares with 95 % intervals (Wilson). A landing is right when the ground under the "
          "vehicle at the true touchdown is within 1.2 times the limits of slope, deviation and "
          "step and holds neither water nor anything that moves. The last column counts the worlds "
          "that have a safe place at all where the camera can look from the start.")
      .Table({"Family", "Landed right", "Landed on a hazard", "Held", "Climbed away", "Refused",
              "Unfinished", "Worlds with a safe place"},
             rows);
  std::vector<std::vector<std::string>> missions;
  for (const std::vector<std::string>& row : table.rows) {
    missions.push_back({row.begin() + 1, row.end()});
  }
  report.page.Heading("Missions")
      .Table({"Seed", "Family", "Outcome", "Flown, s", "Miss, m", "Slope, deg", "Deviation, m",
              "Step, m", "Water", "Moving", "Touchdown", "Site", "Hard", "Safe places", "Looks",
              "Approved as", "Why not landed"},
             missions);
  return report;
}

}  // namespace

Experiment FamiliesExperiment(SceneCameraFactory camera) {
  auto options = std::make_shared<FamiliesOptions>();
  Experiment experiment;
  experiment.name = "families";
  experiment.purpose = "Whole missions on every family of worlds, held against their truth";
  experiment.default_trials = 8;
  experiment.columns = {"family",       "outcome",         "duration_s",  "touchdown_miss_m",
                        "slope_deg",    "deviation_m",     "step_m",      "water_share",
                        "moving_share", "touchdown_truth", "site_truth",  "hard",
                        "safe_places",  "looks",           "approved_as", "why"};
  experiment.add_options = [options](CLI::App& verb) {
    options->worlds.Add(verb);
    options->mission.AddVehicle(verb);
    options->mission.AddWind(verb, 15);
    options->mission.AddSet(verb);
    options->mission.AddRecord(verb);
    verb.add_flag("--no-closer-look", options->no_look,
                  "Approve at once also where a closer look is offered");
    verb.add_flag("--no-search", options->no_search,
                  "Wait in one place where nothing can be approved, 45 s");
  };
  experiment.setup = [options] {
    return options->worlds.Text() + ", vehicle " + options->mission.vehicle + ", " +
           options->mission.WindText() + options->mission.SetText() +
           (options->no_look ? ", no closer look" : "") + (options->no_search ? ", no search" : "");
  };
  experiment.run = [options, camera = std::move(camera)](int, std::uint64_t seed) {
    return RunTrial(*options, seed, camera);
  };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
