// What may be changed while it flies: wind, cameras, their rate. The screen tells what is in force.
#include <cmath>

#include "gui/panels/simulate/simulate.h"

namespace palace {
namespace {

/// Of the newest bundle: its rig's own numbers.
SimulationSetup InForce(const EngineSnapshot& snap) {
  SimulationSetup setup = snap.session->source.simulation->in_force;
  if (snap.sensors->rig) {
    ReadRig(*snap.sensors->rig, setup);
  }
  return setup;
}

/// As a reader sees them: what differs in no digit shown is the same.
bool LookAlike(const SettingInfo& info, double a, double b) {
  return FormatSetting(info, a) == FormatSetting(info, b);
}

void DrawHeld(const Rect& box, const SettingInfo& info, double value, const std::string& why,
              UiFrame& ui) {
  const Style& s = ui.style;
  const float y = box.centre().y;
  DrawText(ui, s.body, s.palette.text3, box.x + s.Px(16), y, info.label);
  DrawText(ui, s.medium, s.palette.text1, box.right() - s.Px(40), y, FormatSetting(info, value),
           Align::kRight);
  ui.items.Add("limit/" + info.name, box, false, why);
}

}  // namespace

void DrawSimulationChanges(const EngineSnapshot& snap, const Rect& rect, SimulateState& state,
                           UiFrame& ui) {
  const Style& s = ui.style;
  const SimulationStatus& simulation = *snap.session->source.simulation;
  const SimulationSetup in_force = InForce(snap);
  const std::string held = WhyRigStays(snap.flight->mission.state);
  bool waits = false;
  for (const SimulationRow& row : SimulationTable()) {
    waits = waits || !LookAlike(row.info, in_force.*row.field, simulation.asked.*row.field);
  }
  const Rect content =
      DrawPanelFrame(ui, rect, "Wind and cameras",
                     {{waits ? "From the next pictures on" : "In force", 0, waits, false}});
  const float row_h = s.Px(36);
  float y = content.y + s.Px(2);
  ui.tab.list = "simulation";
  for (const SimulationRow& row : SimulationTable()) {
    SettingInfo info = row.info;
    info.default_value = simulation.began.*row.field;
    const double now = in_force.*row.field, asked = simulation.asked.*row.field;
    const Rect box{content.x, y, content.w, row_h};
    y += row_h;
    const std::string of_lens =
        snap.sensors->rig ? WhyLensStays(*snap.sensors->rig, info.name) : std::string();
    if (!of_lens.empty() || (row.of_rig && !held.empty())) {
      DrawHeld(box, info, now, of_lens.empty() ? held : of_lens, ui);
      continue;
    }
    SliderRow slider{&info, LookAlike(info, now, asked) ? now : asked};
    slider.pending = !LookAlike(info, now, asked);
    slider.note = slider.pending ? "now " + FormatSetting(info, now) : std::string();
    slider.ask = [&](double value) { ui.intents.push_back(SimulationChange{info.name, value}); };
    if (LookAlike(info, slider.value, info.default_value)) {
      slider.value = info.default_value;  // no change but in digits that nobody sees
    }
    DrawSliderRow(ui, box, slider, snap.session->settings, state.sliders);
    ui.items.Add("in_force/" + info.name, box, true, FormatSetting(info, now));
  }
  ui.tab.list = {};
  const std::string words =
      held.empty() ? "Another field of view, baseline or tilt: the map begins anew" : held;
  y += s.Px(12);
  for (const std::string& line : WrapText(s.caption, words, content.w - s.Px(28))) {
    DrawText(ui, s.caption, held.empty() ? s.palette.text3 : s.palette.text1, content.x + s.Px(16),
             y, line);
    y += s.Px(17);
  }
}

}  // namespace palace
