#include "engine/slad/site_selection.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/slad/hazard_layers.h"
#include "engine/slad/site_evaluation.h"

namespace palace {
namespace {

struct Candidate {
  Cell cell;
  double score = 0;
};

std::string Text(const char* format, double value) {
  char text[80];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Cost averaged over 3x3 cells, so that a lone cheap cell beside dear ones does not win (4.3.3).
double SmoothedCost(const GridF& cost, Cell cell) {
  double sum = 0;
  int count = 0;
  for (int k = 0; k < 9; ++k) {
    const int r = cell.row + k / 3 - 1, c = cell.col + k % 3 - 1;
    if (r >= 0 && c >= 0 && r < cost.rows() && c < cost.cols()) {
      const float value = cost.at(r, c);
      sum += std::isnan(value) ? 1.0 : static_cast<double>(value);
      ++count;
    }
  }
  return sum / count;
}

/// Distance of the place from the middle of the picture as a share of the picture's half diagonal;
/// without a picture, 0.
double OffCentre(const ElevationMap& map, const SiteContext& context, Cell cell) {
  if (context.camera.width == 0) {
    return 0;
  }
  const float height = map.height_m.at(cell);
  const Eigen::Vector3d p_WS(map.geometry.NorthOfRow(cell.row), map.geometry.EastOfCol(cell.col),
                             std::isnan(height) ? 0.0 : -static_cast<double>(height));
  const Eigen::Vector3d p_CS = context.X_WC.Inverse() * p_WS;
  if (!(p_CS.z() > 0)) {
    return 2;
  }
  const double x = context.camera.fx_px * p_CS.x() / p_CS.z() / context.camera.width;
  const double y = context.camera.fy_px * p_CS.y() / p_CS.z() / context.camera.height;
  return std::min(2.0, std::hypot(x, y) / std::sqrt(0.5));
}

std::vector<Candidate> RankedCandidates(const ElevationMap& map, const HazardMaps& hazards,
                                        const SladSettings& settings, const SiteContext& context) {
  std::vector<Candidate> candidates;
  const float clear_m = static_cast<float>(settings.clear_radius_m());
  const double cell_m = map.geometry.cell_m;
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      const Cell cell{r, c};
      if (hazards.safe_distance_m.at(cell) < clear_m || !FootprintHolds(hazards, settings, cell)) {
        continue;
      }
      const double distance_m = static_cast<double>(hazards.safe_distance_m.at(cell));
      const double cost = SmoothedCost(hazards.cost, cell);
      // Ties are broken within one cell's worth of distance, the first criterion's resolution.
      const double tie = -0.05 * OffCentre(map, context, cell);
      const double score = settings.choice == SiteChoice::kFarthest
                               ? distance_m + cell_m * (0.4 * (1 - cost) + tie)
                               : -cost + 1e-3 * (distance_m + tie);
      candidates.push_back({cell, score});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.score != b.score         ? a.score > b.score
           : a.cell.row != b.cell.row ? a.cell.row < b.cell.row
                                      : a.cell.col < b.cell.col;
  });
  return candidates;
}

/// Why this site has its rank, against the best.
std::string ReasonFor(const LandingSite& site, const LandingSite& best, bool is_best,
                      SiteChoice choice) {
  if (is_best) {
    return choice == SiteChoice::kFarthest ? "Widest clear radius" : "Least cost";
  }
  if (!site.corridor_clear && best.corridor_clear) {
    return "Approach corridor blocked";
  }
  if (choice == SiteChoice::kCost) {
    return Text("Cost %.2f above the best", site.cost - best.cost);
  }
  const double less_m = best.safe_distance_m - site.safe_distance_m;
  return less_m >= 0.05 ? Text("%.1f m less clear than the best", less_m)
                        : "As clear, higher cost or farther from the middle";
}

std::string NoneReason(const HazardMaps& hazards) {
  const RejectedCells& n = hazards.rejected;
  struct Part {
    int count;
    const char* name;
  };
  std::vector<Part> parts{{n.slope, "slope"},
                          {n.roughness, "roughness"},
                          {n.unknown, "unknown"},
                          {n.footprint, "footprint"}};
  const int total = n.slope + n.roughness + n.unknown + n.footprint + hazards.safe_cells;
  if (total == 0) {
    return "empty map";
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return a.count > b.count; });
  std::string text;
  for (const Part& part : parts) {
    if (part.count > 0) {
      text +=
          (text.empty() ? "" : ", ") + Text("%.0f", 100.0 * part.count / total) + " % " + part.name;
    }
  }
  return text;
}

}  // namespace

SiteSelection SelectSites(const ElevationMap& map, const HazardMaps& hazards,
                          const SladSettings& settings, const SiteContext& context) {
  PALACE_CHECK(map.geometry == hazards.geometry);
  SiteSelection selection;
  std::vector<LandingSite> blocked;
  std::vector<Cell> taken;
  const double spacing_cells = settings.site_spacing_m / std::max(map.geometry.cell_m, 1e-9);
  const auto far_from_taken = [&](Cell cell) {
    return std::all_of(taken.begin(), taken.end(), [&](Cell other) {
      return std::hypot(cell.row - other.row, cell.col - other.col) >= spacing_cells;
    });
  };
  const auto kept = static_cast<std::size_t>(settings.sites_kept);
  for (const Candidate& candidate : RankedCandidates(map, hazards, settings, context)) {
    if (selection.sites.size() >= kept || taken.size() >= 3 * kept) {
      break;
    }
    if (!far_from_taken(candidate.cell)) {
      continue;
    }
    taken.push_back(candidate.cell);
    LandingSite site = EvaluateSite(map, hazards, settings, context, candidate.cell);
    (site.corridor_clear ? selection.sites : blocked).push_back(std::move(site));
  }
  for (LandingSite& site : blocked) {
    if (selection.sites.size() < kept) {
      selection.sites.push_back(std::move(site));
    }
  }
  for (std::size_t i = 0; i < selection.sites.size(); ++i) {
    selection.sites[i].reason =
        ReasonFor(selection.sites[i], selection.sites.front(), i == 0, settings.choice);
  }
  if (selection.sites.empty()) {
    selection.none_reason = NoneReason(hazards);
  }
  return selection;
}

std::optional<LandingSite> RecheckSite(const ElevationMap& map, const HazardMaps& hazards,
                                       const SladSettings& settings, const LandingSite& site,
                                       const SiteContext& context) {
  PALACE_CHECK(map.geometry == hazards.geometry);
  const auto cell = map.geometry.CellFromPoint(site.p_WS.x(), site.p_WS.y());
  if (map.height_m.empty() || !cell) {
    return std::nullopt;
  }
  LandingSite now = EvaluateSite(map, hazards, settings, context, *cell);
  now.id = site.id;
  now.letter = site.letter;
  now.reason = site.reason;
  // The place itself stays; only its height may be known better.
  now.p_WS.head<2>() = site.p_WS.head<2>();
  if (std::isnan(now.p_WS.z())) {
    now.p_WS.z() = site.p_WS.z();
  }
  return now;
}

}  // namespace palace
