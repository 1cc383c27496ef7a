// report.html of palacectl analyze: where to land, why, and the maps, in one file to pass on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/model/settings/settings.h"
#include "engine/model/terrain_decision.h"
#include "engine/tools/analyze_inputs.h"

namespace palace {

/// The page with every picture inside it. `folder` holds the pictures analyze wrote: overlay.png
/// (with a pair), safe_landing.png and those of the layers; one that is missing is left out.
/// `files`: what the input was read from.
std::string AnalyzeReport(const std::vector<std::string>& files, const AnalyzeInput& input,
                          const Settings& settings, const TerrainDecision& decision,
                          const std::filesystem::path& folder);

}  // namespace palace
