#include "engine/mission/site_finding.h"

#include <cmath>
#include <vector>

#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/mission/wording.h"
#include "engine/model/site_standing.h"

namespace palace {
namespace {

std::string Sentence(const ExplainedTerm& term) {
  const TermWords words = WordsOf(term);
  return words.name + " " + words.value + (words.spread.empty() ? "" : " " + words.spread) + ", " +
         words.limit;
}

/// Stands so far over its limit that no noise makes it. Without a known sigma nothing is.
bool IsGross(const ExplainedTerm& term) {
  const bool height = term.term == CellTerm::kRoughness || term.term == CellTerm::kStep;
  return height && term.figure.value - term.figure.three_sigma > 2 * term.limit;
}

}  // namespace

SiteFinding JudgeRecheck(const std::optional<LandingSite>& now,
                         const std::optional<NearestHazard>& nearest,
                         const ApprovedEvidence& approved, const SladSettings& settings) {
  if (!now) {
    return {Finding::kOver, "The site left the map", false, ""};
  }
  SiteFinding found{Finding::kGood, "", now->corridor_clear, ""};
  const auto worse = [&](Finding finding, std::string reason) {
    if (finding > found.finding) {
      found.finding = finding;
      found.reason = std::move(reason);
    }
  };
  const std::string where = nearest ? "; " + WhereWords(*nearest) : std::string();
  const bool under_lander = now->safe_distance_m < settings.lander.radius_m();
  for (const ExplainedTerm& term : TermsOf(*now, settings)) {
    if (term.over) {
      const bool room = term.term == CellTerm::kHazardDistance;
      worse(under_lander && IsGross(term) ? Finding::kGross : Finding::kOver,
            Sentence(term) + (room ? where : ""));
    } else if (approved.confirmed && BandCrossesLimit(term)) {
      worse(Finding::kDoubtful, Sentence(term));
    }
  }
  if (!now->corridor_clear) {
    worse(approved.flown_to ? Finding::kOver : Finding::kDoubtful,
          words::InApproach(now->in_approach));
  }
  if (nearest && nearest->IsSeen() && now->clearance_m < kLeastRoomShare * approved.clearance_m &&
      now->clearance_m < approved.clearance_m - kNoticedRoom_m) {
    worse(Finding::kDoubtful,
          WithNumbers("Room beyond the clear radius %.1f m, selected with %.1f m", now->clearance_m,
                      approved.clearance_m) +
              where);
  }
  if (now->age_s > kOldGround_s) {
    found.old_ground =
        WithNumbers("Ground last measured %.1f s ago, limit %.1f s", now->age_s, kOldGround_s);
    worse(Finding::kDoubtful, found.old_ground);
  }
  if (!IsAirShown(*now)) {
    const double way_m = std::fmax(0, now->air_on_way_m);  // NaN: nothing of it is known
    found.low_air =
        WithNumbers("Air over the site seen up to %.1f m, on the way down up to %.1f m, min %.1f m",
                    TenthsDown(now->air_seen_m), TenthsDown(way_m), kLeastAirSeen_m);
  }
  return found;
}

}  // namespace palace
