#include "engine/model/find_site.h"
#include "gui/panels/fly_panels.h"

namespace palace {

const TerrainDecision* SitesInForce(const EngineSnapshot& snap) {
  return snap.terrain->applied.get();
}

const LandingSite* SiteInView(const EngineSnapshot& snap, std::uint64_t highlighted) {
  if (snap.flight->mission.armed) {
    return &*snap.flight->mission.armed;
  }
  const TerrainDecision* known = SitesInForce(snap);
  if (known == nullptr || known->selection.sites.empty()) {
    return nullptr;
  }
  if (const LandingSite* site = FindSite(known, highlighted)) {
    return site;
  }
  return snap.flight->mission.state == MissionState::kAborting
             ? nullptr
             : snap.flight->mission.BestStanding(known->selection.sites);
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

const EngineSnapshot& AsFlown(const EngineSnapshot& snap, std::optional<EngineSnapshot>& kept) {
  if (!snap.terrain->preview || !IsDescentView(snap)) {
    return snap;
  }
  kept = snap;
  kept->terrain.Edit().preview.reset();
  return *kept;
}

bool IsCommanded(const MissionStatus& mission) {
  return mission.armed && mission.state >= MissionState::kApproved;
}

MapMarks MarksOf(const EngineSnapshot& snap, std::uint64_t highlighted) {
  MapMarks marks;
  const TerrainDecision* known = SitesInForce(snap);
  marks.sites = known != nullptr ? &known->selection.sites : nullptr;
  marks.mission = &snap.flight->mission;
  if (const LandingSite* site = SiteInView(snap, 0)) {
    marks.selected = *site;
  }
  marks.highlighted = highlighted;
  marks.commanded = IsCommanded(snap.flight->mission);
  const auto camera = LeftCamera(snap);
  if (camera && marks.selected) {
    marks.footprint = GroundFootprint(*camera, snap.sensors->X_WC, marks.selected->height_m.value);
  }
  return marks;
}

}  // namespace palace
