// site.json of palacectl analyze, and what it is made from.
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

/// The text of site.json. File names in it need not be UTF-8. JSON has no NaN: unknown is null.
std::string AnalyzeJson(const AnalyzeOutcome& o);

}  // namespace palace
