// What every experiment of `palacectl evaluate` shares: trials with seeds of their own, shards, a
// CSV of the trials, and a report that is made from the CSV alone.
//
// Trial i of an experiment always has the same seed and gives the same rows, whoever runs it, so
// shards run anywhere merge to the very file an unsharded run writes, and a run that was killed
// goes on to that file too (trial_record.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/report/experiment_report.h"
#include "engine/report/trial_table.h"

namespace CLI {
class App;
}

namespace palace {

/// One row a trial reports, without trial and seed; as many texts as the experiment has columns.
using TrialRow = std::vector<std::string>;

/// An experiment is data: what a trial does, and how the table of all trials is read.
struct Experiment {
  std::string name;     ///< verb and name of the CSV
  std::string purpose;  ///< one line for --help
  int default_trials = 10;
  std::vector<std::string> columns;  ///< beside trial and seed
  /// Options that change the result are added here; the text of all of them must come back from
  /// `setup`, because it stands in the CSV and shards with different ones must not be merged.
  std::function<void(CLI::App&)> add_options{};
  std::function<std::string()> setup{};
  std::function<Result<std::vector<TrialRow>>(int trial, std::uint64_t seed)> run;
  std::function<ExperimentReport(const TrialTable&)> report;
};

/// Adds `evaluate NAME` for each experiment, and `evaluate merge --out DIR SHARD...`.
/// Options: --trials --seed --shard i/n --out --resume --overwrite. Writes NAME.csv and, unless it
/// is a shard, report.html; over results of another run only when asked (finished_results.h).
void AddExperiments(CLI::App& evaluate, const std::vector<Experiment>& experiments, int& exit_code);

/// The trials that one of the experiments wrote: a CSV, or the folder that holds one. Errors name
/// the file, the line, and what another version or another experiment wrote.
Result<TrialFile> ReadTrials(const std::vector<Experiment>& experiments,
                             const std::filesystem::path& path);

/// Seed of one trial, --seed + trial: `--seed 17 --trials 1` repeats trial 16 of `--seed 1`.
std::uint64_t TrialSeed(std::uint64_t seed, int trial);

}  // namespace palace
