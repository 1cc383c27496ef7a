// Raised surfaces: roofs, tables, vehicle tops, canopies: what stands above the ground around it
// and has a drop nearly all around.
//
// 1. Progressive opening. The surface is opened with wider and wider squares (half width R up
//    to 20 m): opening cuts off whatever is narrower than the square. A cell that loses more than
//      max(0.3 m, R / 5) + 3 sigma
//    in one opening is a candidate; the next opens what is left. Slopes under one in five never
//    are candidates.
// 2. Rim. Candidates that touch are one surface. Where a candidate and a neighbour within 0.3 m (at
//    least one cell) that is none differ by more than max(0.3 m, 0.3 d) at the distance d there is
//    a drop, else one can walk up. Noise falls out of the many pairs. A surface is raised where
//    drops make at least 60 % of its known rim: hill tops, terraces and banks are not. The map's
//    edge counts as unseen, and at least 40 % of the rim must be seen: a roof in the corner is
//    raised, the upper half of the map is not.
//
// All of it is asked of the ground as measured: the top is raised before a roof to the rays that saw
// it, which would lead up to it. The openings run on the highest of blocks of cells, up to 0.3 m
// wide. Cost is linear in cells.
// Sources: progressive opening: Zhang et al. 2003, Pingel, Clarke and McBride 2013 (linear
// threshold, one parameter). We differ in geometric widths, in the noise term, and in the rim,
// which they do not ask.
#pragma once

#include <cstdint>

#include "engine/model/elevation_map.h"

namespace palace {

/// kFlagElevated on the measured cells of raised surfaces, else 0; of the map's shape. Unknown,
/// filled and border cells are never flagged and say nothing of a rim. Works on any size of map.
Grid<std::uint8_t> FindRaisedSurfaces(const ElevationMap& map);

}  // namespace palace
