#include "engine/slad/sites/site_selection.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/core/text.h"
#include "engine/slad/hazards/explanation.h"
#include "engine/slad/hazards/hazard_layers.h"
#include "engine/slad/sites/site_evaluation.h"
#include "engine/slad/terrain/sense_check.h"

namespace palace {
namespace {

/// Cost averaged over 3x3 cells, so that a lone cheap cell beside dear ones does not win (4.3.3).
double SmoothedCost(const GridF& cost, Cell cell) {
  double sum = 0;
  int count = 0;
  for (int r = std::max(0, cell.row - 1); r <= std::min(cost.rows() - 1, cell.row + 1); ++r) {
    for (int c = std::max(0, cell.col - 1); c <= std::min(cost.cols() - 1, cell.col + 1); ++c) {
      const float value = cost.at(r, c);
      sum += std::isnan(value) ? 1.0 : static_cast<double>(value);
      ++count;
    }
  }
  return sum / count;
}

/// Distance of a place from the middle of the picture as a share of the picture's half diagonal;
/// without a picture, 0.
class OffCentre {
 public:
  explicit OffCentre(const SiteContext& context)
      : camera_(context.camera), X_CW_(context.X_WC.Inverse()) {}

  double At(const ElevationMap& map, Cell cell) const {
    if (camera_.width == 0) {
      return 0;
    }
    const float height = map.height_m.at(cell);
    const Eigen::Vector3d p_WS(map.geometry.NorthOfRow(cell.row), map.geometry.EastOfCol(cell.col),
                               std::isnan(height) ? 0.0 : -static_cast<double>(height));
    const Eigen::Vector3d p_CS = X_CW_ * p_WS;
    if (!(p_CS.z() > 0)) {
      return 2;
    }
    const double x = camera_.fx_px * p_CS.x() / p_CS.z() / camera_.width;
    const double y = camera_.fy_px * p_CS.y() / p_CS.z() / camera_.height;
    return std::min(2.0, std::sqrt((x * x + y * y) / 0.5));
  }

 private:
  const PinholeCamera camera_;
  const RigidTransform X_CW_;
};

/// Scores of all cells that could be a site, row by row, and the best of each row: the best that is
/// left is found without sorting, and taking one touches only the rows around it.
class Candidates {
 public:
  Candidates(const ElevationMap& map, const HazardMaps& hazards, const SladSettings& settings,
             const SiteContext& context)
      : rows_(static_cast<std::size_t>(map.geometry.rows)),
        as_good_(settings.mode == SladMode::kModern && settings.choice == SiteChoice::kFarthest
                     ? 0.75 * map.geometry.cell_m
                     : 0) {
    const OffCentre off_centre(context);
    const double cell_m = map.geometry.cell_m;
    cv::parallel_for_(cv::Range(0, map.geometry.rows), [&](const cv::Range& rows) {
      for (int r = rows.start; r < rows.end; ++r) {
        Row& row = rows_[static_cast<std::size_t>(r)];
        const float* distances_m = hazards.safe_distance_m.row(r);
        for (int c = 0; c < map.geometry.cols; ++c) {
          const Cell cell{r, c};
          if (!CanBearLander(hazards, cell)) {
            continue;
          }
          const double distance_m = static_cast<double>(distances_m[c]);
          const double cost = SmoothedCost(hazards.cost, cell);
          // Ties are broken within one cell's worth of distance, the first criterion's resolution.
          const double tie = -0.05 * off_centre.At(map, cell);
          const double score = settings.choice == SiteChoice::kFarthest
                                   ? distance_m + cell_m * (0.4 * (1 - cost) + tie)
                                   : -cost + 1e-3 * (distance_m + tie);
          if (score > kNone) {
            row.left.push_back({c, false, score});
          }
        }
        FindBest(row);
      }
    });
  }

