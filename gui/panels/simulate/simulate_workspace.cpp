// The workspace as a whole: its rectangles and its panels.
#include <algorithm>
#include <cmath>

#include "gui/panels/fly_layout.h"
#include "gui/panels/simulate/simulate.h"
#include "gui/widgets/button.h"

namespace palace {
namespace {

constexpr float kGap = 8, kTime = 178, kChanges = 292, kTabs = 36;

/// Which of the two that share a place in a low window is shown.
void DrawTabs(const Rect& row, SimulateState& state, UiFrame& ui) {
  const Style& s = ui.style;
  DrawPanelBackground(ui, row, "Simulate tabs");
  const float pad = s.Px(4), w = (row.w - 3 * pad) / 2;
  const auto tab = [&](const char* name, const char* label, float x, bool choosing) {
    ButtonLook look;
    look.active = state.choosing == choosing;
    if (DrawButton(ui, name, {x, row.y + pad, w, row.h - 2 * pad}, label, look)) {
      state.choosing = choosing;
    }
  };
  tab("sim/tab/changes", "Wind and cameras", row.x + pad, false);
  tab("sim/tab/flight", "New flight", row.x + w + 2 * pad, true);
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
  layout.folded = body.h < s.Px(820);
  layout.time = {body.x, body.y, controls_w, s.Px(kTime)};
  const float below = layout.time.bottom() + gap;
  if (layout.folded) {
    const float y = below + s.Px(kTabs) + gap;
    layout.changes = layout.flight = {body.x, y, controls_w, body.bottom() - y};
  } else {
    layout.changes = {body.x, below, controls_w, s.Px(kChanges)};
    const float y = layout.changes.bottom() + gap;
    layout.flight = {body.x, y, controls_w, body.bottom() - y};
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
  if (!layout.folded || !state.choosing) {
    DrawSimulationChanges(snap, layout.changes, state, ui);
  }
  if (!layout.folded || state.choosing) {
    DrawNextFlight(snap, layout.flight, state, ui);
  }
}

}  // namespace palace
