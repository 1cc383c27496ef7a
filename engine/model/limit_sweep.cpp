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

bool SameBest(const LimitSweep& sweep, const SweptValue& a, const SweptValue& b) {
  if (a.best_id == 0 || b.best_id == 0 || IsNamedSite(a.best_id) || IsNamedSite(b.best_id)) {
    return a.best_id == b.best_id;
  }
  // "+1" is a letter of one list: as one place counts what the registry takes for one.
  return (a.best_W - b.best_W).norm() <= sweep.others.slad.choice.spacing_m / 4;
}

std::optional<BestAround> BestAroundValue(const LimitSweep& sweep, double value) {
  if (sweep.values.empty()) {
    return std::nullopt;
  }
  const auto begin = sweep.values.begin(), end = sweep.values.end();
  const auto here = std::min_element(begin, end, [&](const SweptValue& a, const SweptValue& b) {
    return std::abs(a.value - value) < std::abs(b.value - value);
  });
  const auto other = [&](const SweptValue& swept) { return !SameBest(sweep, swept, *here); };
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
