#include "engine/model/limit_sweep.h"

#include <algorithm>
#include <iterator>

#include "engine/model/landing_site.h"

namespace palace {

bool MaySweep(const SettingInfo& limit) {
  const Settings standard;
  Settings moved;
  const double other = limit.default_value == limit.max ? limit.min : limit.max;
  if (!limit.words.empty() || !SetSettingValue(moved, limit.name, other)) {
    return false;
  }
  moved.slad.limits = standard.slad.limits;
  moved.slad.lander = standard.slad.lander;
  return moved == standard;
}

bool SameBest(const SweptValue& a, const SweptValue& b) {
  const auto named = [](const SweptValue& swept) {
    return swept.best_id == 0 || IsNamedSite(swept.best_id);
  };
  return named(a) || named(b) ? a.best_id == b.best_id : true;
}

std::optional<BestAround> BestAroundValue(const LimitSweep& sweep, double value) {
  if (sweep.values.empty()) {
    return std::nullopt;
  }
  const auto begin = sweep.values.begin(), end = sweep.values.end();
  const auto here = std::min_element(begin, end, [&](const SweptValue& a, const SweptValue& b) {
    return std::abs(a.value - value) < std::abs(b.value - value);
  });
  const auto other = [&](const SweptValue& swept) { return !SameBest(swept, *here); };
  BestAround around{*here, {}, {}};
  if (const auto above = std::find_if(here, end, other); above != end) {
    around.above = {std::prev(above)->value, *above};
  }
  const auto below = std::find_if(std::make_reverse_iterator(here), sweep.values.rend(), other);
  if (below != sweep.values.rend()) {
    around.below = {std::prev(below)->value, *below};
  }
  return around;
}

}  // namespace palace