  /// The best `most` cells that keep the spacing from each other and from those taken before, best
  /// first; fewer when no more are left.
  std::vector<Cell> Take(std::size_t most, double spacing_cells) {
    std::vector<Cell> taken;
    while (taken.size() < most) {
      const std::optional<Cell> cell = Best();
      if (!cell) {
        break;
      }
      const Cell middle = MiddleOfEquals(*cell);
      DropAround(middle, spacing_cells);
      taken.push_back(middle);
    }
    return taken;
  }

 private:
  static constexpr double kNone = -HUGE_VAL;

  struct Candidate {
    int col = -1;
    bool counted = false;  ///< by MiddleOfEquals
    double score = kNone;
  };
  struct Row {
    std::vector<Candidate> left;  ///< from west to east
    Candidate best;
  };

  /// The best cell left, of equals the northernmost, then westernmost; nothing when none is left.
  std::optional<Cell> Best() const {
    std::optional<Cell> cell;
    double score = kNone;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const Candidate& best = rows_[r].best;
      if (best.score > score) {
        cell = Cell{static_cast<int>(r), best.col};
        score = best.score;
      }
    }
    return cell;
  }

  Candidate* Find(Cell cell) {
    if (cell.row < 0 || cell.row >= static_cast<int>(rows_.size())) {
      return nullptr;
    }
    std::vector<Candidate>& left = rows_[static_cast<std::size_t>(cell.row)].left;
    const auto at = std::lower_bound(left.begin(), left.end(), cell.col,
                                     [](const Candidate& a, int col) { return a.col < col; });
    return at != left.end() && at->col == cell.col ? &*at : nullptr;
  }

  /// Along a ridge of safe distance it is chance, of a centimetre, which cell is the best: taken is
  /// the cell nearest to the middle of all that touch it and are as good.
  Cell MiddleOfEquals(Cell best) {
    if (as_good_ == 0) {
      return best;
    }
    const double least = Find(best)->score - as_good_;
    std::vector<Cell> equals{best};
    Find(best)->counted = true;
    std::int64_t row_sum = 0, col_sum = 0;
    for (std::size_t next = 0; next < equals.size(); ++next) {
      const Cell cell = equals[next];
      row_sum += cell.row;
      col_sum += cell.col;
      for (int k = 0; k < 9; ++k) {
        const Cell near{cell.row + k / 3 - 1, cell.col + k % 3 - 1};
        Candidate* candidate = Find(near);
        if (candidate != nullptr && !candidate->counted && candidate->score >= least) {
          candidate->counted = true;
          equals.push_back(near);
        }
      }
    }
    const auto n = static_cast<std::int64_t>(equals.size());
    const auto off2 = [&](Cell cell) {  // whole numbers, so that a turned map has the same ties
      const auto dr = static_cast<double>(n * cell.row - row_sum);
      const auto dc = static_cast<double>(n * cell.col - col_sum);
      return dr * dr + dc * dc;
    };
    Cell middle = best;
    for (const Cell& cell : equals) {
      Candidate& candidate = *Find(cell);
      candidate.counted = false;
      const double nearer = off2(middle) - off2(cell);
      if (nearer > 0 || (nearer == 0 && candidate.score > Find(middle)->score)) {
        middle = cell;
      }
    }
    return middle;
  }

  /// Drops the cell and all nearer to it than the spacing.
  void DropAround(Cell cell, double spacing_cells) {
    const int reach = static_cast<int>(std::min(spacing_cells, 1e6)) + 1;
    const double square = spacing_cells * spacing_cells;
    const int last = std::min(static_cast<int>(rows_.size()) - 1, cell.row + reach);
    for (int r = std::max(0, cell.row - reach); r <= last; ++r) {
      Row& row = rows_[static_cast<std::size_t>(r)];
      std::erase_if(row.left, [&](const Candidate& near) {
        const double dr = r - cell.row, dc = near.col - cell.col;
        return dr * dr + dc * dc < square || Cell{r, near.col} == cell;
      });
      FindBest(row);
    }
  }

