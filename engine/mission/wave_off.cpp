#include "engine/mission/wave_off.h"

#include "engine/core/text.h"
#include "engine/mission/geometry.h"
#include "engine/mission/limits.h"
#include "engine/model/mission/landed_place.h"

namespace palace {
namespace {

constexpr double kAbortSettles_s = 2;  // a hover reported sooner may be the one before the abort

constexpr double kHangs_m = 1;  // above the site: no ground that was approved

constexpr double kClimbs_mps = 0.25;  // a hover drifts by less, in gusts too

bool IsStill(VehicleMode mode) {
  return mode == VehicleMode::kHover || mode == VehicleMode::kLanded;
}

/// It said so, however long ago.
bool SaidThatItIsDone(const MissionMemory& m, Timestamp now) {
  const auto& vehicle = m.watch.vehicle();
  const double settled_s = SecondsBetween(m.status.since, now) - m.watch.LinkAge(now);
  return m.abort_seen && vehicle && IsStill(vehicle->mode) && HeardSinceWaveOff(m, now) &&
         settled_s >= kAbortSettles_s;
}

}  // namespace

std::string WhyNoWaveOff(const MissionMemory& m, Timestamp now) {
  const auto& vehicle = m.watch.vehicle();
  const double heard_s = m.watch.LinkAge(now);
  // What was caught in a wire says that it stands, too.
  const bool hangs = MissedSite(m.status) && HeightAboveSite(m) > kHangs_m;
  const bool stands =
      vehicle && vehicle->on_ground && vehicle->mode == VehicleMode::kLanded && !hangs;
  return stands && heard_s <= GuardLimits::link_s ? "Vehicle on the ground" : std::string();
}

bool HeardSinceWaveOff(const MissionMemory& m, Timestamp now) {
  return m.watch.LinkAge(now) < SecondsBetween(m.wave_off_at, now);
}

bool WaveOffIsOver(const MissionMemory& m, Timestamp now) {
  return !m.vehicle_ever_heard ||  // nobody there: nothing to wait for
         (SaidThatItIsDone(m, now) && m.watch.LinkAge(now) <= GuardLimits::link_s);
}

WaveOffReport WaveOffNow(const MissionMemory& m, Timestamp now) {
  using Phase = WaveOffReport::Phase;
  if (m.status.state != MissionState::kAborting) {
    return {};
  }
  const double heard_s = m.watch.LinkAge(now);
  const bool over = WaveOffIsOver(m, now);
  if (SaidThatItIsDone(m, now)) {
    return {m.watch.vehicle()->on_ground ? Phase::kStands : Phase::kDone, heard_s, over};
  }
  // A hover that was reported since is believed a little later: until then it is under way.
  if (HeardSinceWaveOff(m, now) && m.abort_seen) {
    return {m.watch.climb_mps() > kClimbs_mps ? Phase::kClimbs : Phase::kFlies, heard_s};
  }
  if (m.abort_answered_at > m.wave_off_at) {
    return {Phase::kAccepted, SecondsBetween(m.abort_answered_at, now)};
  }
  const double waited_s = SecondsBetween(m.wave_off_at, now);
  return {waited_s <= GuardLimits::link_s ? Phase::kSent : Phase::kUnanswered, waited_s, over};
}

}  // namespace palace
