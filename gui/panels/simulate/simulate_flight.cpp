// The next flight: its world, seed and vehicle.
#include <algorithm>
#include <cmath>

#include "gui/panels/simulate/simulate.h"
#include "gui/widgets/button.h"

namespace palace {
namespace {

constexpr double kMostSeed = 999'999;

/// "yard" of "config/worlds/yard.toml".
std::string ShortName(const std::string& name) {
  const std::string file = name.substr(name.find_last_of('/') + 1);
  return file.substr(0, file.find(".toml"));
}

/// A grid of names, one of them chosen; returns where it ends.
float DrawChoice(const Rect& area, const char* kind, const std::vector<std::string>& names,
                 int columns, std::string& chosen, UiFrame& ui) {
  const Style& s = ui.style;
  const float gap = s.Px(4), h = s.Px(24);
  const float w =
      std::floor((area.w - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto column = static_cast<float>(i % static_cast<std::size_t>(columns));
    const auto row = static_cast<float>(i / static_cast<std::size_t>(columns));
    ButtonLook look;
    look.font = s.caption;
    look.active = chosen == names[i];
    const std::string label = ShortName(names[i]);
    const bool fits = TextWidth(s.caption, label) <= w - s.Px(2);
    look.hint = fits ? std::string_view() : std::string_view(names[i]);
    const Rect box{area.x + column * (w + gap), area.y + row * (h + gap), w, h};
    if (DrawButton(ui, std::string(kind) + "/" + label, box, fits ? label : "Own file", look)) {
      chosen = names[i];
    }
  }
  const std::size_t rows =
      (names.size() + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
  return area.y + static_cast<float>(rows) * (h + gap);
}

void DrawSeed(const Rect& row, const EngineSnapshot& snap, SimulateState& state, UiFrame& ui) {
  const Style& s = ui.style;
  SettingInfo info;
  info.name = "simulation.seed";
  info.label = "Seed";
  info.decimals = 0;
  info.integer = true;
  info.max = info.soft_max = kMostSeed;
  const auto seed = static_cast<double>(state.choice.seed);
  info.default_value = seed;
  DrawText(ui, s.body, s.palette.text2, row.x, row.centre().y, "Seed");
  SliderRow value{&info, seed};
  value.ask = [&](double to) { state.choice.seed = static_cast<std::uint64_t>(std::llround(to)); };
  const Rect field{row.right() - s.Px(96), row.y, s.Px(96), row.h};
  DrawValueField(ui, field, value, snap.session->settings, state.sliders, FieldKeys::kOwn);
}

}  // namespace

void DrawNextFlight(const EngineSnapshot& snap, const Rect& rect, SimulateState& state,
                    UiFrame& ui) {
  const Style& s = ui.style;
  const Rect content =
      DrawPanelFrame(ui, rect, "New flight", {{"Now: " + ShortName(snap.session->source.name), 0}});
  const float pad = s.Px(12), x = content.x + pad, w = content.w - 2 * pad;
  float y = content.y + s.Px(2);
  const bool narrow = w < s.Px(360);
  const int columns = narrow ? 3 : 4;
  y = DrawChoice({x, y, w, 0}, "scenario", state.offered.scenarios, columns, state.choice.scenario,
                 ui) +
      s.Px(6);
  // Beside each other where there is room.
  const float seed_w = narrow ? w : s.Px(150);
  DrawSeed({x, y, seed_w, s.Px(24)}, snap, state, ui);
  const float vehicle_x = narrow ? x : x + seed_w + s.Px(12);
  y += narrow ? s.Px(32) : 0;
  y = DrawChoice({vehicle_x, y, x + w - vehicle_x, 0}, "vehicle", state.offered.vehicles,
                 narrow ? 3 : std::max(2, static_cast<int>(state.offered.vehicles.size())),
                 state.choice.vehicle, ui) +
      s.Px(6);
  const Rect button{x, y, w, s.Px(34)};
  ButtonLook look;
  look.font = s.medium;
  look.hint = "Ends this flight and begins one there, with the vehicle's own cameras";
  if (DrawButton(ui, "fly_world", button, "New flight in this world", look)) {
    NextFlight next;
    next.choice = state.choice;
    ui.intents.push_back(UiAction(next));
  }
}

}  // namespace palace
