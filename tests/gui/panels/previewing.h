// A preview on screen, and the limits that were moved to it.
#pragma once

#include <memory>
#include <utility>

#include "gui/panels/tune/tune.h"
#include "tests/support/fake_snapshot.h"

namespace palace {

/// A snapshot with a preview: slope 6° instead of 10°, another best site.
inline EngineSnapshot Previewing(MissionState state) {
  EngineSnapshot snap = fake::Snapshot(state, SourceKind::kSimulation);
  snap.session.Edit().preview_settings.slad.limits.max_slope_deg = 6;
  snap.session.Edit().preview_settings.slad.limits.max_deviation_m = 0.06;
  snap.session.Edit().preview_settings.slad.fusion.frames_fused = 24;
  snap.session.Edit().preview_hash = 0x91c07e0000000000;
  auto preview = std::make_shared<TerrainDecision>(*fake::Decision(
      snap.sensors->X_WC, snap.session->preview_settings.slad, snap.session->preview_hash));
  std::swap(preview->selection.sites[0], preview->selection.sites[1]);
  snap.terrain.Edit().preview = preview;
  return snap;
}

inline void MoveTwoLimits(SettingHistory& history) {
  const EngineSnapshot before = fake::Snapshot(MissionState::kProposed);
  history.Remember(CommandAction(SetSetting{"slad.max_slope_deg", 6}), before, {});
  history.Remember(CommandAction(SetSetting{"slad.max_deviation_m", 0.06}), before, {});
}

}  // namespace palace
