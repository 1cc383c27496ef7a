// What palacectl analyze leaves in its folder: maps, pictures, report.html and site.json.
#pragma once

#include <filesystem>

#include "engine/core/result.h"
#include "engine/tools/analyze_outcome.h"

namespace palace {

/// Writes beside the target first and moves the finished files, so that a failure leaves nothing
/// half written.
Status PublishAnalysis(const AnalyzeOutcome& o, const std::filesystem::path& out);

}  // namespace palace
