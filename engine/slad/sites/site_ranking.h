// In which order the places that a map found are listed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/time.h"
#include "engine/slad/sites/site_place.h"

namespace palace {

struct RankRules {
  Timestamp now;
  double noise = 0;         ///< of a score: who is better by no more passes nobody
  double shaken_costs = 0;  ///< of the score of a place that a map called unsafe
  std::size_t most = 1;     ///< listed
  std::uint64_t kept = 0;   ///< the id that is listed in any case; 0: none
};

/// Those found, best first (site_registry.h, rank): what stood in a row before stays in it, new
/// ones come in by their score.
std::vector<FoundSite> Ranked(const std::vector<SitePlace>& places, std::vector<FoundSite> found,
                              const RankRules& rules);

}  // namespace palace
