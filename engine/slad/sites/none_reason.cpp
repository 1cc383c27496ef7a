#include "engine/slad/sites/none_reason.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/text.h"
#include "engine/model/cell_explanation.h"
#include "engine/slad/hazards/hazard_maps.h"

namespace palace {
namespace {

/// "flagged" and what for, as most of those cells are: "flagged (no texture)".
std::string FlaggedWords(const HazardMaps& hazards, const HazardLimits& limits) {
  const unsigned forbidden = ForbiddenFlags(limits);
  unsigned most = kFlagNone;
  int cells = 0;
  for (unsigned flag = 1; flag <= forbidden; flag <<= 1U) {
    int count = 0;  // a faint mark is flagged and refuses nothing
    for (std::size_t i = 0; i < hazards.flags.cells().size(); ++i) {
      const bool refused = (hazards.reasons.cells()[i] & kHazardFlagged) != 0;
      count += refused && (hazards.flags.cells()[i] & flag & forbidden) != 0 ? 1 : 0;
    }
    if (count > cells) {
      cells = count;
      most = flag;
    }
  }
  return cells > 0 ? "flagged (" + FlagWords(most) + ")" : "flagged";
}

}  // namespace

std::string NoneReason(const ElevationMap& map, const HazardMaps& hazards,
                       const SladSettings& settings) {
  const RejectedCells& n = hazards.rejected;
  struct Part {
    int count;
    std::string name;
  };
  std::vector<Part> parts{
      {n.slope, "slope"},
      {n.roughness, "roughness"},
      {n.unknown, "unknown"},
      {n.flagged, FlaggedWords(hazards, settings.limits)},
      {n.doubtful, "not sure enough"},
      {hazards.counts[GroundClass::kTooNear], "too near a hazard"},
      {hazards.counts[GroundClass::kFootprint], "over a limit under the lander"}};
  const int total =
      n.slope + n.roughness + n.unknown + n.flagged + n.doubtful + n.footprint + hazards.safe_cells;
  if (total == 0) {
    return "empty map";
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return a.count > b.count; });
  std::string text;
  for (const Part& part : parts) {
    if (part.count > 0) {
      // However few, they may be what the others are too near to.
      const double percent = std::round(100.0 * part.count / total);
      text += (text.empty() ? "" : ", ") +
              (percent > 0 ? WithNumbers("%.0f %% ", percent) : "under 1 % ") + part.name;
    }
  }
  const GridGeometry& g = hazards.geometry;
  // The best middle of an even number of cells is half a cell off.
  const double across_m = (std::min(g.rows, g.cols) - 1) / 2 * 2 * g.cell_m + g.cell_m;
  if (n.footprint > 0 && across_m < 2 * settings.lander.clear_radius_m()) {
    text += WithNumbers("; the map holds a disc %.3f m across, the lander's clear one is %.3f m",
                        across_m, 2 * settings.lander.clear_radius_m());
  }
  const std::vector<float>& tops_m = map.thin_top_m.cells();
  if (n.flagged > 0 &&
      std::any_of(tops_m.begin(), tops_m.end(), [](float m) { return std::isinf(m); })) {
    text +=
        "; lines along the cameras' baseline may be wires or paint: from a little aside or from "
        "another heading it shows";
  }
  return text;
}

}  // namespace palace
