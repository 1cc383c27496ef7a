#include "engine/tools/evaluate_plan.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/files.h"
#include "engine/core/time.h"
#include "engine/experiments/shard_plan.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

struct PlanOptions {
  ShardedRun run;
  std::string per_job = "10min";
  std::optional<double> trial_s;
  fs::path write;
};

struct PlanTexts {
  std::string parallel;
  std::string slurm;
  std::string merge;
};

int Fail(const Error& error) {
  std::cerr << "palacectl: " << error.message << "\n";
  return error.code == ErrorCode::kUsage ? 2 : 1;
}

/// This program by its full path, for a machine that has it in no PATH.
std::string ThisProgram() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  return error ? "palacectl" : path.string();
}

/// What was given of the verb's options that are not in `own`, as words to give them again.
std::vector<std::string> WordsOf(const CLI::App& verb, const std::set<const CLI::Option*>& own) {
  std::vector<std::string> words;
  for (const CLI::Option* option : verb.get_options()) {
    if (option->count() == 0 || own.contains(option)) {
      continue;
    }
    const std::string name = option->get_name();
    for (const std::string& value : option->results()) {
      const bool is_flag = option->get_items_expected_max() == 0;
      if (is_flag && value == "true") {
        words.push_back(name);
      } else if (is_flag || value.starts_with('-')) {
        words.push_back(name + "=" + value);
      } else {
        words.insert(words.end(), {name, value});
      }
    }
  }
  return words;
}

/// Seconds of the first trial, alone on this machine.
Result<double> TimeOneTrial(const Experiment& experiment, std::uint64_t seed) {
  std::cerr << "palacectl: timing one trial of " << experiment.name << "...\n";
  const double start = MonotonicSeconds();
  if (const auto rows = experiment.run(0, seed); !rows) {
    return rows.error();
  }
  return std::max(0.001, MonotonicSeconds() - start);
}

Status WriteTexts(const PlanTexts& texts, const fs::path& folder) {
  if (const Status made = MakeFolder(folder); !made) {
    return made;
  }
  const std::pair<const char*, std::string> files[] = {
      {"parallel.sh", "#!/bin/sh\n" + texts.parallel},
      {"slurm.sh", texts.slurm},
      {"merge.sh", "#!/bin/sh\n" + texts.merge}};
  for (const auto& [name, text] : files) {
    if (const Status written = WriteTextFile(folder / name, text); !written) {
      return written;
    }
    std::cerr << "palacectl: wrote " << (folder / name).string() << "\n";
  }
  return Ok();
}

std::string Several(int count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

void PrintHeading(const PlanOptions& options, const ShardSizes& sizes, double trial_s,
                  double job_s) {
  const ShardedRun& run = options.run;
  std::cout << "# " << run.experiment << ": " << Several(run.trials, "trial") << ", seed "
            << run.seed << "; one takes " << DurationText(trial_s)
            << (options.trial_s ? " (as given)" : " (measured: the first one, here)") << "\n# "
            << Several(sizes.shards, "shard") << " of " << Several(sizes.largest_trials, "trial")
            << " at most: " << DurationText(sizes.largest_s) << " each, "
            << DurationText(run.trials * trial_s) << " in all on one core\n";
  if (sizes.largest_s > job_s) {
    std::cout << "# One trial takes longer than --per-job " << options.per_job
              << ": each is a shard of its own.\n";
  }
  std::cout << "# The same lines again do what is missing; a shard that was killed goes on.\n";
}

void PrintTexts(const PlanTexts& texts) {
  std::cout << "\n# GNU parallel; the list of machines holds an ssh login a line, : is this "
               "machine\n"
            << texts.parallel
            << "\n# Slurm; a file for sbatch, from the next line to the one with exec. All nodes "
               "share this folder.\n"
            << texts.slurm << "\n# When all shards are done\n"
            << texts.merge;
}

int Plan(const Experiment& experiment, const CLI::App& verb,
         const std::set<const CLI::Option*>& own, PlanOptions options) {
  const Result<double> job_s = ParseDuration(options.per_job, "--per-job");
  if (!job_s) {
    return Fail(job_s.error());
  }
  ShardedRun& run = options.run;
  if (const Status folder = CheckShardFolder(run.out); !folder) {
    return Fail(folder.error());
  }
  const Result<double> trial_s =
      options.trial_s ? *options.trial_s : TimeOneTrial(experiment, run.seed);
  if (!trial_s) {
    return Fail(trial_s.error());
  }
  const Result<ShardSizes> sizes = SizeShards(run.trials, *trial_s, *job_s);
  if (!sizes) {
    return Fail(sizes.error());
  }
  run.options = WordsOf(verb, own);
  run.setup = experiment.setup ? experiment.setup() : run.setup;
  const PlanTexts texts = {ParallelLines(run, *sizes), SlurmScript(run, *sizes),
                           MergeLine(run, *sizes)};
  PrintHeading(options, *sizes, *trial_s, *job_s);
  PrintTexts(texts);
  if (!options.write.empty()) {
    if (const Status written = WriteTexts(texts, options.write); !written) {
      return Fail(written.error());
    }
  }
  return 0;
}

}  // namespace

void AddEvaluatePlan(CLI::App& evaluate, const std::vector<Experiment>& experiments,
                     int& exit_code) {
  CLI::App* plan = evaluate.add_subcommand(
      "plan",
      "Shards of one experiment as lines for GNU parallel over ssh and as a Slurm job array, and "
      "the line that joins them. Shards that are done are not run again");
  plan->require_subcommand(1);
  for (const Experiment& experiment : experiments) {
    CLI::App* verb = plan->add_subcommand(experiment.name, experiment.purpose);
    auto options = std::make_shared<PlanOptions>();
    ShardedRun& run = options->run;
    run.program = ThisProgram();
    run.experiment = experiment.name;
    run.trials = experiment.default_trials;
    run.out = "evaluate-" + experiment.name;
    verb->add_option("--trials", run.trials, "Trials, over all shards")
        ->check(FiniteRange(1, 1e6))
        ->capture_default_str();
    verb->add_option("--seed", run.seed, "Seed of the first trial; the others count on")
        ->check(Seed())
        ->capture_default_str();
    verb->add_option("--per-job", options->per_job,
                     "Time of a shard, with its unit: 90s, 10min, 2h")
        ->capture_default_str();
    verb->add_option("--seconds-per-trial", options->trial_s,
                     "What one trial takes, s; without it the first one is run and timed")
        ->check(FiniteRange(0.001, 2'592'000));
    verb->add_option("--out", run.out, "Folder of the shards and of what they are joined to")
        ->capture_default_str();
    verb->add_option("--program", run.program,
                     "palacectl on those machines; without it this one's path")
        ->type_name("PATH");
    verb->add_option("--machines", run.machines, "GNU parallel's list: an ssh login a line")
        ->capture_default_str();
    verb->add_option("--write", options->write,
                     "Folder for parallel.sh, slurm.sh and merge.sh, the same texts");
    const auto own_options = verb->get_options();
    const std::set<const CLI::Option*> own(own_options.begin(), own_options.end());
    if (experiment.add_options) {
      experiment.add_options(*verb);
    }
    verb->callback([experiment, verb, own, options, &exit_code] {
      exit_code = Plan(experiment, *verb, own, *options);
    });
  }
}

}  // namespace palace
