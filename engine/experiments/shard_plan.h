// How an experiment is spread over machines: how many shards, and the texts that GNU parallel,
// Slurm and a person run. Nothing here runs anything.
//
// What is done is told by the CSVs alone: one that begins with the header of this very run is a
// whole shard, for it is renamed into its place when it is written. So the same text may be run
// again after a kill and does what is missing; of a shard that was killed the trials done are kept
// where it ran (trial_record.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace palace {

/// Seconds of "90s", "10min" or "1.5h": 1 s to 720 h. Anything else is a usage error that names
/// `option`; a number without a unit too.
Result<double> ParseDuration(const std::string& text, const std::string& option);
/// "45.0 s", "9.7 min", "3.2 h".
std::string DurationText(double seconds);

struct ShardSizes {
  int shards = 1;
  int largest_trials = 1;  ///< of a shard; others may have one less
  double largest_s = 0;    ///< for those
};
/// As few shards as keep each within `job_s` seconds when a trial takes `trial_s`. A trial longer
/// than that is a shard of its own. Refuses more than 10,000 shards, naming the job that would do.
/// Trials and times are above 0.
Result<ShardSizes> SizeShards(int trials, double trial_s, double job_s);

/// One word for /bin/sh, quoted where it must be. Text between braces is broken up, so that GNU
/// parallel, which replaces such text inside quotes too, finds none.
std::string ShellWord(const std::string& word);

/// A run that is to be spread.
struct ShardedRun {
  std::string program = "palacectl";
  std::string experiment;
  std::vector<std::string> options{};  ///< of the experiment, without --trials, --seed and --out
  std::string setup = "defaults";      ///< as it stands in the CSV's first line
  std::uint64_t seed = 1;
  int trials = 1;
  std::string out;                        ///< shard i of n: OUT/shard-i-of-n
  std::string machines = "machines.txt";  ///< GNU parallel's --sshloginfile
};

/// Refuses a folder that GNU parallel or a shell would take for something else.
Status CheckShardFolder(const std::string& out);

/// Lines for /bin/sh: GNU parallel over ssh, a job a core; a CSV that another machine wrote is
/// fetched.
std::string ParallelLines(const ShardedRun& run, const ShardSizes& sizes);
/// A job array, one core a task, to be given to sbatch. Its time limit is three times the largest
/// shard's time, 10 min at least: trials and machines differ.
std::string SlurmScript(const ShardedRun& run, const ShardSizes& sizes);
/// One line for /bin/sh that joins the shards in OUT.
std::string MergeLine(const ShardedRun& run, const ShardSizes& sizes);

}  // namespace palace
