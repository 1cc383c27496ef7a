#include "engine/experiments/experiment.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <latch>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/check.h"
#include "engine/core/command_line.h"
#include "engine/core/files.h"
#include "engine/core/termination.h"
#include "engine/core/text.h"
#include "engine/experiments/finished_results.h"
#include "engine/experiments/run_inputs.h"
#include "engine/experiments/trial_record.h"

namespace palace {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kLargestTable = std::size_t{1} << 30;

struct RunOptions {
  int trials = 10;
  std::uint64_t seed = 1;
  std::string shard = "1/1";
  fs::path out;
  bool resume = false;
  bool overwrite = false;
  const CLI::App* verb = nullptr;
};

int Fail(const Error& error) {
  std::cerr << "palacectl: " << error.message << "\n";
  return error.code == ErrorCode::kUsage ? 2 : 1;
}

/// The CSV that a path means: the file itself, or the only experiment's CSV of the folder.
Result<fs::path> CsvOf(const fs::path& path, const std::vector<Experiment>& experiments) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    return path;
  }
  std::vector<std::string> found;
  for (const Experiment& experiment : experiments) {
    if (fs::exists(path / (experiment.name + ".csv"), error)) {
      found.push_back(experiment.name + ".csv");
    }
  }
  if (found.size() > 1) {
    return UsageError(path.string() + " holds the tables of several experiments, " + Joined(found) +
                      ": name one of these files");
  }
  if (found.empty()) {
    return UnavailableError(path.string() + " holds no table of an experiment");
  }
  return path / found.front();
}

Status CheckColumns(const std::vector<Experiment>& experiments, const TrialFile& file,
                    const std::string& name) {
  for (const Experiment& experiment : experiments) {
    if (experiment.name == file.header.experiment) {
      std::vector<std::string> columns = {"trial", "seed"};
      columns.insert(columns.end(), experiment.columns.begin(), experiment.columns.end());
      return columns == file.table.columns
                 ? Ok()
                 : InvalidError(name + ": the columns are not those of this version's " +
                                experiment.name + "; run the shards again");
    }
  }
  return InvalidError(name + ": there is no experiment '" + file.header.experiment + "'");
}

Status WriteCsv(const TrialFile& file, const fs::path& out) {
  if (out.empty()) {
    return Ok();
  }
  const fs::path csv = out / (file.header.experiment + ".csv");
  const Status written = WriteTextFile(csv, TrialFileText(file));
  if (written) {
    std::cout << "wrote " << csv.string() << "\n";
  }
  return written;
}

/// For a whole run. Returns the exit code.
int WriteReport(const Experiment& experiment, const TrialFile& file, const fs::path& out) {
  if (!file.header.shard.whole()) {
    std::cout << "shard " << file.header.shard.index << " of " << file.header.shard.count
              << "; join the shards with: palacectl evaluate merge --out DIR SHARD_DIR...\n";
    return 0;
  }
  ExperimentReport report = experiment.report(file.table);
  for (const std::string& line : report.lines) {
    std::cout << line << "\n";
  }
  if (!out.empty()) {
    const TrialHeader& h = file.header;
    report.page.Heading("How this was made")
        .Paragraph("palacectl evaluate " + h.experiment + ", " + std::to_string(h.trials) +
                   " trials, seed " + std::to_string(h.seed) + "; " + h.setup)
        .Link("Every trial:", experiment.name + ".csv");
    const fs::path page = out / "report.html";
    if (const Status written = WriteTextFile(page, report.page.Text()); !written) {
      return Fail(written.error());
    }
    std::cout << "wrote " << page.string() << "\n";
  }
  return report.passed ? 0 : 1;
}

int WriteResults(const Experiment& experiment, const TrialFile& file, const fs::path& out) {
  const Status written = WriteCsv(file, out);
  return written ? WriteReport(experiment, file, out) : Fail(written.error());
}

/// Of a run that was asked to end, what is done is a whole run of fewer trials: trial i is the same
/// in both. A shard of it would be one of nothing.
int WriteEnded(const Experiment& experiment, TrialFile file, int done, const fs::path& out) {
  if (!out.empty()) {
    std::cerr << "palacectl: the same command with --resume goes on from here\n";
  }
  if (!file.header.shard.whole()) {
    std::cerr << "palacectl: ended before its last trial; a part of a shard cannot be merged\n";
    return 0;
  }
  if (done == 0) {
    std::cerr << "palacectl: ended before its first trial was done, nothing was written\n";
    return 0;
  }
  std::cerr << "palacectl: ended after trial " << done << " of " << file.header.trials << "\n";
  file.header.trials = done;
  return WriteResults(experiment, file, out);
}

/// The rows of a trial: as the record has them, or run now, out of `hand`, and kept there.
Result<std::vector<TrialRow>> RunTrial(const Experiment& experiment, int trial, std::uint64_t seed,
                                       std::optional<TrialRecord>& record,
                                       std::unique_lock<std::mutex>& hand) {
  if (record && record->Done(trial) != nullptr) {
    return *record->Done(trial);
  }
  hand.unlock();
  Result<std::vector<TrialRow>> rows = experiment.run(trial, seed);
  hand.lock();
  if (rows && record) {
    if (const Status kept = record->Add(trial, *rows); !kept) {
      return kept.error();
    }
  }
  return rows;
}

