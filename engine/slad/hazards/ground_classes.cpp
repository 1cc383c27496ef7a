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

namespace palace {
namespace {

/// How a cell with these reasons is counted.
enum CountedAs {
  kAsSlope,
  kAsRoughness,
  kAsUnknown,
  kAsFlagged,
  kAsFootprint,
  kAsSafe,
  kCountings
};
constexpr CountedAs CountingOf(unsigned reasons) {
  return (reasons & kHazardSlope) != 0                       ? kAsSlope
         : (reasons & (kHazardRoughness | kHazardStep)) != 0 ? kAsRoughness
         : (reasons & kHazardUnknown) != 0                   ? kAsUnknown
         : (reasons & kHazardFlagged) != 0                   ? kAsFlagged
         : (reasons & kHazardProbability) != 0               ? kAsRoughness
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

double HiddenAt(const HazardMaps& hazards, Cell cell) {
  return hazards.hidden_things.empty() ? 0.0 : static_cast<double>(hazards.hidden_things.at(cell));
}

/// Whether a touchdown on a cell without reasons keeps the limits of its mode, with so many things
/// expected unseen around it.
bool KeepsLimits(const HazardMaps& hazards, const SladSettings& settings, Cell cell,
                 double hidden) {
  if (settings.mode == SladMode::kThesis) {
    return true;
  }
  // The layer holds what hides around the touchdown itself.
  const double own = HiddenAt(hazards, cell);
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
  return !KeepsLimits(hazards, settings, cell, HiddenAt(hazards, cell)) &&
         !KeepsLimits(hazards, settings, cell, 0);
}

/// The touchdowns of a lander sent to a cell: offsets in cells.
class Touchdowns {
 public:
  Touchdowns(const SladSettings& settings, const GridGeometry& geometry) {
    // No farther than the map is wide: beyond it nothing is known.
    const double radius_cells = std::min(settings.lander.nav_error_m / geometry.cell_m,
                                         std::max(geometry.rows, geometry.cols) + 1.0);
    reach_ = static_cast<int>(radius_cells + 1e-9);
    for (int dr = -reach_; dr <= reach_; ++dr) {
      half_.push_back(static_cast<int>(std::sqrt(radius_cells * radius_cells - dr * dr + 1e-9)));
    }
  }
  int reach() const { return reach_; }
  /// Columns on either side that a touchdown so many rows off may reach.
  int HalfWidth(int rows_off) const { return half_[static_cast<std::size_t>(rows_off + reach_)]; }

 private:
  int reach_ = 0;
  std::vector<int> half_;
};

}  // namespace

void ClassifyCells(const SladSettings& settings, HazardMaps& hazards) {
  const int rows = hazards.geometry.rows, cols = hazards.geometry.cols;
  const float clear_m = static_cast<float>(settings.lander.clear_radius_m());
  // Nothing with a reason lies within the navigation error of a place with room.
  const float touched_m =
      clear_m - static_cast<float>(settings.lander.nav_error_m + hazards.geometry.cell_m);
  const Touchdowns touchdowns(settings, hazards.geometry);
  struct RowOf {
    std::array<int, kAllReasons + 1> with{};  ///< cells with these very reasons
    std::vector<int> breaking;                ///< columns where a touchdown breaks a limit
    int too_near = 0, footprint = 0;          ///< no hazards, but no place for the lander
  };
  hazards.ground = Grid<GroundClass>(rows, cols);
  std::vector<RowOf> of_row(static_cast<std::size_t>(rows));
  cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
    for (int r = range.start; r < range.end; ++r) {
      RowOf& row = of_row[static_cast<std::size_t>(r)];
      const std::uint8_t* reasons = hazards.reasons.row(r);
      const float* distance_m = hazards.safe_distance_m.row(r);
      GroundClass* ground = hazards.ground.row(r);
      for (int c = 0; c < cols; ++c) {
        const Cell cell{r, c};
        ++row.with[reasons[c] & kAllReasons];
        if (reasons[c] != kHazardNone) {
          ground[c] = kClassOf[reasons[c] & kAllReasons];
          continue;
        }
        ground[c] = !(distance_m[c] >= clear_m) ? GroundClass::kTooNear
                    : KeepsLimits(hazards, settings, cell, HiddenAt(hazards, cell))
                        ? GroundClass::kLandable
                        : GroundClass::kFootprint;
        if (distance_m[c] >= touched_m && Breaks(hazards, settings, cell)) {
          row.breaking.push_back(c);
        }
      }
    }
  });
  cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
    for (int r = range.start; r < range.end; ++r) {
      RowOf& row = of_row[static_cast<std::size_t>(r)];
      GroundClass* ground = hazards.ground.row(r);
      for (int near = std::max(0, r - touchdowns.reach());
           near <= std::min(rows - 1, r + touchdowns.reach()); ++near) {
        const int half = touchdowns.HalfWidth(near - r);
        for (const int breaking : of_row[static_cast<std::size_t>(near)].breaking) {
          const int last = std::min(cols - 1, breaking + half);
          for (int c = std::max(0, breaking - half); c <= last; ++c) {
            ground[c] = ground[c] == GroundClass::kLandable ? GroundClass::kFootprint : ground[c];
          }
        }
      }
      row.too_near = static_cast<int>(std::count(ground, ground + cols, GroundClass::kTooNear));
      row.footprint = static_cast<int>(std::count(ground, ground + cols, GroundClass::kFootprint));
    }
  });
  std::array<int, kCountings> count{};
  for (const RowOf& row : of_row) {
    for (unsigned reasons = 0; reasons <= kAllReasons; ++reasons) {
      count[CountingOf(reasons)] += row.with[reasons];
    }
    count[kAsSafe] -= row.too_near + row.footprint;
    count[kAsFootprint] += row.too_near + row.footprint;
    hazards.counts[GroundClass::kTooNear] += row.too_near;
    hazards.counts[GroundClass::kFootprint] += row.footprint;
  }
  hazards.rejected = {count[kAsSlope], count[kAsRoughness], count[kAsUnknown], count[kAsFlagged],
                      count[kAsFootprint]};
  hazards.counts[GroundClass::kUnknown] = count[kAsUnknown];
  hazards.counts[GroundClass::kHazard] = count[kAsSlope] + count[kAsRoughness] + count[kAsFlagged];
  hazards.counts[GroundClass::kLandable] = hazards.safe_cells = count[kAsSafe];
}

Cell WorstTouchdown(const HazardMaps& hazards, const SladSettings& settings, Cell cell) {
  if (hazards.ground.at(cell) != GroundClass::kFootprint ||
      !KeepsLimits(hazards, settings, cell, HiddenAt(hazards, cell))) {
    return cell;
  }
  const Touchdowns touchdowns(settings, hazards.geometry);
  Cell worst = cell;
  int nearest = std::numeric_limits<int>::max();
  for (int dr = -touchdowns.reach(); dr <= touchdowns.reach(); ++dr) {
    const int half = touchdowns.HalfWidth(dr);
    for (int dc = -half; dc <= half; ++dc) {
      const Cell near{cell.row + dr, cell.col + dc};
      if (dr * dr + dc * dc < nearest && hazards.geometry.Contains(near) &&
          hazards.reasons.at(near) == kHazardNone && Breaks(hazards, settings, near)) {
        nearest = dr * dr + dc * dc;
        worst = near;
      }
    }
  }
  return worst;
}

}  // namespace palace
