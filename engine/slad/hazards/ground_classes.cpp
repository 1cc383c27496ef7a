#include "engine/slad/hazards/ground_classes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/core/units.h"
#include "engine/model/cell_explanation.h"
#include "engine/slad/hazards/safe_distance.h"

namespace palace {
namespace {

/// How a cell with these reasons is counted.
enum CountedAs {
  kAsSlope,
  kAsRoughness,
  kAsUnknown,
  kAsFlagged,
  kAsDoubtful,
  kAsFootprint,
  kAsSafe,
  kCountings
};
constexpr CountedAs CountingOf(unsigned reasons) {
  return (reasons & kHazardSlope) != 0                       ? kAsSlope
         : (reasons & (kHazardRoughness | kHazardStep)) != 0 ? kAsRoughness
         : (reasons & kHazardUnknown) != 0                   ? kAsUnknown
         : (reasons & kHazardFlagged) != 0                   ? kAsFlagged
         : (reasons & kHazardProbability) != 0               ? kAsDoubtful
                                                             : kAsSafe;
}

constexpr unsigned kAllReasons = 63;
/// By reasons, but for none: there the room decides.
constexpr std::array<GroundClass, kAllReasons + 1> kClassOf = [] {
  std::array<GroundClass, kAllReasons + 1> classes{};
  for (unsigned reasons = 0; reasons <= kAllReasons; ++reasons) {
    classes[reasons] =
        CountingOf(reasons) == kAsUnknown ? GroundClass::kUnknown : GroundClass::kHazard;
  }
  return classes;
}();

/// Whether a touchdown on a cell without reasons keeps the limits of its mode, with so many things
/// expected unseen around it.
bool KeepsLimits(const HazardMaps& hazards, const SladSettings& settings, Cell cell,
                 double hidden) {
  if (settings.mode == SladMode::kThesis) {
    return true;
  }
  // The layer holds what hides around the touchdown itself.
  const double own = HiddenThingsAt(hazards, cell);
  const double probability = static_cast<double>(hazards.safe_probability.at(cell)) *
                             (hidden == own ? 1 : std::exp(own - hidden));
  return hazards.slope_rad.at(cell) <= static_cast<float>(Rad(settings.limits.max_slope_deg)) &&
         hazards.roughness_m.at(cell) <= static_cast<float>(settings.limits.max_deviation_m) &&
         hazards.step_m.at(cell) <= static_cast<float>(settings.limits.max_step_m) &&
         probability >=
             RequiredSafeProbability(
                 settings, static_cast<double>(hazards.roughness_sigma_m.at(cell)), hidden);
}

/// Whether a touchdown on a cell without reasons breaks a limit, whatever hides.
bool Breaks(const HazardMaps& hazards, const SladSettings& settings, Cell cell) {
  return !KeepsLimits(hazards, settings, cell, HiddenThingsAt(hazards, cell)) &&
         !KeepsLimits(hazards, settings, cell, 0);
}

/// The touchdowns of a lander sent to a cell.
class Touchdowns {
 public:
  Touchdowns(const SladSettings& settings, const GridGeometry& geometry)
      : radius2_cells_(std::pow(settings.lander.nav_error_m / geometry.cell_m, 2)) {}
  /// Of two cells whose middles lie that far apart, squared.
  bool Reach(double square_cells) const { return square_cells <= radius2_cells_ * (1 + 1e-9); }
  /// Rows and columns beyond which no touchdown of the map lies.
  int reach(const GridGeometry& geometry) const {
    return static_cast<int>(
        std::min(std::sqrt(radius2_cells_) + 1, std::max(geometry.rows, geometry.cols) + 1.0));
  }

