#include "gui/panels/fly_workspace.h"

#include <algorithm>

#include "gui/panels/fly_panels.h"
#include "gui/widgets/imgui_input.h"

namespace palace {

namespace {

/// Tab goes through the candidates, then to the hold button while a site is armed.
void StepFocus(const EngineSnapshot& snap, FlyState& state, int step) {
  const TerrainDecision* shown = ShownDecision(snap);
  const int count = shown != nullptr ? static_cast<int>(shown->selection.sites.size()) : 0;
  const int stops = count + (snap.mission.state == MissionState::kArmed ? 1 : 0);
  if (stops == 0) {
    state.focus = FlyFocus::kNone;
    return;
  }
  int at = step > 0 ? -1 : stops;
  if (state.focus == FlyFocus::kApprove) {
    at = count;
  }
  for (int i = 0; state.focus == FlyFocus::kSites && i < count; ++i) {
    if (shown->selection.sites[static_cast<std::size_t>(i)].id == state.sites.highlighted) {
      at = i;
    }
  }
  at = (at + step + stops) % stops;
  state.focus = at < count ? FlyFocus::kSites : FlyFocus::kApprove;
  state.sites.highlighted =
      at < count ? shown->selection.sites[static_cast<std::size_t>(at)].id : 0;
}

void HandleKeys(const EngineSnapshot& snap, FlyState& state, UiFrame& ui) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || ui.blocked_by_popup) {
    return;
  }
  if (KeyPressed(ImGuiKey_Tab, true)) {
    StepFocus(snap, state, io.KeyShift ? -1 : 1);
  }
  if (io.MouseClicked[0]) {
    state.focus = FlyFocus::kNone;  // the ring is for the keyboard only
  }
  if (state.focus == FlyFocus::kSites && state.sites.highlighted != 0 &&
      MaySelect(snap, state.sites.highlighted) && KeyPressed(ImGuiKey_Enter, false)) {
    ui.intents.push_back(CommandAction(SelectSite{state.sites.highlighted}));
  }
}

void DrawLowerLeft(const EngineSnapshot& snap, const FlyLayout& layout, FlyState& state,
                   UiFrame& ui) {
  const std::uint64_t highlighted = state.sites.highlighted;
  if (!layout.descent) {
    DrawMapRowPanel(snap, layout.maps, layout.map_side, highlighted, !layout.narrow, state.maps,
                    ui);
    if (layout.channels.h > 0) {
      DrawChannelStripPanel(snap, layout.channels, ui);
    }
    return;
  }
  DrawPlotTabs(snap, layout.plot_tabs, state.tab, ui);
  if (state.tab == PlotTab::kMaps) {
    DrawMapRowPanel(snap, layout.tabbed_maps, layout.tabbed_map_side, highlighted, !layout.narrow,
                    state.maps, ui);
  } else {
    DrawDescentPlotsPanel(snap, layout.plots, state.plots, ui);
  }
}

}  // namespace

bool ShowsDescent(const EngineSnapshot& snap) { return IsDescentView(snap); }

void DrawFlyWorkspace(const EngineSnapshot& snap, const FlyLayout& layout, FlyState& state,
                      UiFrame& ui) {
  HandleKeys(snap, state, ui);
  const std::uint64_t highlighted = state.sites.highlighted;
  BeginProbe(state.maps.probe);
  DrawLeftCameraPanel(snap, layout.left_camera, state.camera, state.maps.probe, highlighted, ui);
  DrawRightCameraPanel(snap, layout.right_camera, state.maps.probe, ui);
  DrawVehiclePanel(snap, layout.vehicle, layout.narrow, ui);
  DrawView3dPanel(snap, layout.view_3d, state.view, ui);
  DrawLowerLeft(snap, layout, state, ui);
  if (layout.descent) {
    DrawSiteRecheckPanel(snap, layout.recheck, layout.narrow, state.maps.probe, ui);
    DrawLimitsInForcePanel(snap, layout.limits, layout.narrow, ui);
    if (layout.tracker.h > 0) {
      DrawTrackerPanel(snap, layout.tracker, ui);
    }
    DrawLandingPanel(snap, layout.landing, ui);
    DrawProbeWhy(ui, layout.frame.body, ShownDecision(snap), state.maps.probe, snap.time);
    return;
  }
  DrawSiteListPanel(snap, layout, state.sites, ui);
  DrawEvidencePanel(snap, layout.evidence, layout.folded_evidence, layout.narrow, highlighted, ui);
  const MissionState mission = snap.mission.state;
  if (mission == MissionState::kApproved || mission == MissionState::kAborting ||
      mission == MissionState::kHold) {
    DrawLandingPanel(snap, layout.approve, ui);
  } else {
    DrawApprovePanel(snap, layout.approve, layout.narrow, state.focus == FlyFocus::kApprove,
                     state.approve, ui);
  }
  DrawProbeWhy(ui, layout.frame.body, ShownDecision(snap), state.maps.probe, snap.time);
}

}  // namespace palace