/// Nothing is run or written; the results are told as when they were made, with that exit code.
int TellDone(const Experiment& experiment, const TrialFile& held, const fs::path& out) {
  std::cerr << "palacectl: " << (out / (experiment.name + ".csv")).string() << " holds all "
            << WhatIsHeld(held.header)
            << ", of whichever program and input files; --overwrite runs them again\n";
  return WriteReport(experiment, held, {});
}

Result<TrialRecord> OpenRecord(const Experiment& experiment, const TrialHeader& header,
                               const RunOptions& options) {
  const fs::path path = options.out / (experiment.name + ".trials");
  if (options.overwrite && !options.resume) {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  return TrialRecord::Open(path, {header, experiment.columns, InputsOf(*options.verb)},
                           options.resume);
}

/// The trials that are done, shared with the thread that is told of a signal: a trial may take
/// minutes, and whoever wants an end does not wait for it.
class DoneTrials {
 public:
  DoneTrials(const Experiment& experiment, const fs::path& out)
      : experiment_(experiment), out_(out) {}

  TrialFile& file() { return file_; }
  /// Held while trials are added or written, not while one is run.
  std::mutex& hand() { return hand_; }
  /// So many are in the file; under `hand`.
  void Have(int trials) { done_ = trials; }
  /// Whether trials run; under `hand`.
  void Run(bool running) { running_ = running; }

  /// What is done is written, the trial that runs is given up, and the program ends.
  [[noreturn]] void End(int exit_code) {
    const std::lock_guard held(hand_);
    if (running_) {
      std::cerr << "\npalacectl: the trial in hand is given up\n";
      (void)WriteEnded(experiment_, std::move(file_), done_, out_);
    }
    std::cout.flush();
    std::fflush(stdout);
    _exit(exit_code);  // the other thread is in its trial
  }

 private:
  const Experiment& experiment_;
  const fs::path out_;
  std::mutex hand_;
  TrialFile file_;
  int done_ = 0;
  bool running_ = false;
};

int RunExperiment(const Experiment& experiment, const RunOptions& options) {
  DoneTrials done(experiment, options.out);
  std::latch termination_made(1);
  const Termination termination([&] {
    termination_made.wait();
    done.End(termination.exit_code());
  });
  termination_made.count_down();
  std::unique_lock hand(done.hand());  // given back before the other thread is waited for
  const Result<Shard> shard = ParseShard(options.shard);
  if (!shard) {
    return Fail(shard.error());
  }
  if (!shard->whole() && options.out.empty()) {
    return Fail(UsageError("--shard needs --out, a folder of its own for each shard"));
  }
  if (options.resume && options.out.empty()) {
    return Fail(UsageError("--resume needs --out, the folder of the run that ended early"));
  }
  if (!options.out.empty()) {
    if (const Status made = MakeFolder(options.out); !made) {
      return Fail(made.error());
    }
  }
  TrialFile& file = done.file();
  file.header = {experiment.name, experiment.setup ? experiment.setup() : "defaults", options.seed,
                 options.trials, *shard};
  file.table.columns = {"trial", "seed"};
  file.table.columns.insert(file.table.columns.end(), experiment.columns.begin(),
                            experiment.columns.end());
  std::optional<TrialRecord> record;
  if (!options.out.empty()) {
    std::optional<TrialFile> held;
    if (!options.overwrite) {
      Result<std::optional<TrialFile>> found =
          FinishedResults(options.out / (experiment.name + ".csv"), file.table.columns);
      if (!found) {
        return Fail(found.error());
      }
      held = *std::move(found);
    }
    if (held && options.resume && IsSameRun(held->header, file.header)) {
      return TellDone(experiment, *held, options.out);
    }
    Result<TrialRecord> opened = OpenRecord(experiment, file.header, options);
    if (!opened) {
      return Fail(opened.error());
    }
    record = std::move(*opened);
    if (held && !IsKept(held->header, file.header, *record)) {
      record->Finish(0);
      return Fail(WouldReplace(options.out / (experiment.name + ".csv"), held->header));
    }
    if (record->done_count() > 0) {
      std::cerr << "palacectl: " << record->done_count() << " trials were done before\n";
    }
  }
  done.Run(true);
  for (int trial = 0; trial < options.trials; ++trial) {
    if (!shard->Holds(trial)) {
      continue;
    }
    const std::uint64_t seed = TrialSeed(options.seed, trial);
    const Result<std::vector<TrialRow>> rows = RunTrial(experiment, trial, seed, record, hand);
    if (!rows) {
      return Fail(rows.error());
    }
    for (const TrialRow& values : *rows) {
      PALACE_CHECK(values.size() == experiment.columns.size(), experiment.name, values.size());
      std::vector<std::string> row = {std::to_string(trial), std::to_string(seed)};
      row.insert(row.end(), values.begin(), values.end());
      file.table.rows.push_back(std::move(row));
    }
    done.Have(trial + 1);
    std::fprintf(stderr, "\r%s: trial %d of %d", experiment.name.c_str(), trial + 1,
                 options.trials);
  }
  done.Run(false);
  std::fputc('\n', stderr);
  if (const Status written = WriteCsv(file, options.out); !written) {
    return Fail(written.error());
  }
  if (record) {
    record->Finish(options.trials);
  }
  return WriteReport(experiment, file, options.out);
}

int Merge(const std::vector<Experiment>& experiments, const std::vector<std::string>& paths,
          const fs::path& out, bool overwrite) {
  std::vector<TrialFile> shards;
  std::vector<fs::path> inputs;
  for (const std::string& path : paths) {
    const Result<fs::path> csv = CsvOf(path, experiments);
    if (!csv) {
      return Fail(csv.error());
    }
    Result<TrialFile> shard = ReadTrials(experiments, *csv);
    if (!shard) {
      return Fail(shard.error());
    }
    shards.push_back(std::move(*shard));
    inputs.push_back(*csv);
  }
  const Result<TrialFile> merged = MergeTrialFiles(shards);
  if (!merged) {
    return Fail(merged.error());
  }
  for (const Experiment& experiment : experiments) {
    if (experiment.name != merged->header.experiment) {
      continue;
    }
    if (const Status made = MakeFolder(out); !made) {
      return Fail(made.error());
    }
    for (const fs::path& csv : inputs) {
      std::error_code error;
      if (fs::equivalent(csv, out / (experiment.name + ".csv"), error)) {
        return Fail(UsageError("merge: --out " + out.string() + " would overwrite the shard " +
                               csv.string() + "; choose another folder"));
      }
    }
    if (!overwrite) {
      const fs::path csv = out / (experiment.name + ".csv");
      const Result<std::optional<TrialFile>> held = FinishedResults(csv, merged->table.columns);
      if (!held) {
        return Fail(held.error());
      }
      if (*held && !IsSameRun((*held)->header, merged->header)) {
        return Fail(WouldReplace(csv, (*held)->header));
      }
    }
    return WriteResults(experiment, *merged, out);
  }
  PALACE_CHECK(false, merged->header.experiment);
  return 1;
}

}  // namespace

