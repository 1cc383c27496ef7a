#include "engine/slad/map_hash.h"

#include "engine/core/hash.h"

namespace palace {

std::uint64_t HashOfMaps(const ElevationMap& map, const HazardMaps& hazards) {
  ContentHash hash;
  hash.Add(map.time.us);
  hash.Add(map.geometry.rows);
  hash.Add(map.geometry.cols);
  hash.Add(map.geometry.cell_m);
  hash.Add(map.geometry.north_min_m);
  hash.Add(map.geometry.east_min_m);
  hash.Add(map.height_m.cells());
  hash.Add(map.measured_m.cells());
  hash.Add(map.thin_top_m.cells());
  hash.Add(hazards.reasons.cells());
  hash.Add(hazards.cost.cells());
  hash.Add(hazards.safe_distance_m.cells());
  return hash.value();
}

}  // namespace palace
