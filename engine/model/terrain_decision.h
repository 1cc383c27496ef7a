// One evaluation of SLAD under one set of settings: the maps, the sites, and what names them.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/core/time.h"
#include "engine/model/elevation_map.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/image.h"
#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"

namespace palace {

struct TerrainDecision {
  Timestamp map_time;
  std::shared_ptr<const ElevationMap> elevation;
  std::shared_ptr<const HazardMaps> hazards;
  SiteSelection selection;  ///< letters assigned
  SladSettings settings;
  std::uint64_t settings_hash = 0;
  std::uint64_t map_hash = 0;
  /// GroundClass per pixel of the left image at quarter size. Null for a map that no picture belongs
  /// to (a survey).
  std::shared_ptr<const ImageU8> verdict;
};

}  // namespace palace
