// Hidden things: how many rocks or holes over the limit may lie unseen under a touchdown.
//
// Stereo smears what is narrower than its window, so a thing over the limit may show a few
// centimetres only, and noise may hide these. Of each cell the map says by how much it stands above
// its surroundings (p), with which sigma (s), and which share of its height a thing 18 cm across
// would show there. Such a thing of 1.2 times the limit shows r. Against bare ground it is more
// likely, by what shows, by
//
//   L = exp((2 r p - r^2) / (2 s^2))          (a hole: -p for p)
//
// and with a prior of n things a square metre, half of them holes, a cell of area A hides one with
//
//   q = (n A / 2) L / (1 + (n A / 2) L)
//
// Their sum over the disc is the expected number. Ground that is smooth, near and textured hides
// none (1e-10); ground too far away to tell hides what the prior says; a cell that stands out by
// half of r counts as much as one in which nothing could be seen. Monotone in each figure.
#pragma once

#include "engine/model/elevation_map.h"

namespace palace {

/// Over the cells within the radius of a cell's middle; cells of which nothing is known hide what
/// the prior says. 0 where the map has no such figures (a survey).
double HiddenThings(const ElevationMap& map, double max_deviation_m, Cell centre, double radius_m);

/// Whether what shows in a cell rules such a thing out, fifty to one: ground that is seen. All seen
/// is where no figures are.
bool IsSeen(const ElevationMap& map, double max_deviation_m, Cell cell);

/// So many at most under a confirmed site.
inline constexpr double kMostHidden = 0.01;

}  // namespace palace
