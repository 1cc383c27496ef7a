#include "engine/model/mission/mission_status.h"

#include <algorithm>
#include <string_view>

#include "engine/core/check.h"
#include "engine/model/site_standing.h"

namespace palace {
namespace {

struct Names {
  const char* name;
  const char* word;
};

Names NamesOf(MissionState state) {
  switch (state) {
    case MissionState::kNoLive:
      return {"NO_LIVE", "No live pictures"};
    case MissionState::kSearch:
      return {"SEARCH", "Search"};
    case MissionState::kProposed:
      return {"PROPOSED", "Proposed"};
    case MissionState::kArmed:
      return {"ARMED", "Armed"};
    case MissionState::kApproved:
      return {"APPROVED", "Approved"};
    case MissionState::kDescending:
      return {"DESCENDING", "Descending"};
    case MissionState::kHold:
      return {"HOLD", "Hold"};
    case MissionState::kAborting:
      return {"ABORTING", "Wave-off"};
    case MissionState::kLanded:
      return {"LANDED", "Landed"};
  }
  PALACE_CHECK(false);
}

}  // namespace

const char* MissionStateName(MissionState state) { return NamesOf(state).name; }
const char* MissionStateWord(MissionState state) { return NamesOf(state).word; }

bool IsRefusal(const Event& event) {
  return event.kind == EventKind::kDecision && event.text.find(kRefusedMark) != std::string::npos;
}

std::vector<std::string> ActingFaults(const std::vector<Event>& events) {
  std::vector<std::string> acting;
  for (const Event& event : events) {
    if (event.kind != EventKind::kFault) {
      continue;
    }
    if (event.text.starts_with(kFaultBegan)) {
      acting.push_back(event.text.substr(std::string_view(kFaultBegan).size()));
    } else if (event.text.starts_with(kFaultEnded)) {
      std::erase(acting, event.text.substr(std::string_view(kFaultEnded).size()));
    }
  }
  return acting;
}

bool MissionStatus::IsRefused(std::uint64_t site_id) const {
  return std::find(refused_sites.begin(), refused_sites.end(), site_id) != refused_sites.end();
}

const LandingSite* MissionStatus::BestStanding(const std::vector<LandingSite>& sites) const {
  const auto best = std::find_if(sites.begin(), sites.end(),
                                 [&](const LandingSite& site) { return !IsRefused(site.id); });
  return best == sites.end() ? nullptr : &*best;
}

bool MissionStatus::OffersLook() const {
  const bool sure = armed_now && armed_now->confirmed;
  return state == MissionState::kArmed && armed && !sure &&
         height_above_site_m - look_from_m >= kLeastWayToLook_m;
}

bool MissionStatus::TakesSelection(std::uint64_t site_id) const {
  return IsNamedSite(site_id) &&
         (state == MissionState::kProposed || state == MissionState::kArmed ||
          (state == MissionState::kSearch && IsRefused(site_id)));
}

const char* SiteVerdictWord(SiteVerdict verdict) {
  switch (verdict) {
    case SiteVerdict::kHolds:
      return "Holds";
    case SiteVerdict::kDegraded:
      return "Degraded";
    case SiteVerdict::kLost:
      return "Lost";
  }
  PALACE_CHECK(false);
}

}  // namespace palace
