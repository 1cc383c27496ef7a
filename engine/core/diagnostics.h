// Diagnostics: what went partly wrong in a stage, carried in the snapshot instead of a log line.
#pragma once

#include <string>
#include <vector>

namespace palace {

enum class DiagnosticLevel { kInfo, kWarning, kError };

struct Diagnostic {
  DiagnosticLevel level = DiagnosticLevel::kInfo;
  std::string stage;    ///< the noun of the stage, e.g. "stereo"
  std::string message;  ///< one sentence with its number and unit
};

using Diagnostics = std::vector<Diagnostic>;

}  // namespace palace
