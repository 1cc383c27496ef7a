#include "engine/slad/sites/site_ranking.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/model/site_standing.h"

namespace palace {
namespace {

constexpr double kShaken_s = 30;

/// Who comes first whatever the score; less is better.
auto Order(const SitePlace& place, const LandingSite& site) {
  const int approach = place.straight_clear.good() ? 0 : place.some_clear.good() ? 1 : 2;
  return std::tuple(site.age_s > kOldGround_s, !place.air_shown.good(), approach,
                    !place.roomy.good());
}

/// What is selected is always listed.
void CutTo(const std::vector<SitePlace>& places, const RankRules& rules,
           std::vector<FoundSite>& found) {
  if (found.size() <= rules.most) {
    return;
  }
  const auto last = found.begin() + static_cast<std::ptrdiff_t>(rules.most) - 1;
  const auto kept = std::find_if(last + 1, found.end(), [&](const FoundSite& one) {
    const std::uint64_t id = places[one.place].id;
    return id != 0 && id == rules.kept;
  });
  if (kept != found.end()) {
    std::swap(*last, *kept);
  }
  found.erase(last + 1, found.end());
}

}  // namespace

double SitePlace::ShakenFor(Timestamp now) const {
  const double since_s = shaken_at ? SecondsBetween(*shaken_at, now) : NAN;
  return since_s < kShaken_s * losses ? since_s : NAN;
}

std::vector<FoundSite> Ranked(const std::vector<SitePlace>& places, std::vector<FoundSite> found,
                              const RankRules& rules) {
  const auto place_of = [&](const FoundSite& one) -> const SitePlace& { return places[one.place]; };
  std::stable_sort(found.begin(), found.end(), [&](const FoundSite& a, const FoundSite& b) {
    const SitePlace &p = place_of(a), &q = place_of(b);
    if (p.rank < 0 && q.rank < 0) {
      return p.score.value() > q.score.value();
    }
    return p.rank >= 0 && (q.rank < 0 || p.rank < q.rank);
  });
  const auto worth = [&](const FoundSite& one) {
    const bool shaken = std::isfinite(place_of(one).ShakenFor(rules.now));
    return place_of(one).score.value() - (shaken ? rules.shaken_costs : 0);
  };
  const auto passes = [&](const FoundSite& a, const FoundSite& b) {
    const auto first = Order(place_of(a), a.site), second = Order(place_of(b), b.site);
    return first != second ? first < second : worth(a) - worth(b) > rules.noise;
  };
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t i = 1; i < found.size(); ++i) {
      if (passes(found[i], found[i - 1])) {
        std::swap(found[i - 1], found[i]);
        moved = true;
      }
    }
  }
  CutTo(places, rules, found);
  return found;
}

}  // namespace palace
