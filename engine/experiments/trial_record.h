// The trials of a run, kept as each is done, so that a run that was killed goes on where it ended.
//
// A text file beside the CSV: a line that tells the run, then of each trial its rows and the line
// "# trial N done SUM", with a check sum of these rows: an edited one is refused. What stands after
// the last such line was cut off and is not taken. While a program writes a record no other may.
// The run is told with experiment, seed, shard and setup, and with hashes of the program and of the
// files that its options name: the trials of another build or of an edited file are never mixed in.
// The number of trials is not told, so a run that was ended may also be taken further: trial i is
// the same in both.
//
// One thread.
#pragma once

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/report/trial_table.h"

namespace palace {

class TrialRecord {
 public:
  using Rows = std::vector<std::vector<std::string>>;  ///< without trial and seed

  /// What is recorded: `inputs` names what the files hold that its options name.
  struct Run {
    TrialHeader header;
    std::vector<std::string> columns{};  ///< without trial and seed
    std::string inputs{};
  };

  /// The record of a run at `path`; with `resume` what a run of the same kind left there is taken
  /// first. Errors: the file cannot be written; another program writes it, it is of another run, or
  /// it holds trials and `resume` is not given, for they would be lost (kUsage); a line of it is
  /// none of a record, or the rows of a trial are not those that it wrote (file and line).
  static Result<TrialRecord> Open(const std::filesystem::path& path, const Run& run, bool resume);

  /// The rows of a trial that is done; null when it is not.
  const Rows* Done(int trial) const;
  int done_count() const { return static_cast<int>(done_.size()); }
  /// Keeps a trial; on disk as far as the system goes when it returns.
  Status Add(int trial, Rows rows);
  /// The results of `trials` trials are written. The record goes, unless it holds others.
  void Finish(int trials);

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  TrialRecord() = default;
  Status Read(const std::string& head, std::size_t columns, bool resume);

  std::filesystem::path path_;
  std::map<int, Rows> done_;
  std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace palace
