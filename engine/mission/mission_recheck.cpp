// Re-checks of the armed site on every new map, and the alternative kept for it.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/mission/mission.h"

namespace palace {
namespace {

constexpr double kRecheckShown_s = 1;

bool SharesGround(const LandingSite& a, const LandingSite& b) {
  return (a.p_WS - b.p_WS).head<2>().norm() <= a.clear_radius_m + b.clear_radius_m;
}

}  // namespace

void Mission::FollowSite(const MissionInputs& in) {
  if (!in.new_map || !status_.armed) {
    return;
  }
  site_.Add(JudgeRecheck(in.rechecked, in.nearest, {armed_.confirmed, status_.armed->clearance_m},
                         in.settings.slad),
            in.now);
  newest_ = in.rechecked;
  armed_.confirmed = armed_.confirmed || (site_.newest().holds() && in.rechecked->confirmed);
  FollowAlternative(in);
  const SiteVerdict verdict = site_.VerdictAt(in.now);
  if (verdict != told_) {
    const std::string name = std::string("Site ") + status_.armed->letter;
    AddEvent(in.now, EventKind::kSite,
             verdict == SiteVerdict::kHolds ? name + " holds again"
             : verdict == SiteVerdict::kDegraded
                 ? name + " degraded: " + site_.reason()
                 : name + " lost: " + site_.reason() + ". " + AlternativeWords());
    told_ = verdict;
  }
  if (status_.state == MissionState::kDescending || status_.state == MissionState::kHold) {
    RecordRecheck(in);
  }
}

void Mission::FollowAlternative(const MissionInputs& in) {
  const auto usable = [&](const std::optional<LandingSite>& site) {
    return site && !status_.IsRefused(site->id) && site->corridor_clear &&
           !SharesGround(*site, *status_.armed) &&
           JudgeRecheck(site, {}, {false, 0}, in.settings.slad).holds();
  };
  if (alternative_ && usable(in.alternative)) {
    alternative_ = in.alternative;  // the same place on this map
    return;
  }
  alternative_.reset();
  for (const LandingSite& site : facts_.sites) {
    if (site.id != status_.armed->id && usable(site)) {
      alternative_ = site;
      return;
    }
  }
}

std::string Mission::AlternativeWords() const {
  if (!alternative_) {
    return "No alternative is kept.";
  }
  char text[64];
  std::snprintf(text, sizeof text, "Alternative: site %c, %.1f m clear.", alternative_->letter,
                alternative_->safe_distance_m);
  return text;
}

void Mission::RecordRecheck(const MissionInputs& in) {
  const SiteVerdict verdict = site_.VerdictAt(in.now);
  SiteRecheck check;
  check.time = in.now;
  check.height_above_site_m = HeightAboveSite();
  check.safe_distance_m = in.rechecked ? in.rechecked->safe_distance_m : NAN;
  check.holds = site_.newest().holds();
  check.verdict = verdict;
  check.reason = verdict == SiteVerdict::kHolds ? site_.newest().reason : site_.reason();
  check.alternative = alternative_;
  const auto id = [](const SiteRecheck& c) { return c.alternative ? c.alternative->id : 0; };
  auto& all = status_.rechecks;
  if (all.empty() || all.back().holds != check.holds || all.back().verdict != verdict ||
      id(all.back()) != id(check) || SecondsBetween(all.back().time, in.now) >= kRecheckShown_s) {
    all.push_back(std::move(check));
  }
}

bool Mission::SiteLost(Timestamp now) const { return site_.VerdictAt(now) == SiteVerdict::kLost; }

}  // namespace palace
