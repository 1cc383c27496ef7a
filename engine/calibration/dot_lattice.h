// Order among dots: which of them lie on one grid, and where on it.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "engine/calibration/dot_finder.h"

namespace palace {

/// Dots by their place (i, j) on the grid, as indices into the list of dots. The origin is
/// anywhere; the axes are right-handed in the picture (j clockwise of i as a viewer sees it).
using DotLattice = std::map<std::pair<int, int>, std::size_t>;

struct LatticeExtent {
  int i_min = 0, i_max = 0, j_min = 0, j_max = 0;
  int columns() const { return i_max - i_min + 1; }
  int rows() const { return j_max - j_min + 1; }
};
LatticeExtent ExtentOf(const DotLattice& lattice);

/// The largest grid among the dots. It grows dot by dot from a seed with four neighbours; each step
/// is predicted from the dots placed nearby, so perspective and lens distortion may bend the grid,
/// dots may be missing, and other dark spots are passed by. Of the bases of one lattice the one
/// whose bounding box is fullest is taken: a slanted view can make a diagonal look shorter than a
/// side. Empty when no grid of 3 x 3 is found.
DotLattice FindLattice(const std::vector<Dot>& dots);

/// The lattice turned by `quarters` x 90 degrees: (i, j) -> (j, -i) for one.
DotLattice TurnLattice(const DotLattice& lattice, int quarters);

}  // namespace palace
