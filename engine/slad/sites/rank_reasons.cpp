#include "engine/slad/sites/rank_reasons.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/shown_difference.h"
#include "engine/core/text.h"
#include "engine/model/cell_explanation.h"
#include "engine/model/site_standing.h"
#include "engine/slad/sites/site_candidates.h"

namespace palace {
namespace {

/// "Straight approach blocked; clear from south-west", "... from 3 of 8 sides".
std::string ApproachWords(const LandingSite& site) {
  if (site.clear_approaches == 0) {
    return "Every approach blocked";
  }
  const unsigned clear = site.clear_approaches;
  std::string from;
  int count = 0;
  for (unsigned k = 0; k < 8; ++k) {
    if ((clear >> k & 1U) != 0 && ++count <= 2) {
      from += (from.empty() ? "" : ", ") + std::string(DirectionWord(k * std::numbers::pi / 4));
    }
  }
  // Which of many is flown is planned when the site is selected.
  return "Straight approach blocked; clear from " +
         (count > 2 ? std::to_string(count) + " of 8 sides" : from);
}

/// What it counts less for, as SiteRegistry ranks it.
std::string UnsafeWords(SiteRanking ranking, const LandingSite& site) {
  // Of a map that stands still, too: how long before it.
  return WithNumbers("Called unsafe %.0f s before, ", site.called_unsafe_s) +
         (ranking == SiteRanking::kFarthest
              ? WithNumbers("ranks as %.1f m narrower", site.clear_radius_m)
              : "ranks behind");
}

// Less than this is no difference that is told.
constexpr double kWider_m = 0.05, kCheaper = 0.005;

/// Why a site that is better on this map than those before it ranks behind.
const char* WhyNotYet(const LandingSite& site) {
  return std::isfinite(site.called_unsafe_s) ? " (called unsafe)" : " (noise, or new)";
}

/// What sites are ranked by where room ranks.
double Room(const LandingSite& site) {
  return RankedRoom(site.safe_distance_m, site.hidden_things, site.clear_radius_m);
}

/// Whether it is more by what may hide than by what is clear that one has less room.
bool ByHidden(const LandingSite& a, const LandingSite& b) {
  const double by_clear_m = a.safe_distance_m - b.safe_distance_m;
  const double by_hidden_m = Room(a) - Room(b) - by_clear_m;
  return std::abs(by_hidden_m) > std::abs(by_clear_m);
}

/// "0.12"; "0.004" of what hides less than under a confirmed site; "under 0.001".
std::string HiddenWords(const LandingSite& site) {
  constexpr double kLeastTold = 0.001;
  return site.hidden_things < kLeastTold
             ? WithNumbers("under %.3f", kLeastTold)
             : WithNumbers(site.hidden_things < kMostHidden ? "%.3f" : "%.2f", site.hidden_things);
}

/// Of two of which one is marked what hides is compared, whatever it is.
const char* HidingWords(const LandingSite& a, const LandingSite& b) {
  return IsMarked(a) || IsMarked(b) ? " things may hide, at " : " rocks or holes may hide, at ";
}

/// What `better` has over `other` in the units of what decided; empty where nothing measurable.
std::string Difference(SiteRanking ranking, const LandingSite& better, const LandingSite& other,
                       bool of_better, const std::string& against) {
  const double ahead_m = Room(better) - Room(other);
  const double cheaper = other.cost - better.cost;
  if (ranking == SiteRanking::kFarthest && std::abs(ahead_m) >= kWider_m) {
    const bool noise = ahead_m < 0;
    const std::string stays = of_better && noise ? "stays first, " : "";
    if (ByHidden(better, other)) {
      const LandingSite& site = of_better ? better : other;
      return stays + HiddenWords(site) + HidingWords(better, other) + against + " " +
             HiddenWords(of_better ? other : better) + (noise ? WhyNotYet(other) : "");
    }
    const double wider_m = DifferenceAsShown(better.safe_distance_m, other.safe_distance_m);
    return stays + WithNumbers("%.1f m ", std::abs(wider_m)) +
           ((wider_m > 0) == of_better ? "more" : "less") + " clear than " + against +
           (noise ? WhyNotYet(other) : "");
  }
  if (cheaper >= kCheaper) {
    return WithNumbers(of_better ? "cost %.2f less than " : "cost %.2f more than ", cheaper) +
           against;
  }
  if (ranking == SiteRanking::kCost && cheaper <= -kCheaper) {
    return (of_better ? "stays first, cost " : "cost ") + WithNumbers("%.2f ", -cheaper) +
           (of_better ? "more" : "less") + " than " + against + WhyNotYet(other);
  }
  return "as good as " + against +
         (of_better ? ", nearer to the middle" : ", farther from the middle");
}

std::string Capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') {
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  }
  return text;
}

