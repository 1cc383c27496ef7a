#include "engine/mission/mission_memory.h"

#include "engine/mission/limits.h"
#include "engine/mission/wording.h"

namespace palace {
MissionMemory::MissionMemory() {
  status.why = words::kNoDataYet;
  status.confirm_height_m = GuardLimits::confirm_height_m;
  status.height_above_site_m = status.distance_to_site_m = status.time_to_touchdown_s = NAN;
}

bool WinnerStands(const MissionMemory& m, Timestamp now) {
  return m.winner.site_id != 0 && m.winner.maps >= m.facts.settings.mission.propose_after_maps &&
         SecondsBetween(m.winner.since, now) >= m.facts.settings.mission.propose_after_s &&
         SecondsBetween(m.map_seen_at, now) <= GuardLimits::map_s;
}

bool SiteLost(const MissionMemory& m, Timestamp now) {
  return m.site.VerdictAt(now) == SiteVerdict::kLost;
}

bool Executing(const MissionMemory& m) {
  const auto& vehicle = m.watch.vehicle();
  if (!vehicle || vehicle->approval_id == 0) {
    return false;
  }
  const VehicleMode mode = vehicle->mode;
  return mode == VehicleMode::kAlign || mode == VehicleMode::kDescend ||
         mode == VehicleMode::kSettle || mode == VehicleMode::kSink;
}

bool IsSameMessage(const MissionMemory& m, std::uint64_t id, std::uint64_t own) {
  // A log carries its own session part, and after a seek its numbers run ahead of ours. What stays
  // is the kind.
  const bool same_kind = ((id ^ own) & kRequestBit) == 0;
  return own != 0 && id != 0 && (id == own || (FollowsRecord(m.facts.role) && same_kind));
}

bool IsOwnApproval(const MissionMemory& m, std::uint64_t id) {
  return m.status.approval && IsSameMessage(m, id, m.status.approval->id);
}

bool FliesForeignApproval(const MissionMemory& m) {
  return Executing(m) && !IsOwnApproval(m, m.watch.vehicle()->approval_id);
}

const char* WhyViewOnly(const MissionFacts& facts) {
  // Without a link that could tell, G10 speaks.
  const bool told = facts.authority.standing != AuthorityStanding::kNone;
  return HasVehicle(facts.role) && told && !facts.authority.commands()
             ? facts.authority.why_not.c_str()
             : nullptr;
}

bool WatchesSite(const MissionMemory& m) {
  const MissionState state = m.status.state;
  return m.status.armed.has_value() &&
         (state == MissionState::kArmed || IsFlying(state) || state == MissionState::kHold);
}

}  // namespace palace