Result<TrialFile> ReadTrials(const std::vector<Experiment>& experiments,
                             const std::filesystem::path& path) {
  const Result<fs::path> csv = CsvOf(path, experiments);
  if (!csv) {
    return csv.error();
  }
  const Result<std::string> text = ReadTextFile(*csv, kLargestTable);
  if (!text) {
    return text.error();
  }
  Result<TrialFile> file = ParseTrialFile(*text, csv->string());
  if (file) {
    if (const Status good = CheckColumns(experiments, *file, csv->string()); !good) {
      return good.error();
    }
  }
  return file;
}

std::uint64_t TrialSeed(std::uint64_t seed, int trial) {
  return seed + static_cast<std::uint64_t>(trial);
}

void AddExperiments(CLI::App& evaluate, const std::vector<Experiment>& experiments,
                    int& exit_code) {
  const auto all = std::make_shared<const std::vector<Experiment>>(experiments);
  for (std::size_t i = 0; i < all->size(); ++i) {
    const Experiment& experiment = (*all)[i];
    CLI::App* verb = evaluate.add_subcommand(experiment.name, experiment.purpose);
    auto options = std::make_shared<RunOptions>();
    options->trials = experiment.default_trials;
    options->verb = verb;
    verb->add_option("--trials", options->trials, "Trials, over all shards")
        ->check(FiniteRange(1, 1e6))
        ->capture_default_str();
    verb->add_option("--seed", options->seed, "Seed of the first trial; the others count on")
        ->check(Seed())
        ->capture_default_str();
    verb->add_option("--shard", options->shard,
                     "i/n: only every n-th trial; `evaluate merge` joins the shards");
    verb->add_option("--out", options->out,
                     "Folder for " + experiment.name + ".csv and report.html");
    verb->add_flag("--resume", options->resume,
                   "Go on where a run into the same --out ended before its last trial; of one that "
                   "is done its results are told again");
    verb->add_flag("--overwrite", options->overwrite, "Replace what an earlier run wrote to --out");
    if (experiment.add_options) {
      experiment.add_options(*verb);
    }
    verb->callback(
        [all, i, options, &exit_code] { exit_code = RunExperiment((*all)[i], *options); });
  }
  CLI::App* merge = evaluate.add_subcommand("merge", "Joins the shards of one experiment");
  auto out = std::make_shared<fs::path>();
  auto paths = std::make_shared<std::vector<std::string>>();
  merge->add_option("--out", *out, "Folder for the joined CSV and report.html")->required();
  merge->add_option("shards", *paths, "Folders or CSV files of all shards")->required();
  auto overwrite = std::make_shared<bool>(false);
  merge->add_flag("--overwrite", *overwrite, "Replace another run's results in --out");
  merge->callback([all, out, paths, overwrite, &exit_code] {
    exit_code = Merge(*all, *paths, *out, *overwrite);
  });
}

}  // namespace palace
