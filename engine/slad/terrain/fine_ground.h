// The ground itself, from the fine relief of its pictures: what of its bumps is known, and how
// well. Internal to the SLAD room.
//
// A plane through a square of eight (1.2 m) is known to millimetres where a cell alone is known to
// centimetres. So a cell's height is taken as that plane and details of squares that halve,
//
//   h = plane + sum over m = 4, 2, 1 of w_m d_m,   d_m = e_m - e_2m,   e_m = h_m - plane, e_8 = 0
//
// h_m of a square of m (0.15 m times m) about the cell. Each detail has noise of variance
// n_m = sigma_m^2 - sigma_2m^2, and the ground around has bumps of that size with variance b_m:
// what the details there spread by beyond their noise (GroundBumps). Its posterior mean and
// variance, bumps and noise normal:
//
//   w_m = b_m / (b_m + n_m),   sigma_h^2 = plane's + sum b_m n_m / (b_m + n_m)
//
// A detail beyond 4.5 sigmas of both is no bump of that ground: w_m is 1, and n_m its variance;
// from 3 sigmas on w_m goes there. So level ground is not rough by noise, rough ground is known to
// be rough where no single bump is told, and what stands out stays as high as it is.
//
// Sources: Wiener 1949; Donoho & Johnstone 1994 (shrinkage by scales).
#pragma once

#include "engine/model/elevation_map.h"
#include "engine/slad/terrain/fine_sums.h"

namespace palace {

/// Gives measured cells their posterior height and variance; the top keeps what it stands above the
/// ground. Cells that stereo knows better, and those where the pictures deny what stereo measured
/// (by 4.5 sigmas and 2 cm: edges, where a disparity is no plane), stay as they are.
void TakeFineGround(const FineSums& sums, ElevationMap& map);

}  // namespace palace
