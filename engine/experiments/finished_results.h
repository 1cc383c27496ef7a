// Results that a folder holds already. Hours of trials are not replaced by a run with other options
// because it was given the same --out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/experiments/trial_record.h"
#include "engine/report/trial_table.h"

namespace palace {

/// The table at `csv`; nothing where there is none. Errors, with the remedy: what is there is no
/// whole table of these columns.
Result<std::optional<TrialFile>> FinishedResults(const std::filesystem::path& csv,
                                                 const std::vector<std::string>& columns);

/// Experiment, seed, trials, shard and setup are the same. A table does not tell of what program it
/// is, nor what the files held that the options name.
bool IsSameRun(const TrialHeader& a, const TrialHeader& b);

/// Every trial of `held` is kept in the record of `run` too, so that a longer or shorter table of
/// that run loses none.
bool IsKept(const TrialHeader& held, const TrialHeader& run, const TrialRecord& record);

/// "200 trials of seed 1 (defaults)", with the shard where it is one.
std::string WhatIsHeld(const TrialHeader& held);
/// Why `csv` is not replaced, and what to do.
Error WouldReplace(const std::filesystem::path& csv, const TrialHeader& held);

}  // namespace palace
