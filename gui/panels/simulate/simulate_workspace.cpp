// The workspace as a whole: its rectangles and its panels.
#include <algorithm>
#include <cmath>

#include "gui/panels/fly_layout.h"
#include "gui/panels/simulate/simulate.h"
#include "gui/widgets/button.h"

namespace palace {
namespace {

constexpr float kGap = 8, kTime = 178, kChanges = 284, kFlight = 280, kTabs = 36;

/// Which of those that share a place in a low window is shown.
void DrawTabs(const Rect& row, SimulateState& state, UiFrame& ui) {
  const Style& s = ui.style;
  DrawPanelBackground(ui, row, "Simulate tabs");
  const float pad = s.Px(4), w = std::floor((row.w - 4 * pad) / 3);
  float x = row.x + pad;
  const auto tab = [&](const char* name, const char* label, SimulateTab which) {
    ButtonLook look;
    look.active = state.tab == which;
    if (DrawButton(ui, name, {x, row.y + pad, w, row.h - 2 * pad}, label, look)) {
      state.tab = which;
    }
    x += w + pad;
  };
  tab("sim/tab/changes", "Changes", SimulateTab::kChanges);
  tab("sim/tab/flight", "New flight", SimulateTab::kFlight);
  tab("sim/tab/faults", "Faults", SimulateTab::kFaults);
}

Rect Spanning(const Rect& top, const Rect& bottom) {
  return {top.x, top.y, top.w, bottom.bottom() - top.y};
}

/// The list of kinds takes the place of what lies below the changes.
void DrawFlightAndFaults(const EngineSnapshot& snap, const SimulateLayout& layout,
                         SimulateState& state, UiFrame& ui) {
  const bool folded = layout.folded;
  const bool flight = !folded || state.tab == SimulateTab::kFlight;
  const bool faults = !folded || state.tab == SimulateTab::kFaults;
  if (faults && state.choosing_fault) {
    DrawFaultChoice(folded ? layout.faults : Spanning(layout.flight, layout.faults), state, ui);
    return;
  }
  if (flight) {
    DrawNextFlight(snap, layout.flight, state, ui);
  }
  if (faults) {
    DrawFaults(snap, layout.faults, state, ui);
  }
}

}  // namespace

bool IsSimulation(const EngineSnapshot& snap) {
  return snap.session->source.kind == SourceKind::kSimulation &&
         snap.session->source.simulation.has_value();
}

SimulateLayout LaySimulate(const Rect& body, const Style& s) {
  SimulateLayout layout;
  const float gap = s.Px(kGap);
  const float controls_w = s.Px(IsNarrowBody(body, s) ? 344 : 416);
  layout.folded = body.h < s.Px(kTime + kChanges + kFlight + 3 * kGap + 150);
  layout.time = {body.x, body.y, controls_w, s.Px(kTime)};
  const float below = layout.time.bottom() + gap;
  if (layout.folded) {
    const float y = below + s.Px(kTabs) + gap;
    layout.changes = layout.flight = layout.faults = {body.x, y, controls_w, body.bottom() - y};
  } else {
    layout.changes = {body.x, below, controls_w, s.Px(kChanges)};
    layout.flight = {body.x, layout.changes.bottom() + gap, controls_w, s.Px(kFlight)};
    const float y = layout.flight.bottom() + gap;
    layout.faults = {body.x, y, controls_w, body.bottom() - y};
  }
  // Three pictures of 4:3 below each other fill the height; the main view has the rest.
  const float small_h = std::floor((body.h - 2 * gap) / 3);
  const float small_w = std::min(std::round((small_h - s.Px(28)) * 4 / 3), body.w / 4);
  const float main_x = body.x + controls_w + gap;
  const float small_x = body.right() - small_w;
  layout.eyes[0] = {main_x, body.y, small_x - gap - main_x, body.h};
  for (std::size_t i = 1; i < layout.eyes.size(); ++i) {
    const float y = body.y + static_cast<float>(i - 1) * (small_h + gap);
    layout.eyes[i] = {small_x, y, small_w, i == 3 ? body.bottom() - y : small_h};
  }
  return layout;
}

void DrawSimulateWorkspace(const EngineSnapshot& snap, const Rect& body, SimulateState& state,
                           UiFrame& ui) {
  const Style& s = ui.style;
  if (!IsSimulation(snap)) {
    const Rect content = DrawPanelFrame(ui, body, "Simulate");
    DrawText(ui, s.section, s.palette.text1, content.centre().x, content.centre().y,
             "Only the built-in simulation can be looked at from outside and changed.",
             Align::kCentre);
    return;
  }
  const SimulateLayout layout = LaySimulate(body, s);
  ui.tab.group = kViewTabs;
  DrawWorldViews(snap, layout, state, ui);
  ui.tab.group = kDecisionTabs;
  DrawSimulatedTime(snap, layout.time, state, ui);
  if (layout.folded) {
    DrawTabs({layout.time.x, layout.time.bottom() + s.Px(kGap), layout.time.w, s.Px(kTabs)}, state,
             ui);
  }
  if (!layout.folded || state.tab == SimulateTab::kChanges) {
    DrawSimulationChanges(snap, layout.changes, state, ui);
  }
  DrawFlightAndFaults(snap, layout, state, ui);
}

}  // namespace palace
