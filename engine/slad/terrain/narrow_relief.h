// Narrow relief: the height of things smaller than stereo's matching window. Internal to the SLAD
// room.
#pragma once

#include <Eigen/Dense>

#include "engine/model/elevation_map.h"
#include "engine/model/rig.h"
#include "engine/slad/terrain/refused_pixels.h"

namespace palace {

inline constexpr double kStereoWindow_px = 9;  ///< of stereo's refinement
inline constexpr double kRingWindows = 1.25;   ///< nearer, the window smears a thing onto its ring
/// Width of the thing that must not hide: half as wide again as it is high, at 1.2 times the default
/// limit; and the share of its height that it shows unsmeared: it is no box.
inline constexpr double kThing_m = 0.18, kPeakOfThing = 0.8;
/// That share, smeared by w^2 + c^2 (below), and what smears it so.
inline double ShareOfSmeared(double smeared_m2) {
  return kPeakOfThing / (1 + smeared_m2 / (kThing_m * kThing_m));
}
inline double SmearedOfShare(double share) {
  return kThing_m * kThing_m * (kPeakOfThing / share - 1);
}

/// A matching window w metres wide reads a thing s < w wide as lower, by about (s / w)^2, because
/// it averages it with the ground around, and a hole as shallower. Cells that stand above a ring
/// around them by more than 5.5 sigmas, and by `rough`, are raised to what a thing `narrow_m` wide
/// must then be; cells below it are lowered likewise:
///
///   h := ring + k (h - ring),   k = (w / narrow_m)^2, from 1 to 6,   w = 9 px * range / f
///   rough = 4 ground, within 3.5 and 10 times the ring's own
///
/// but to no more than 1 m off the ring. A thing that is read as too low is read as too far away,
/// too: it stands somewhere on the rays that saw it, nearer to the camera where they are higher. So
/// where a cell that stands eight sigmas is raised by d, those between it and the camera are raised
/// to its rays, until these have risen by d: d / tan(elevation) of ground. (A hole's rim is where
/// its cells are seen.)
///
/// The ring is rough by what it is off its own plane: edges
/// of wide things are no narrow things and stay. The ground is rough by what its cells stand off
/// their rings (`GroundRoughness`), less the variance of cell and ring and 2.5 times the sigma of
/// what stereo repeats (`repeated_m2`, m^2), as on its worst textures: bumps among bumps stay, many
/// things on even ground do not hide each other.
///
/// k is at least 4 where stereo refused more than 0.15 of the pixels of the cell or of one that
/// touches it: steep sides were not measured, and what was is their foot.
///
/// One of the four cells beside must stand four sigmas above the same ring, or 2.5 where the cell
/// itself stands eight: a window as wide as a cell smears a thing over two, noise stands alone.
/// These sigmas are those of fusion, without what stereo repeats: what is raised is told from
/// noise, not measured.
///
/// The ring, 1.25 w + narrow_m / 2 and at least two cells in radius (8 pairs of places that face
/// each other; cells with fewer than 5 known stay), takes slope out. Level ground and noise stay as
/// they are. The variance is left: the sign of the thing is as certain as
/// before. `pixels` and `repeated_m2` have the map's size, or are empty: none was refused, nothing
/// is repeated.
void RaiseNarrowRelief(const PinholeCamera& camera, const Eigen::Vector3d& p_WC, double narrow_m,
                       const Grid<PixelCount>& pixels, const GridF& repeated_m2, ElevationMap& map);

/// What the measured ground shows of narrow things, and what one would show. Rings as above, but
/// their medians: one false match is no ring of things. What stands over 1 m off is not narrow and
/// unknown here: hazards judge it. A
/// thing a = 18 cm across is smeared by window w and map cell c; of its height it then shows the
/// share
///
///   0.8 / (1 + (w^2 + c^2) / a^2)
///
/// Its noise is that of the map, with what stereo repeats, or what the cells around stand off their
/// rings by (GroundRoughness), whichever is more: among bumps a bump says nothing. 0.8 for it is no
/// box. Measured on drawn rocks of 15 cm: 0.27 to 0.35 at 15 to 20 m, as this
/// says.
NarrowFigures MeasureNarrowRelief(const PinholeCamera& camera, const Eigen::Vector3d& p_WC,
                                  double narrow_m, const GridF& repeated_m2,
                                  const ElevationMap& map);

}  // namespace palace
