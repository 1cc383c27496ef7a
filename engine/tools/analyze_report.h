// report.html of palacectl analyze: where to land, why, and the maps, in one file to pass on.
#pragma once

#include <filesystem>
#include <string>

#include "engine/tools/analyze_outcome.h"

namespace palace {

/// The page with every picture inside it. `folder` holds the pictures analyze wrote: overlay.png
/// (with a pair), safe_landing.png and those of the layers; one that is missing is left out.
std::string AnalyzeReport(const AnalyzeOutcome& o, const std::filesystem::path& folder);

}  // namespace palace
