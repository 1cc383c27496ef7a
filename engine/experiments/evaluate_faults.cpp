#include "engine/experiments/evaluate_faults.h"

#include <cstdio>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/text.h"
#include "engine/experiments/fault_flight.h"
#include "engine/experiments/flight_options.h"
#include "engine/report/statistics.h"

namespace palace {
namespace {

struct FaultOptions {
  FlightOptions mission{.wind_mps = 3};
  bool cameras = false;
  std::string phase = "both";
  std::string only;
};

bool Wanted(const FaultOptions& options, const FaultCase& row) {
  return (!options.cameras || row.of_cameras) &&
         (options.only.empty() || std::string(row.name).find(options.only) != std::string::npos);
}

std::string Seconds(double value) {
  char text[24];
  std::snprintf(text, sizeof text, "%.1f", value);
  return std::isfinite(value) ? text : "";
}

std::string Metres(double value) {
  char text[24];
  std::snprintf(text, sizeof text, "%.3f", value);
  return std::isfinite(value) ? text : "";
}

TrialRow RowOfOutcome(const FaultCase& row, FaultPhase phase, const FaultOutcome& outcome) {
  std::vector<std::string> seen;
  for (const RaisedAlarm& alarm : outcome.raised) {
    seen.push_back(std::string(AlarmName(alarm.id)) + " +" + Seconds(alarm.after_s));
  }
  const RaisedAlarm* named = nullptr;
  for (const RaisedAlarm& alarm : outcome.raised) {
    for (const AlarmId id : row.cause) {
      named = named == nullptr && alarm.id == id ? &alarm : named;
    }
  }
  std::string does;
  if (phase == FaultPhase::kArmed) {
    does = outcome.approved ? "approved" : "blocked: " + outcome.blocked_by;
  } else {
    does = std::string(std::isfinite(outcome.end_s) ? MissionStateName(outcome.end) : "goes on") +
           (outcome.why.empty() ? "" : ": " + outcome.why);
  }
  const std::vector<std::string> falls = Shortfalls(row, phase, outcome);
  std::string wanting;
  for (const std::string& fall : falls) {
    wanting += (wanting.empty() ? "" : "; ") + fall;
  }
  std::string all;
  for (const std::string& one : seen) {
    all += (all.empty() ? "" : "; ") + one;
  }
  return {row.name,
          row.row,
          FaultPhaseName(phase),
          all.empty() ? "nothing" : all,
          named != nullptr ? AlarmName(named->id) : "none",
          named != nullptr ? CsvNumber(named->after_s) : CsvNumber(NAN),
          named != nullptr ? CsvText(named->text) : "none",
          CsvText(does),
          CsvNumber(outcome.end_s),
          CsvNumber(outcome.miss_m),
          CsvNumber(outcome.ground_s),
          outcome.recorded ? "yes" : "no",
          wanting.empty() ? "ok" : wanting};
}

Result<std::vector<TrialRow>> RunTrial(const FaultOptions& options, std::uint64_t seed,
                                       const SceneCameraFactory& camera) {
  const Result<MissionFlight> asked = options.mission.Flight(seed);
  if (!asked) {
    return asked.error();
  }
  const FaultFlight flight{asked->scenario, asked->wind_mps, asked->seed, asked->settings};
  std::vector<TrialRow> rows;
  for (const FaultCase& row : FaultCases()) {
    for (const FaultPhase phase : {FaultPhase::kArmed, FaultPhase::kDescent}) {
      if (!Wanted(options, row) ||
          (options.phase != "both" && options.phase != FaultPhaseName(phase))) {
        continue;
      }
      const Result<FaultOutcome> outcome = FlyUnderFault(flight, row, phase, camera);
      if (!outcome) {
        return outcome.error();
      }
      rows.push_back(RowOfOutcome(row, phase, *outcome));
      std::fprintf(stderr, "\r%-34s %-8s %s\n", row.name, FaultPhaseName(phase),
                   rows.back().back().c_str());
    }
  }
  if (rows.empty()) {
    return UsageError("no fault is called \"" + options.only + "\"; leave --only away to list all");
  }
  return rows;
}

/// Rows of the table of one fault in one phase.
struct Group {
  std::string fault, phase;
  std::vector<std::size_t> rows;
};

std::vector<Group> GroupsOf(const TrialTable& table) {
  std::vector<Group> groups;
  const std::size_t fault = table.Index("fault"), phase = table.Index("phase");
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::vector<std::string>& row = table.rows[i];
    auto group = groups.begin();
    while (group != groups.end() && (group->fault != row[fault] || group->phase != row[phase])) {
      ++group;
    }
    if (group == groups.end()) {
      groups.push_back({row[fault], row[phase], {}});
      group = groups.end() - 1;
    }
    group->rows.push_back(i);
  }
  return groups;
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: faults between vehicle and station")};
  const std::size_t wanting = table.Index("wanting");
  const std::size_t landed_column = table.Index("does");
  const std::vector<double> named_s = table.Numbers("named_s");
  std::vector<std::vector<std::string>> cells;
  int good = 0, cameras_landed_unseen = 0;
  std::vector<std::string> short_of;
  for (const Group& group : GroupsOf(table)) {
    int ok = 0, unseen = 0;
    double slowest_s = NAN;
    std::string first_wanting, does;
    for (const std::size_t i : group.rows) {
      const std::string& text = table.rows[i][wanting];
      ok += text == "ok" ? 1 : 0;
      first_wanting = first_wanting.empty() && text != "ok" ? text : first_wanting;
      unseen += text.find("not seen since") != std::string::npos ? 1 : 0;
      does = does.empty() ? table.rows[i][landed_column] : does;
      slowest_s = std::isnan(named_s[i]) || named_s[i] <= slowest_s ? slowest_s : named_s[i];
    }
    const int count = static_cast<int>(group.rows.size());
    good += ok == count ? 1 : 0;
    cameras_landed_unseen += unseen;
    if (ok != count) {
      short_of.push_back(group.fault + ", " + group.phase + ": " + first_wanting +
                         WithNumbers(" (%.0f of %.0f)", count - ok, count));
    }
    const std::vector<std::string>& first = table.rows[group.rows.front()];
    cells.push_back(
        {group.fault, first[table.Index("row")], group.phase, first[table.Index("seen")],
         first[table.Index("named_by")], Seconds(slowest_s), first[table.Index("said")], does,
         Metres(table.Numbers("miss_m")[group.rows.front()]), first[table.Index("recorded")],
         WithNumbers("%.0f of %.0f", ok, count), first_wanting.empty() ? "-" : first_wanting});
  }
  report.passed = good == static_cast<int>(cells.size());
  report.lines = {
      WithNumbers("Rows as they should be: %.0f of %.0f", good, static_cast<double>(cells.size())),
      WithNumbers("Landed on ground not seen since the fault: %.0f of %.0f flights",
                  cameras_landed_unseen, static_cast<double>(table.rows.size()))};
  report.page.List(report.lines);
  report.page.Heading("Each fault")
      .Table({"Fault", "Row", "Phase", "Seen (first seed), s after the fault", "Named by",
              "Slowest, s", "Said", "Approve, or the descent", "Miss, m", "Recorded",
              "As it should be", "Wanting"},
             cells);
  for (std::string& line : short_of) {
    report.lines.push_back("Short: " + std::move(line));
  }
  return report;
}

}  // namespace

