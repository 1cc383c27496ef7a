// Verdict per pixel of the left picture: what the hazard maps say about the ground seen there.
#pragma once

#include "engine/model/elevation_map.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/image.h"
#include "engine/model/range_map.h"

namespace palace {

/// GroundClass of the map's cell. Size of the left picture divided by `divisor`, rounded down.
/// Each pixel's point (its depth, or that of the nearest measured pixel within two blocks) is
/// looked up in the maps. Without a depth (the right camera does not see there, texture lacks) it
/// is the point where the pixel's ray first meets the ground of `map`, which older frames may have
/// measured. `map` and `hazards` have one geometry, the range map has a pose.
ImageU8 VerdictImage(const RangeMap& range, const ElevationMap& map, const HazardMaps& hazards,
                     int divisor = 4);

}  // namespace palace
