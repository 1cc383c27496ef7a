// How the lander's gear would rest on the ground: its tilt and the ground under its belly, at every
// heading. Internal to the SLAD room but for OddsOfTouchdown.
//
// The gear stands on the high points of the ground under it (Ivanov, Huertas & Carson 2013 for
// pads).
//  Skids: both reach the highest points under them; the pitch p (fore-aft gradient) is the one at
//    which their mean support height, mean of max_x (h(x) - p x), is least, as the weight seeks it;
//    the roll is the difference of the two supports over the width.
//  Pads: the diagonal with the higher mean carries; both planes through it and one of the other two
//    pads count.
// Between cell centres the ground is bilinear. Headings are so close that the gear's corners move
// by no more than 1.25 cells from one to the next; half a turn holds them all, for the gear looks
// the same from behind. A skid is felt at no more than 13 points; where they are farther apart than
// cells, the highest cells between them count.
#pragma once

#include <vector>

#include "engine/model/elevation_map.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"
#include "engine/slad/hazards/loops/slad_loops.h"

namespace palace {

/// Worst resting place over some headings; NaN where the gear would reach unknown ground.
struct GearRest {
  float tilt_rad = kUnknownValue;  ///< of the gear's plane against the up vector
  float rise_m = kUnknownValue;    ///< of the ground under the belly above that plane
};

/// The gear over heights, NaN where unknown. Outside them nothing is known.
class GearOverMap {
 public:
  GearOverMap(const GridF& height_m, double cell_m, const Lander& lander,
              const SladLoops& loops = FastestSladLoops());
  GearOverMap(const GearOverMap&) = delete;

  int headings() const { return static_cast<int>(heading_.size()); }
  double heading_rad(int index) const;
  /// Worst of all headings around the cells of one row.
  void WorstOfRow(int row, float* tilt_rad, float* rise_m) const;
  /// At one heading.
  GearRest At(Cell cell, int heading) const;

 private:
  void LayOut(const Lander& lander, double cell_m);
  void CopyHeights(const GridF& height_m);
  /// unknown: 1 or 0, as large as height_.
  void FindUnknown(const GridF& unknown);
  /// Whether all cells in reach of the gear are.
  bool IsKnown(Cell middle) const;
  const float* HeightRow(int row) const { return height_.row(row + reach_) + reach_; }

  const SladLoops& loops_;
  int rows_, cols_;
  int reach_ = 1;   ///< cells the gear reaches beyond its middle
  int stride_ = 1;  ///< cells between points of a skid
  GearShape shape_{};
  std::vector<GearHeading> heading_;
  std::vector<std::vector<BellyRow>> belly_;
  GridF height_;        ///< reach_ cells wider on every side, relative to a known height
  GridF near_unknown_;  ///< 1 where a cell in reach along the row is not known; rows as of height_
};

/// Worst and best heading of a touchdown at the site. The worst probability is the map's own; the
/// headings are told apart on the denoised heights off the site's plane. Headings run to pi: the
/// opposite one is as good. NaN in thesis mode, and where the map has none.
TouchdownOdds OddsOfTouchdown(const ElevationMap& map, const HazardMaps& hazards,
                              const SladSettings& settings, const LandingSite& site);

}  // namespace palace