Experiment FaultsExperiment(SceneCameraFactory camera) {
  auto options = std::make_shared<FaultOptions>();
  Experiment experiment;
  experiment.name = "faults";
  experiment.purpose = "Each fault between vehicle and station: what is seen, said, blocked, done";
  experiment.default_trials = 1;
  experiment.columns = {"fault", "row",   "phase",  "seen",     "named_by", "named_s", "said",
                        "does",  "end_s", "miss_m", "ground_s", "recorded", "wanting"};
  experiment.add_options = [options](CLI::App& verb) {
    options->mission.AddScenario(verb);
    options->mission.AddWind(verb, 8);
    verb.add_flag("--cameras", options->cameras, "Faults of cameras only");
    verb.add_option("--phase", options->phase, "armed, descent or both")
        ->check(CLI::IsMember({"armed", "descent", "both"}))
        ->capture_default_str();
    verb.add_option("--only", options->only, "Faults whose name contains this");
    options->mission.AddSet(verb);
  };
  experiment.setup = [options] {
    return options->mission.SceneText() + ", " + options->mission.WindText() + ", phase " +
           options->phase + (options->cameras ? ", cameras" : "") +
           (options->only.empty() ? "" : ", only " + options->only) + options->mission.SetText();
  };
  experiment.run = [options, camera = std::move(camera)](int, std::uint64_t seed) {
    return RunTrial(*options, seed, camera);
  };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
