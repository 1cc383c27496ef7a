#include "engine/mission/recheck.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/mission/geometry.h"
#include "engine/mission/wording.h"
#include "engine/model/approach_side.h"
#include "engine/model/find_site.h"
#include "engine/model/site_standing.h"

namespace palace {
namespace {

constexpr double kRecheckShown_s = 1;

bool SharesGround(const LandingSite& a, const LandingSite& b) {
  return (a.p_WS - b.p_WS).head<2>().norm() <= a.clear_radius_m + b.clear_radius_m;
}

bool IsUsableBeside(const MissionMemory& m, const std::optional<LandingSite>& site,
                    const SladSettings& settings) {
  return site && IsReached(*site) && !m.status.IsRefused(site->id) &&
         !SharesGround(*site, *m.status.armed) && JudgeRecheck(site, {}, {}, settings).holds();
}

/// The best other site there is now. The list is steady (slad/sites/site_registry.h); one that
/// left it, though it still holds, is kept only where no other is.
void FollowAlternative(MissionMemory& m, const MissionInputs& in) {
  const SladSettings& settings = in.limits.settings.slad;
  for (const LandingSite& site : m.facts.sites) {
    if (site.id != m.status.armed->id && IsUsableBeside(m, site, settings)) {
      m.alternative = site;
      return;
    }
  }
  const bool stands = m.alternative && IsUsableBeside(m, in.terrain.alternative, settings);
  m.alternative = stands ? in.terrain.alternative : std::nullopt;
}

/// A re-check is worth a line of its own when it says something new, or after a while.
bool IsNews(const SiteRecheck& last, const SiteRecheck& check) {
  const auto id = [](const SiteRecheck& c) { return c.alternative ? c.alternative->id : 0; };
  return last.holds != check.holds || last.verdict != check.verdict || id(last) != id(check) ||
         SecondsBetween(last.time, check.time) >= kRecheckShown_s;
}

/// The newest always stands, as the limits in force do; a newer one takes its place where it was
/// worth no line of its own.
void AddRecheck(std::vector<SiteRecheck>& rechecks, SiteRecheck check) {
  const std::size_t count = rechecks.size();
  if (count >= 2 && !IsNews(rechecks[count - 2], rechecks.back())) {
    rechecks.back() = std::move(check);
  } else {
    rechecks.push_back(std::move(check));
  }
}

void RecordRecheck(MissionMemory& m, const MissionInputs& in, SiteVerdict verdict) {
  SiteRecheck check;
  check.time = in.session.now;
  check.height_above_site_m = HeightAboveSite(m);
  check.safe_distance_m = in.terrain.rechecked ? in.terrain.rechecked->safe_distance_m : NAN;
  check.holds = m.site.newest().holds();
  check.verdict = verdict;
  check.reason = verdict == SiteVerdict::kHolds ? m.site.newest().reason : m.site.reason();
  check.alternative = m.alternative;
  AddRecheck(m.status.rechecks, std::move(check));
}

/// Before an approval as the list says of the site, which is steady over maps: what is approved as
/// confirmed is so now. After it one map is enough, and none takes it back.
bool IsConfirmed(const MissionMemory& m, const MissionInputs& in) {
  if (m.status.state == MissionState::kArmed) {
    if (const LandingSite* listed = FindSite(m.facts.sites, m.status.armed->id)) {
      return listed->confirmed;
    }
  }
  return m.armed.confirmed || (m.site.newest().holds() && in.terrain.rechecked->confirmed);
}

/// The one frozen figure that a look from higher up makes good: it stands against the approval no
/// more.
void TakeAirSeen(MissionMemory& m, const LandingSite& site) {
  const std::vector<LimitRow> seen = SiteLimits(site, m.facts.site_limits);
  const LimitRow* row = FindLimit(seen, LimitId::kAirSeen);
  for (LimitRow& frozen : m.status.armed_limits) {
    frozen = frozen.id == LimitId::kAirSeen && row != nullptr ? *row : frozen;
  }
}

}  // namespace

void FollowSite(MissionTurn& turn, const MissionInputs& in) {
  MissionMemory& m = turn.memory;
  if (!in.terrain.new_map || !m.status.armed) {
    return;
  }
  const Timestamp now = in.session.now;
  const MissionState state = m.status.state;
  const ApprovedEvidence known{
      m.armed.confirmed, m.status.armed->clearance_m,
      state == MissionState::kApproved || state == MissionState::kDescending};
  SiteFinding finding =
      JudgeRecheck(in.terrain.rechecked, in.terrain.nearest, known, in.limits.settings.slad);
  if (GoesRound(m) && finding.finding == Finding::kDoubtful &&
      finding.reason == finding.old_ground) {
    finding = {Finding::kGood, "", finding.approach_clear, ""};  // it looks away on purpose
  }
  if (in.terrain.rechecked && m.status.approach) {
    m.armed.course_judged = true;
    m.armed.straight_clear =
        m.status.approach->turned() ? m.armed.straight_clear : finding.approach_clear;
  }
  if (!m.armed.air_shown && in.terrain.rechecked && finding.low_air.empty()) {
    m.armed.air_shown = true;
    TakeAirSeen(m, *in.terrain.rechecked);
  }
  m.site.Add(std::move(finding), now);
  m.newest = in.terrain.rechecked;
  if (m.newest && std::isfinite(m.newest->look_height_m)) {
    m.status.look_from_m = LookToldAgain(m.status.look_from_m, m.newest->look_height_m);
  }
  if (in.terrain.rechecked && in.terrain.rechecked->age_s >= 0) {
    m.ground_seen_at = std::max(m.ground_seen_at, AddSeconds(now, -in.terrain.rechecked->age_s));
  }
  const bool confirmed = IsConfirmed(m, in);
  if (confirmed && !m.armed.confirmed) {
    AddEvent(turn, now, EventKind::kSite,
             words::SiteConfirmed(m.status.armed->letter, HeightAboveSite(m)));
  }
  m.armed.confirmed = confirmed;
  FollowAlternative(m, in);
  const SiteVerdict verdict = m.site.VerdictAt(now);
  if (verdict != m.told) {
    AddEvent(turn, now, EventKind::kSite, words::SiteTold(m, verdict));
    m.told = verdict;
  }
  if (state == MissionState::kDescending || state == MissionState::kHold) {
    RecordRecheck(m, in, verdict);
  }
}

}  // namespace palace
