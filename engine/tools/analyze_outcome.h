// What analyze found, for all that is written of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/cell_explanation.h"
#include "engine/model/terrain_decision.h"
#include "engine/tools/analyze_inputs.h"

namespace palace {

struct AnalyzeOutcome {
  std::vector<std::string> files;  ///< as given on the command line
  std::string settings_file;       ///< the same; empty without
  AnalyzeInput input;
  Settings settings;
  std::shared_ptr<const TerrainDecision> decision{};
  std::vector<CellExplanation> explained{};

  const ElevationMap& map() const { return *decision->elevation; }
  const HazardMaps& hazards() const { return *decision->hazards; }
  const SiteSelection& selection() const { return decision->selection; }
};

}  // namespace palace
