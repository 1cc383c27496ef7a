// Legend over the camera picture: what the hatches of the verdict mean, and the shapes of the
// flags.
//
// Two plates, "Safe to land on | Over a limit or unknown | No place for a lander" and one of the
// flags that occur, each in a corner where it hides no letter, no ring of a site and no mark of a
// tracker: the first at the top left if it can, the second beside it. In small pictures the first
// is "Safe | Over | No place" and the second a column (but not over the track view), if only these
// fit; where a ring fills the picture, they stand over the ring. One that hides a letter or a
// tracker wherever it stands is left out.
#pragma once

#include <cstddef>

#include "gui/widgets/ui_frame.h"

namespace palace {

/// Where a plate stood last, among the ways and spots it may stand in.
struct PlatePlace {
  std::size_t ways = 0;  ///< that there were; 0: nowhere yet
  std::size_t way = 0, spot = 0;
};

struct LegendPlace {
  PlatePlace verdict, flags;
};

/// Names of the items.
inline constexpr const char *kVerdictLegend = "legend", *kFlagLegend = "flag_legend";
/// An item of this name keeps its place: the plates stand elsewhere.
inline constexpr const char* kTrackLegend = "track_legend";
inline constexpr const char* kTrackMark = "track_mark";  ///< of a feature, of a tracker's site

/// `flags`: that occur. A plate stays where it stood last while that is as good as any other place:
/// `place`. Call after DrawSites.
void DrawVerdictLegend(UiFrame& ui, const Rect& image, unsigned flags, LegendPlace& place);

}  // namespace palace