  static void FindBest(Row& row) {
    row.best = {};
    for (const Candidate& candidate : row.left) {
      if (candidate.score > row.best.score) {
        row.best = candidate;
      }
    }
  }

  std::vector<Row> rows_;
  const double as_good_;  ///< scores that differ by less are equal; metres
};

std::string NoneReason(const HazardMaps& hazards, const SladSettings& settings) {
  const RejectedCells& n = hazards.rejected;
  struct Part {
    int count;
    const char* name;
  };
  std::vector<Part> parts{{n.slope, "slope"},
                          {n.roughness, "roughness"},
                          {n.unknown, "unknown"},
                          {n.flagged, "flagged"},
                          {n.footprint, "footprint"}};
  const int total =
      n.slope + n.roughness + n.unknown + n.flagged + n.footprint + hazards.safe_cells;
  if (total == 0) {
    return "empty map";
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return a.count > b.count; });
  std::string text;
  for (const Part& part : parts) {
    if (part.count > 0) {
      text += (text.empty() ? "" : ", ") + WithNumbers("%.0f", 100.0 * part.count / total) + " % " +
              part.name;
    }
  }
  const GridGeometry& g = hazards.geometry;
  // The best middle of an even number of cells is half a cell off.
  const double across_m = (std::min(g.rows, g.cols) - 1) / 2 * 2 * g.cell_m + g.cell_m;
  if (n.footprint > 0 && across_m < 2 * settings.clear_radius_m()) {
    text += WithNumbers("; the map holds a disc %.3f m across, the lander's clear one is %.3f m",
                        across_m, 2 * settings.clear_radius_m());
  }
  return text;
}

std::vector<LandingSite> EvaluateSites(const ElevationMap& map, const HazardMaps& hazards,
                                       const SladSettings& settings, const SiteContext& context,
                                       const std::vector<Cell>& cells) {
  std::vector<LandingSite> sites(cells.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(cells.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      const std::size_t k = static_cast<std::size_t>(i);
      sites[k] = EvaluateSite(map, hazards, settings, context, cells[k]);
    }
  });
  return sites;
}

}  // namespace

SiteSelection SelectSites(const ElevationMap& map, const HazardMaps& hazards,
                          const SladSettings& settings, const SiteContext& context) {
  PALACE_CHECK(map.geometry == hazards.geometry);
  SiteSelection selection;
  selection.none_reason = ObjectionTo(map, settings);
  if (!selection.none_reason.empty()) {
    return selection;
  }
  std::vector<LandingSite> blocked, closed;  // straight on; from everywhere
  const double spacing_cells = settings.site_spacing_m / std::max(map.geometry.cell_m, 1e-9);
  const auto kept = static_cast<std::size_t>(settings.sites_kept);
  Candidates candidates(map, hazards, settings, context);
  // How a site turns out does not change which cells come next: as many as are still wanted are
  // looked at side by side.
  std::size_t tried = 0;
  while (selection.sites.size() < kept && tried < 3 * kept) {
    const std::vector<Cell> cells =
        candidates.Take(std::min(kept - selection.sites.size(), 3 * kept - tried), spacing_cells);
    if (cells.empty()) {
      break;
    }
    tried += cells.size();
    for (LandingSite& site : EvaluateSites(map, hazards, settings, context, cells)) {
      if (IsSound(site)) {
        (site.corridor_clear          ? selection.sites
         : site.clear_approaches != 0 ? blocked
                                      : closed)
            .push_back(std::move(site));
      }
    }
  }
  for (std::vector<LandingSite>* later : {&blocked, &closed}) {
    for (LandingSite& site : *later) {
      if (selection.sites.size() < kept) {
        selection.sites.push_back(std::move(site));
      }
    }
  }
  GiveReasons(settings.choice, selection);
  if (selection.sites.empty()) {
    selection.none_reason = NoneReason(hazards, settings);
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
