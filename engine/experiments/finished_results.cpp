#include "engine/experiments/finished_results.h"

#include <system_error>

#include "engine/core/files.h"

namespace palace {
namespace {

constexpr std::size_t kLargestTable = std::size_t{1} << 30;
constexpr const char* kRemedy = "; choose another --out, or add --overwrite to replace it";

}  // namespace

Result<std::optional<TrialFile>> FinishedResults(const std::filesystem::path& csv,
                                                 const std::vector<std::string>& columns) {
  std::error_code error;
  if (!std::filesystem::exists(csv, error)) {
    return std::optional<TrialFile>();
  }
  const Result<std::string> text = ReadTextFile(csv, kLargestTable);
  if (!text) {
    return text.error();
  }
  Result<TrialFile> file = ParseTrialFile(*text, csv.string());
  if (!file) {
    return UsageError(file.error().message + kRemedy);
  }
  if (file->table.columns != columns) {
    return UsageError(csv.string() + " holds " + WhatIsHeld(file->header) +
                      " in the columns of another version" + kRemedy);
  }
  return std::optional<TrialFile>(*std::move(file));
}

bool IsSameRun(const TrialHeader& a, const TrialHeader& b) {
  return a.experiment == b.experiment && a.setup == b.setup && a.seed == b.seed &&
         a.trials == b.trials && a.shard == b.shard;
}

bool IsKept(const TrialHeader& held, const TrialHeader& run, const TrialRecord& record) {
  TrialHeader as_long = run;
  as_long.trials = held.trials;
  if (!IsSameRun(held, as_long)) {
    return false;
  }
  for (int trial = 0; trial < held.trials; ++trial) {
    if (held.shard.Holds(trial) && record.Done(trial) == nullptr) {
      return false;
    }
  }
  return true;
}

std::string WhatIsHeld(const TrialHeader& held) {
  const std::string shard = held.shard.whole() ? ""
                                               : ", shard " + std::to_string(held.shard.index) +
                                                     "/" + std::to_string(held.shard.count);
  return std::to_string(held.trials) + (held.trials == 1 ? " trial" : " trials") + " of seed " +
         std::to_string(held.seed) + shard + " (" + held.setup + ")";
}

Error WouldReplace(const std::filesystem::path& csv, const TrialHeader& held) {
  return UsageError(csv.string() + " holds " + WhatIsHeld(held) + " already" + kRemedy);
}

}  // namespace palace
