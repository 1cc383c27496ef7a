#include "gui/panels/fly_panels.h"

namespace palace {

const LandingSite* SiteInView(const EngineSnapshot& snap, std::uint64_t highlighted) {
  if (snap.flight->mission.armed) {
    return &*snap.flight->mission.armed;
  }
  const TerrainDecision* shown = snap.terrain->Shown();
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
  const TerrainDecision* shown = snap.terrain->Shown();
  marks.sites = shown != nullptr ? &shown->selection.sites : nullptr;
  marks.mission = &snap.flight->mission;
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
