// The table of `evaluate site-range` read: shares by altitude, beside the thesis's own.
#pragma once

#include <string>
#include <vector>

#include "engine/experiments/experiment.h"

namespace palace {

inline constexpr const char* kFused = "fused frames";
inline constexpr const char* kOneFrame = "one frame";
inline constexpr const char* kThesisMode = "thesis mode";
inline constexpr const char* kRightSite = "right";
inline constexpr const char* kWrongSite = "wrong";
inline constexpr const char* kNoSite = "none";
inline constexpr const char* kConfirmed = "confirmed";
inline constexpr const char* kProvisional = "provisional";

std::vector<std::string> SiteRangeColumns();
ExperimentReport ReportSiteRange(const TrialTable& table);

}  // namespace palace
