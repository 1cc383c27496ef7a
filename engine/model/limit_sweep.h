// What one limit, moved alone over its usual range, would make of one map: the area that could bear
// the lander, and the place that would be the best.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/time.h"
#include "engine/model/settings/settings.h"

namespace palace {

struct SweptValue {
  double value = 0;           ///< of the limit, as settings hold it
  double safe_area_m2 = 0;    ///< cells that could bear the lander (HazardMaps::safe_cells)
  std::uint64_t best_id = 0;  ///< of the first place that is not refused; 0: there is none
  std::string best{};         ///< its letter; "+1": the flight has not named it
  double best_clear_m = NAN;  ///< its safe distance
};

struct LimitSweep {
  std::string limit;  ///< "slad.max_slope_deg"
  Timestamp map_time;
  Settings others;                 ///< all limits; that of the one that is swept means nothing
  std::vector<SweptValue> values;  ///< ascending; empty: it was given up
};

/// Whether two values have the same best place, or none both. Places that the flight has not named
/// are all one: which of them it is no letter tells.
bool SameBest(const SweptValue& a, const SweptValue& b);

/// Whether it can be swept on one map: a number that changes verdicts, and nothing of the map.
bool MaySweep(const SettingInfo& limit);

/// Where the best place changes next to a value, walking away from it; nothing: it stays.
struct BestChange {
  double value = 0;  ///< the last one that keeps the best
  SweptValue then;   ///< the first one with another
};
/// Below the value and above it. The best at a value is that of the swept value nearest to it.
struct BestAround {
  SweptValue here;
  std::optional<BestChange> below, above;
};
/// Nothing when the sweep is empty.
std::optional<BestAround> BestAroundValue(const LimitSweep& sweep, double value);

}  // namespace palace
