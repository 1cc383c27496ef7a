#include "gui/panels/fly_panels.h"
#include "gui/widgets/number_text.h"

namespace palace {

const TerrainDecision* ShownDecision(const EngineSnapshot& snap) {
  return snap.preview ? snap.preview.get() : snap.applied.get();
}

const LandingSite* SiteInView(const EngineSnapshot& snap, std::uint64_t highlighted) {
  if (snap.mission.armed) {
    return &*snap.mission.armed;
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
  return snap.mission.BestStanding(shown->selection.sites);
}

bool MaySelect(const EngineSnapshot& snap, std::uint64_t site_id) {
  return snap.mission.state == MissionState::kProposed ||
         snap.mission.state == MissionState::kArmed ||
         (snap.mission.state == MissionState::kSearch && snap.mission.IsRefused(site_id));
}

bool IsDescentView(const EngineSnapshot& snap) {
  switch (snap.mission.state) {
    case MissionState::kDescending:
    case MissionState::kLanded:
      return true;
    case MissionState::kHold:
    case MissionState::kAborting:
      return snap.mission.armed.has_value();
    default:
      return false;
  }
}

const ChannelHealth* FindChannel(const EngineSnapshot& snap, std::string_view name) {
  for (const ChannelHealth& channel : snap.channels) {
    if (channel.name == name) {
      return &channel;
    }
  }
  return nullptr;
}

MapMarks MarksOf(const EngineSnapshot& snap, std::uint64_t highlighted) {
  MapMarks marks;
  const TerrainDecision* shown = ShownDecision(snap);
  marks.sites = shown != nullptr ? &shown->selection.sites : nullptr;
  if (const LandingSite* site = SiteInView(snap, 0)) {
    marks.selected = *site;
  }
  marks.highlighted = highlighted;
  marks.commanded = snap.mission.state >= MissionState::kApproved;
  const auto camera = LeftCamera(snap);
  if (camera && marks.selected) {
    marks.footprint = GroundFootprint(*camera, snap.X_WC, marks.selected->height_m.value);
  }
  return marks;
}

MapView SafeDistanceMap(const EngineSnapshot& snap, const UiFrame& ui) {
  MapView view;
  view.key = "safe_distance";
  view.title = "Safe distance";
  view.texture = ui.textures.maps[4];
  view.ramp = Ramp::kSafeDistance;
  view.preview = snap.preview != nullptr;
  const TerrainDecision* shown = ShownDecision(snap);
  if (shown == nullptr || !shown->hazards) {
    return view;
  }
  view.geometry = shown->hazards->geometry;
  view.values = &shown->hazards->safe_distance_m;
  view.flags = &shown->hazards->flags;
  const double clear_m = shown->settings.lander.clear_radius_m();
  view.low = "0 m";
  view.high = Fixed(2.5 * clear_m, 1) + " m";
  view.limit.label = "min " + Fixed(clear_m, 1) + " m";
  view.limit.at = 0.4f;
  view.limit.setting = "slad.nav_error_m";
  view.limit.value = snap.preview_settings.slad.lander.nav_error_m;
  view.limit.per_bar = 2.5 * clear_m;
  return view;
}

}  // namespace palace
