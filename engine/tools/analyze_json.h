// site.json of palacectl analyze.
#pragma once

#include <string>

#include "engine/tools/analyze_outcome.h"

namespace palace {

/// The text of site.json. File names in it need not be UTF-8. JSON has no NaN: unknown is null.
std::string AnalyzeJson(const AnalyzeOutcome& o);

}  // namespace palace
