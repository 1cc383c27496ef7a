#include "gui/panels/fly_workspace.h"

#include "gui/panels/fly_panels.h"
#include "gui/widgets/button.h"

namespace palace {

namespace {

/// Once a site is armed, the keyboard's next step is the hold button: with the ring when the
/// keyboard armed it, else at the next Tab.
void FollowArming(const EngineSnapshot& snap, ApproveState& state, UiFrame& ui) {
  const std::uint64_t armed = snap.flight->mission.armed ? snap.flight->mission.armed->id : 0;
  if (armed == state.armed) {
    return;
  }
  state.armed = armed;
  // The list covers the evidence, which has to be seen, and comes not back after a flight.
  state.show_guards = false;
  if (armed == 0) {
    return;
  }
  if (ui.focus.shown().substr(0, 5) == "site/") {
    ui.focus.Show("approve");
  } else {
    ui.focus.TabLandsOn("approve");
  }
}

void DrawLowerLeft(const EngineSnapshot& snap, const FlyLayout& layout, FlyState& state,
                   UiFrame& ui) {
  if (!layout.descent) {
    DrawMapRowPanel(snap, layout.maps, layout.map_side, !layout.narrow, state.maps, ui);
    if (layout.channels.h > 0) {
      DrawChannelStripPanel(snap, layout.channels, ui);
    }
    return;
  }
  DrawPlotTabs(snap, layout.plot_tabs, state.tab, ui);
  if (state.tab != PlotTab::kMaps) {
    state.maps.asked.reset();  // a question about a map that is not shown
  }
  if (state.tab == PlotTab::kMaps) {
    DrawMapRowPanel(snap, layout.tabbed_maps, layout.tabbed_map_side, !layout.narrow, state.maps,
                    ui);
  } else {
    DrawDescentPlotsPanel(snap, layout.plots, state.plots, ui);
  }
}

void DrawDecisionColumn(const EngineSnapshot& snap, const FlyLayout& layout, FlyState& state,
                        UiFrame& ui) {
  DrawSiteListPanel(snap, layout, state.sites, ui);
  DrawEvidencePanel(snap, layout.evidence, layout.folded_evidence, layout.narrow,
                    ui.highlighted_site, state.evidence, ui);
  const MissionState mission = snap.flight->mission.state;
  if (mission == MissionState::kApproved || mission == MissionState::kAborting ||
      mission == MissionState::kHold) {
    DrawLandingPanel(snap, layout.approve, ui);
  } else {
    DrawApprovePanel(snap, layout.approve, layout.narrow, state.maps.probe.pinned, state.approve,
                     ui);
  }
}

void DrawDescentColumn(const EngineSnapshot& snap, const FlyLayout& layout, FlyState& state,
                       UiFrame& ui) {
  const bool held = snap.flight->mission.state == MissionState::kHold;
  DrawSiteRecheckPanel(snap, held ? layout.held_recheck : layout.recheck, layout.narrow,
                       state.maps.probe, ui);
  DrawLimitsInForcePanel(snap, held ? layout.held_limits : layout.limits, layout.narrow,
                         state.limits, ui);
  if (held) {
    DrawLandingPanel(snap, layout.approve, ui);
    return;
  }
  if (layout.tracker.h > 0) {
    DrawTrackerPanel(snap, layout.tracker, state.tracker, ui);
  }
  if (snap.flight->mission.state == MissionState::kLanded) {
    DrawLandedPanel(snap, layout.landing, ui);
  } else {
    DrawLandingPanel(snap, layout.landing, ui);
  }
}

}  // namespace

namespace {

/// The 3-D view or, before a descent, the search map where it was asked for: "show_search_map" and
/// "show_3d_view" in the panel's head change them.
void DrawGroundAround(const EngineSnapshot& snap, const FlyLayout& layout, SearchMapState& state,
                      UiFrame& ui) {
  const Style& s = ui.style;
  const Rect& panel = layout.view_3d;
  const bool map = state.shown && !layout.descent;
  if (map) {
    DrawSearchMapPanel(snap, panel, state, ui);
  } else {
    DrawView3dPanel(snap, panel, ui);
  }
  if (layout.descent) {
    return;
  }
  const char* other = map ? "3-D view" : "Search map";
  const float x = panel.x + s.Px(18) + TextWidth(s.medium, map ? "Search map" : "3-D view");
  ButtonLook look;
  look.font = s.caption;
  look.flat = true;
  const Rect rect{x, panel.y + s.Px(3), TextWidth(s.caption, other) + s.Px(12), s.Px(22)};
  if (DrawButton(ui, map ? "show_3d_view" : "show_search_map", rect, other, look)) {
    state.shown = !map;
  }
}

/// A pin lies where other panels come up with the next state.
void ForgetPin(const EngineSnapshot& snap, FlyState& state) {
  const MissionState now = snap.flight->mission.state;
  if (now != state.shown_state) {
    state.maps.probe.pinned.reset();
    state.maps.asked.reset();
  }
  state.shown_state = now;
}

}  // namespace

bool ShowsDescent(const EngineSnapshot& snap) { return IsDescentView(snap); }

void DrawFlyWorkspace(const EngineSnapshot& snap, const FlyLayout& layout, FlyState& state,
                      UiFrame& ui) {
  FollowArming(snap, state.approve, ui);
  ForgetPin(snap, state);
  FollowArea(snap.flight->mission, state.search_map);
  BeginProbe(state.maps.probe);
  ui.tab.group = kViewTabs;
  DrawLeftCameraPanel(snap, layout.left_camera, state.camera, state.maps.probe, ui);
  DrawRightCameraPanel(snap, layout.right_camera, state.maps.probe, ui);
  DrawVehiclePanel(snap, layout.vehicle, layout.narrow, ui);
  DrawGroundAround(snap, layout, state.search_map, ui);
  DrawLowerLeft(snap, layout, state, ui);
  ui.tab.group = kDecisionTabs;
  if (layout.descent) {
    DrawDescentColumn(snap, layout, state, ui);
  } else {
    DrawDecisionColumn(snap, layout, state, ui);
  }
  DrawTickQuestion(snap, layout.frame.body, state.maps, ui);
  DrawProbeWhy(ui, layout.frame.body, snap.terrain->Shown(), state.maps.probe, snap.time);
}

}  // namespace palace