 private:
  double radius2_cells_;
};

/// Where only a touchdown beside the cell breaks a limit. `breaking`: 1 where one does; the ring
/// around the map, which counts too, is farther from every place with room.
void ClassifyBeside(const SladSettings& settings, const Grid<std::uint8_t>& breaking,
                    HazardMaps& hazards) {
  const double cell_m = hazards.geometry.cell_m;
  const Touchdowns touchdowns(settings, hazards.geometry);
  const GridF away_m = SafeDistance(breaking, cell_m);
  for (std::size_t k = 0; k < hazards.ground.cells().size(); ++k) {
    GroundClass& ground = hazards.ground.cells()[k];
    const double away_cells = static_cast<double>(away_m.cells()[k]) / cell_m;
    if (ground == GroundClass::kLandable && touchdowns.Reach(std::round(away_cells * away_cells))) {
      ground = GroundClass::kFootprint;
    }
  }
}

}  // namespace

void ClassifyCells(const SladSettings& settings, HazardMaps& hazards) {
  const int rows = hazards.geometry.rows, cols = hazards.geometry.cols;
  const float clear_m = static_cast<float>(settings.lander.clear_radius_m());
  // Nothing with a reason lies within the navigation error of a place with room.
  const float touched_m =
      clear_m - static_cast<float>(settings.lander.nav_error_m + hazards.geometry.cell_m);
  hazards.ground = Grid<GroundClass>(rows, cols);
  Grid<std::uint8_t> breaking(rows, cols, 0);
  std::vector<std::uint8_t> any_breaking(static_cast<std::size_t>(rows), 0);
  std::vector<std::array<int, kAllReasons + 1>> with(static_cast<std::size_t>(rows));
  cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
    for (int r = range.start; r < range.end; ++r) {
      const std::uint8_t* reasons = hazards.reasons.row(r);
      const float* distance_m = hazards.safe_distance_m.row(r);
      GroundClass* ground = hazards.ground.row(r);
      for (int c = 0; c < cols; ++c) {
        const Cell cell{r, c};
        ++with[static_cast<std::size_t>(r)][reasons[c] & kAllReasons];
        if (reasons[c] != kHazardNone) {
          ground[c] = kClassOf[reasons[c] & kAllReasons];
          continue;
        }
        ground[c] = GroundClass::kTooNear;
        if (!(distance_m[c] >= touched_m) && !(distance_m[c] >= clear_m)) {
          continue;
        }
        const double hidden = HiddenThingsAt(hazards, cell);
        const bool keeps = KeepsLimits(hazards, settings, cell, hidden);
        if (distance_m[c] >= clear_m) {
          ground[c] = keeps ? GroundClass::kLandable : GroundClass::kFootprint;
        }
        if (distance_m[c] >= touched_m && !keeps &&
            (hidden == 0 || !KeepsLimits(hazards, settings, cell, 0))) {
          breaking.at(cell) = any_breaking[static_cast<std::size_t>(r)] = 1;
        }
      }
    }
  });
  if (std::count(any_breaking.begin(), any_breaking.end(), 1) > 0) {
    ClassifyBeside(settings, breaking, hazards);
  }
  std::array<int, kCountings> count{};
  for (const auto& row : with) {
    for (unsigned reasons = 0; reasons <= kAllReasons; ++reasons) {
      count[CountingOf(reasons)] += row[reasons];
    }
  }
  for (const GroundClass ground : {GroundClass::kTooNear, GroundClass::kFootprint}) {
    const std::vector<GroundClass>& cells = hazards.ground.cells();
    const int n = static_cast<int>(std::count(cells.begin(), cells.end(), ground));
    hazards.counts[ground] = n;
    count[kAsSafe] -= n;
    count[kAsFootprint] += n;
  }
  hazards.rejected = {count[kAsSlope],   count[kAsRoughness], count[kAsUnknown],
                      count[kAsFlagged], count[kAsDoubtful],  count[kAsFootprint]};
  hazards.counts[GroundClass::kUnknown] = count[kAsUnknown];
  hazards.counts[GroundClass::kHazard] =
      count[kAsSlope] + count[kAsRoughness] + count[kAsFlagged] + count[kAsDoubtful];
  hazards.counts[GroundClass::kLandable] = hazards.safe_cells = count[kAsSafe];
}

Cell WorstTouchdown(const HazardMaps& hazards, const SladSettings& settings, Cell cell) {
  if (hazards.ground.at(cell) != GroundClass::kFootprint ||
      !KeepsLimits(hazards, settings, cell, HiddenThingsAt(hazards, cell))) {
    return cell;
  }
  const Touchdowns touchdowns(settings, hazards.geometry);
  const int reach = touchdowns.reach(hazards.geometry);
  Cell worst = cell;
  int nearest = std::numeric_limits<int>::max();
  for (int dr = -reach; dr <= reach; ++dr) {
    for (int dc = -reach; dc <= reach; ++dc) {
      const Cell near{cell.row + dr, cell.col + dc};
      const int square = dr * dr + dc * dc;
      if (square < nearest && touchdowns.Reach(square) && hazards.geometry.Contains(near) &&
          hazards.reasons.at(near) == kHazardNone && Breaks(hazards, settings, near)) {
        nearest = square;
        worst = near;
      }
    }
  }
  return worst;
}

}  // namespace palace
