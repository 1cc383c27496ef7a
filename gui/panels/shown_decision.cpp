#include "gui/panels/fly_panels.h"

namespace palace {

const TerrainDecision* ShownDecision(const EngineSnapshot& snap) {
  return snap.terrain->preview ? snap.terrain->preview.get() : snap.terrain->applied.get();
}

const LandingSite* SiteInView(const EngineSnapshot& snap, std::uint64_t highlighted) {
  if (snap.flight->mission.armed) {
    return &*snap.flight->mission.armed;
  }
  const TerrainDecision* shown = ShownDecision(snap);
  if (shown == nullptr || shown->selection.sites.empty()) {
    return nullptr;
  }
  for (const LandingSite& site : shown->selection.sites) {
    if (site.id == highlighted) {
      return &site;
    }
  }
  return snap.flight->mission.BestStanding(shown->selection.sites);
}

bool MaySelect(const EngineSnapshot& snap, std::uint64_t site_id) {
  return snap.flight->mission.state == MissionState::kProposed ||
         snap.flight->mission.state == MissionState::kArmed ||
         (snap.flight->mission.state == MissionState::kSearch &&
          snap.flight->mission.IsRefused(site_id));
}

bool IsDescentView(const EngineSnapshot& snap) {
  switch (snap.flight->mission.state) {
    case MissionState::kDescending:
    case MissionState::kLanded:
      return true;
    case MissionState::kHold:
    case MissionState::kAborting:
      return snap.flight->mission.armed.has_value();
    default:
      return false;
  }
}

MapMarks MarksOf(const EngineSnapshot& snap, std::uint64_t highlighted) {
  MapMarks marks;
  const TerrainDecision* shown = ShownDecision(snap);
  marks.sites = shown != nullptr ? &shown->selection.sites : nullptr;
  if (const LandingSite* site = SiteInView(snap, 0)) {
    marks.selected = *site;
  }
  marks.highlighted = highlighted;
  marks.commanded = snap.flight->mission.state >= MissionState::kApproved;
  const auto camera = LeftCamera(snap);
  if (camera && marks.selected) {
    marks.footprint = GroundFootprint(*camera, snap.sensors->X_WC, marks.selected->height_m.value);
  }
  return marks;
}

}  // namespace palace