/// Better on this map by a difference that is told.
bool Beats(SiteRanking ranking, const LandingSite& a, const LandingSite& b) {
  return ranking == SiteRanking::kFarthest ? Room(a) >= Room(b) + kWider_m
                                           : a.cost <= b.cost - kCheaper;
}

/// Of one that the best goes before. Where the order is not what figures and standing suggest, the
/// reason says so: places are ranked by room and what may hide, or by cost, over many maps.
std::string ReasonBelow(SiteRanking ranking, double tight_m, const SiteSelection& selection,
                        std::size_t i) {
  const LandingSite& best = selection.sites.front();
  const LandingSite& above = selection.sites[i - 1];
  const LandingSite& site = selection.sites[i];
  const bool tight = site.clearance_m < tight_m && best.clearance_m >= tight_m;
  std::string reason = tight ? WithNumbers("%.2f m beyond the clear radius, at the best %.2f m",
                                           site.clearance_m, best.clearance_m)
                             : Capital(Difference(ranking, best, site, false, "the best"));
  if (site.confirmed && !best.confirmed) {
    reason += ", though confirmed";
  }
  if (i > 1 && above.corridor_clear && Beats(ranking, site, above)) {
    reason += "; better than " + above.letter + WhyNotYet(site);
  }
  return reason;
}

std::string ReasonOfBest(SiteRanking ranking, const SiteSelection& selection) {
  const LandingSite& best = selection.sites.front();
  if (!best.corridor_clear) {
    return ApproachWords(best);
  }
  if (selection.sites.size() == 1) {
    return "The only site";
  }
  const LandingSite& next = selection.sites[1];
  if (std::none_of(selection.sites.begin() + 1, selection.sites.end(),
                   [](const LandingSite& other) { return other.corridor_clear; })) {
    return "The only straight approach that is clear";
  }
  const std::string by = Difference(ranking, best, next, true, "the next");
  // One that a map called unsafe a moment ago may be wider, and not lead.
  const bool outdone =
      std::any_of(selection.sites.begin(), selection.sites.end(), [&](const LandingSite& other) {
        return ranking == SiteRanking::kFarthest
                   ? std::max(Room(other) - Room(best),
                              other.safe_distance_m - best.safe_distance_m) > kWider_m
                   : other.cost < best.cost - kCheaper;
      });
  const char* criterion = outdone || ByHidden(best, next)     ? "Leads: "
                          : ranking == SiteRanking::kFarthest ? "Widest: "
                                                              : "Cheapest: ";
  const bool leads = by.rfind("as good", 0) != 0 && by.rfind("stays", 0) != 0;
  return leads ? criterion + by : Capital(by);
}

}  // namespace

void GiveReasons(SiteRanking ranking, double tight_m, SiteSelection& selection) {
  for (std::size_t i = 0; i < selection.sites.size(); ++i) {
    LandingSite& site = selection.sites[i];
    site.reason =
        i == 0                      ? ReasonOfBest(ranking, selection)
        : site.age_s > kOldGround_s ? WithNumbers("Ground last measured %.0f s ago", site.age_s)
        : !IsAirShown(site)         ? "Too little of the air over it is seen from here"
        : !site.corridor_clear      ? ApproachWords(site)
        : std::isfinite(site.called_unsafe_s) ? UnsafeWords(ranking, site)
                                              : ReasonBelow(ranking, tight_m, selection, i);
  }
}

}  // namespace palace
