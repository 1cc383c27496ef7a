// The figures of the thesis beside ours: one page of results that were made before
// (thesis_figures.h), with its maps drawn anew (thesis_pictures.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/experiments/experiment.h"

namespace palace {

/// Writes thesis.html and its pictures into `out`, which is made. `results` are folders or CSVs
/// that the experiments wrote, one each; what has none is told with the command that makes it.
/// Errors: those of ReadTrials; a shard, or one experiment twice (kUsage).
Status WriteThesisPage(const std::vector<Experiment>& experiments,
                       const std::vector<std::string>& results, const std::filesystem::path& out,
                       std::uint64_t seed);

}  // namespace palace
