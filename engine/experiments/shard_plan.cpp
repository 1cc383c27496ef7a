#include "engine/experiments/shard_plan.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "engine/core/check.h"
#include "engine/core/text.h"
#include "engine/report/trial_table.h"

namespace palace {
namespace {

constexpr int kMostShards = 10000;  // ParseShard takes no more
constexpr double kLongestJob_s = 720 * 3600;
constexpr double kSlowest = 3;  // shards of slow trials on slow machines, against the estimate
constexpr double kLeastLimit_min = 10;
constexpr int kSlurmTasks = 1000;  // of an array, where MaxArraySize was left as Slurm has it

std::string Count(int count) { return std::to_string(count); }

int RoundedUp(int count, int parts) { return (count - 1) / parts + 1; }

std::string Quoted(const std::string& text, const std::string& brace) {
  std::string quoted = "'";
  for (const char c : text) {
    quoted += c == '\'' ? "'\\''" : c == '{' ? brace : std::string(1, c);
  }
  return quoted + "'";
}

/// Folder of a shard for /bin/sh; `index` is a text that the shell or GNU parallel replaces.
std::string ShardFolder(const ShardedRun& run, const std::string& index, int shards) {
  return ShellWord(run.out + "/shard-") + index + "-of-" + Count(shards);
}

/// A word of `grep` for the first line of a shard's CSV, with the index in the shell's $i.
std::string HeaderWord(const ShardedRun& run, int shards) {
  TrialFile file;
  file.header = {run.experiment, run.setup, run.seed, run.trials, {1, shards}};
  const std::string text = TrialFileText(file);
  const std::string line = text.substr(0, text.find('\n'));
  const std::string mark = "; shard ";
  const auto index = line.find(mark) + mark.size();
  return ShellWord(line.substr(0, index)) + "\"$i\"" + ShellWord(line.substr(index + 1));
}

/// True in the shell when shard $i is whole.
std::string IsDone(const ShardedRun& run, int shards) {
  return "grep -qsxF " + HeaderWord(run, shards) + " " + ShardFolder(run, "\"$i\"", shards) + "/" +
         run.experiment + ".csv";
}

/// The command of one shard, up to --shard.
std::string Command(const ShardedRun& run) {
  std::string text = ShellWord(run.program) + " evaluate " + run.experiment;
  for (const std::string& option : run.options) {
    text += " " + ShellWord(option);
  }
  return text + " --trials " + Count(run.trials) + " --seed " + std::to_string(run.seed);
}

}  // namespace

Result<double> ParseDuration(const std::string& text, const std::string& option) {
  double number = NAN;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  const std::string_view unit(end, static_cast<std::size_t>(last - end));
  const double unit_s = unit == "s" ? 1 : unit == "min" ? 60 : unit == "h" ? 3600 : 0;
  const double seconds = number * unit_s;
  if (error != std::errc() || !(seconds >= 1 && seconds <= kLongestJob_s)) {
    return UsageError(option + " " + text +
                      ": give a number with its unit, s, min or h, from 1s to 720h, e.g. 10min");
  }
  return seconds;
}

std::string DurationText(double seconds) {
  return seconds < 90          ? WithNumbers("%.3g s", seconds)
         : seconds < 90 * 60.0 ? WithNumbers("%.1f min", seconds / 60)
                               : WithNumbers("%.1f h", seconds / 3600);
}

Result<ShardSizes> SizeShards(int trials, double trial_s, double job_s) {
  PALACE_CHECK(trials > 0 && trial_s > 0 && job_s > 0, trials, trial_s, job_s);
  // 0.3 / 0.1 is less than 3 in binary digits.
  const double fit =
      std::clamp(std::floor(job_s / trial_s + 1e-9), 1.0, static_cast<double>(trials));
  ShardSizes sizes;
  sizes.shards = RoundedUp(trials, static_cast<int>(fit));
  if (sizes.shards > kMostShards) {
    const double needed_s = std::ceil(RoundedUp(trials, kMostShards) * trial_s);
    return UsageError("--per-job " + NumberText(job_s) + "s: " + Count(sizes.shards) +
                      " shards, at most " + Count(kMostShards) + "; give --per-job " +
                      NumberText(needed_s) + "s or more");
  }
  sizes.largest_trials = RoundedUp(trials, sizes.shards);
  sizes.largest_s = sizes.largest_trials * trial_s;
  return sizes;
}

std::string ShellWord(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";
  const bool plain = !word.empty() && word.find_first_not_of(kPlain) == std::string::npos;
  return plain ? word : Quoted(word, "{''");
}

Status CheckShardFolder(const std::string& out) {
  if (out.empty() || out[0] == '-' || out.find_first_of("{}\n") != std::string::npos) {
    return UsageError("--out '" + out +
                      "': give a folder whose name has no braces and no line ends and begins with "
                      "no minus; GNU parallel would read it otherwise");
  }
  return Ok();
}

std::string ParallelLines(const ShardedRun& run, const ShardSizes& sizes) {
  const std::string n = Count(sizes.shards);
  const std::string command =
      Command(run) + " --resume --shard {}/" + n + " --out " + ShardFolder(run, "{}", sizes.shards);
  return "for i in $(seq " + n + "); do\n  " + IsDone(run, sizes.shards) +
         " || echo \"$i\"\ndone | parallel --sshloginfile " + ShellWord(run.machines) +
         " --workdir . \\\n  --return " + ShardFolder(run, "{}", sizes.shards) + "/" +
         run.experiment + ".csv \\\n  " + Quoted(command, "{") + "\n";
}

std::string SlurmScript(const ShardedRun& run, const ShardSizes& sizes) {
  const std::string n = Count(sizes.shards);
  const double limit_min = std::max(kLeastLimit_min, std::ceil(kSlowest * sizes.largest_s / 60));
  const std::string name = "palace-" + run.experiment;
  std::string text = "#!/bin/sh\n#SBATCH --job-name=" + name + "\n#SBATCH --array=1-" + n +
                     "\n#SBATCH --cpus-per-task=1\n#SBATCH --time=" + NumberText(limit_min) +
                     "\n#SBATCH --requeue\n#SBATCH --output=" + name + "-%A_%a.log\n";
  if (sizes.shards > kSlurmTasks) {
    text += "# Many clusters take " + Count(kSlurmTasks) +
            " tasks an array (MaxArraySize in: scontrol show config); this has " + n + ".\n";
  }
  return text + "i=${SLURM_ARRAY_TASK_ID:?give this script to sbatch}\nif " +
         IsDone(run, sizes.shards) + "; then\n  echo \"shard $i of " + n +
         " is done\"\n  exit 0\nfi\nexec " + Command(run) + " --resume --shard \"$i\"/" + n +
         " --out " + ShardFolder(run, "\"$i\"", sizes.shards) + "\n";
}

std::string MergeLine(const ShardedRun& run, const ShardSizes& sizes) {
  return ShellWord(run.program) + " evaluate merge --out " + ShellWord(run.out) + " " +
         ShardFolder(run, "*", sizes.shards) + "/" + run.experiment + ".csv\n";
}

}  // namespace palace
