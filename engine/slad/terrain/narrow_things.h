// Narrow things: what a map takes over from the fine relief of its pictures. Internal to the SLAD
// room.
//
// A place's height is that of a square 0.15 m wide about it; it stands out by p off the ground
// around it, with sigma_p (square_and_frame.h), whose frame reaches from one to four squares beyond
// the square. Nothing is said at the rim of what is seen, nor at depth edges (laid_over.h).
//
// Of its height a thing a = 18 cm across shows, smeared by the square b that is looked at and by
// the width w = 3 px range / f that a gradient feels, the share
//
//   0.8 / (1 + (w^2 + b^2) / a^2)
//
// 0.8 for it is no box. Its noise is that of the pictures and of the bumps around: what places
// around stand off their rings by beyond their own noise (GroundBumps). What stands over 1 m off is
// not narrow: the map has it.
//
// Where a place stands out by 4.5 of these sigmas, or a square twice or four times as wide does
// (its noise is small: what the worst textures repeat over stereo's window is added to it), the top
// of the cells under its square is raised (lowered, for a hole) to what a thing would be that shows
// as much; from map to map it stays so until it falls below 3.5 sigmas. Seen aslant, a thing hides
// the ground behind it, and what of it is laid there is read from there: the ground between the
// cell and the camera is raised to the rays that saw it, until these have risen by what the thing
// stands off the ground that it was laid on (R / A of fine_relief.h: all of its height where stereo
// missed it, nothing where stereo measured it), and no farther than to where the ground lies 1 m
// below them: before a wall they pass over the street. The measured ground stays as it is.
#pragma once

#include <cstdint>

#include <Eigen/Dense>

#include "engine/model/elevation_map.h"
#include "engine/model/rig.h"
#include "engine/slad/terrain/fine_sums.h"

namespace palace {

/// From where a map is seen.
struct Viewpoint {
  const PinholeCamera& camera;
  Eigen::Vector3d p_WC;

  /// Metres across that a pixel sees there.
  double Pixel_m(const Eigen::Vector3d& p_WQ) const { return (p_WQ - p_WC).norm() / camera.fx_px; }
};

/// `repeated_m2`: variance by what stereo's window repeats in every frame, the map's size; of what
/// a thing would show no more is claimed than that leaves.
/// `standing`: of each place which squares about it stood out, a bit each; kept from map to map.
void TakeNarrowThings(const FineSums& sums, const Viewpoint& view, const GridF& repeated_m2,
                      Grid<std::uint8_t>& standing, ElevationMap& map);

}  // namespace palace
