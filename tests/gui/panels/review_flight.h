// A recorded flight for the tests of Review, and what other limits made of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "engine/model/flight_record.h"
#include "gui/app/intent.h"
#include "tests/support/fake_snapshot.h"

namespace palace {
namespace fake {

inline constexpr double kStart_s = static_cast<double>(kNow_us) * 1e-6 - 252;

/// A flight of 338 s, one sample each half second.
inline FlightRecord Record() {
  FlightRecord record;
  record.path = "logs/flight.log";
  record.start_s = kStart_s;
  record.duration_s = 338;
  record.has_settings = true;
  for (int i = 0; i < 676; ++i) {
    FlightRecordSample sample;
    const double t = 0.5 * i;
    sample.time = {static_cast<std::int64_t>((kStart_s + t) * 1e6)};
    sample.state = t < 60    ? MissionState::kSearch
                   : t < 180 ? MissionState::kProposed
                   : t < 220 ? MissionState::kArmed
                             : MissionState::kDescending;
    sample.best_site = t < 20 ? "" : (t < 230 ? "B" : "A");
    sample.best_safe_distance_m = t < 20 ? NAN : 4.6;
    sample.height_above_site_m = t < 220 ? 38 : std::max(0.0, 38 - 0.6 * (t - 220));
    sample.height_m = sample.height_above_site_m;
    record.samples.push_back(sample);
  }
  record.events = Events();
  record.events.push_back({{kNow_us - 60'000'000}, EventKind::kBookmark, "Skid contact"});
  return record;
}

/// What other limits chose, 10 maps a second: A in place of B from 100 s to 130 s and from 212 s to
/// 230 s, A as in the flight until 240 s.
inline std::shared_ptr<const std::vector<RedecidedSample>> Redecided() {
  auto samples = std::make_shared<std::vector<RedecidedSample>>();
  for (int i = 1000; i <= 2400; ++i) {
    if (i > 1300 && i < 2120) {
      continue;  // not judged again
    }
    RedecidedSample sample;
    sample.time = {static_cast<std::int64_t>((kStart_s + 0.1 * i) * 1e6)};
    sample.recorded = i < 2300 ? "B" : "A";
    sample.best_site = "A";
    sample.best_safe_distance_m = 4.1;
    sample.differs = sample.recorded != sample.best_site;
    samples->push_back(sample);
  }
  return samples;
}

/// Its replay where A is armed; `redecided`: judged under a stricter limit of slope, too.
inline EngineSnapshot Replay(bool redecided) {
  EngineSnapshot snap = Snapshot(MissionState::kArmed, SourceKind::kReplay);
  if (redecided) {
    snap.terrain.Edit().recorded = snap.terrain->applied;
    snap.terrain.Edit().redecided = Redecided();
    snap.session.Edit().settings.slad.limits.max_slope_deg =
        snap.session.Edit().preview_settings.slad.limits.max_slope_deg = 6;
    auto applied = std::make_shared<TerrainDecision>(
        *Decision(snap.sensors->X_WC, snap.session->settings.slad, 0x91c07e));
    std::swap(applied->selection.sites[0], applied->selection.sites[1]);
    snap.terrain.Edit().applied = applied;
  }
  return snap;
}

}  // namespace fake

/// What was asked of the source, in order.
inline std::vector<PlaybackControl> Playbacks(const Intents& intents) {
  std::vector<PlaybackControl> found;
  for (const Intent& intent : intents) {
    if (const auto* control = std::get_if<PlaybackControl>(&intent)) {
      found.push_back(*control);
    }
  }
  return found;
}

}  // namespace palace
