// Faults: injected from now on, and those of the flight, with the way to end them.
#include <algorithm>
#include <cmath>

#include "gui/panels/simulate/simulate.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

constexpr double kLongest_s = 600;

/// A name between two buttons that lead to its neighbours; returns by how far to go.
int DrawStepper(UiFrame& ui, const std::string& name, const Rect& box, std::string_view words) {
  const Style& s = ui.style;
  const float side = box.h;
  FillRect(Canvas(), box, s.palette.window, s.Fine(3));
  DrawText(ui, s.medium, s.palette.text1, box.centre().x, box.centre().y,
           FitWords(s.medium, words, box.w - 2 * side - s.Px(8)), Align::kCentre);
  int by = 0;
  for (const int way : {-1, 1}) {
    const Rect button{way < 0 ? box.x : box.right() - side, box.y, side, side};
    if (DrawButton(ui, name + (way < 0 ? "/before" : "/next"), button, way < 0 ? "<" : ">")) {
      by = way;
    }
  }
  ui.items.Add(name, box, true, words);
  return by;
}

std::size_t Stepped(std::size_t at, int by, std::size_t count) {
  return (at + count + static_cast<std::size_t>(by + static_cast<int>(count))) % count;
}

SettingInfo Number(const char* name, const std::string& unit, double least, double most) {
  SettingInfo info;
  info.name = name;
  info.unit = unit;
  info.decimals = most <= 3 ? 2 : 1;
  info.min = info.soft_min = least;
  info.max = info.soft_max = most;
  return info;
}

void DrawNumber(UiFrame& ui, const Rect& field, SettingInfo info, const EngineSnapshot& snap,
                double& value, SliderState& sliders) {
  info.default_value = value;
  SliderRow row{&info, value};
  row.ask = [&](double to) { value = to; };
  DrawValueField(ui, field, row, snap.session->settings, sliders, FieldKeys::kOwn);
}

/// What is injected, by how much and where; returns below it.
float DrawKind(const Rect& area, const EngineSnapshot& snap, SimulateState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const std::vector<FaultOffer>& kinds = state.offered.faults;
  FaultForm& form = state.fault;
  const float h = s.Px(26), gap = s.Px(6);
  const FaultOffer& kind = kinds[form.kind];
  ButtonLook look;
  look.font = s.medium;
  look.hint = kind.what;
  if (DrawButton(ui, "fault/kind", {area.x, area.y, area.w, h}, kind.words, look)) {
    state.choosing_fault = true;
  }
  if (std::isnan(form.value)) {
    form.value = kind.default_value;
  }
  const float half = std::floor((area.w - gap) / 2), y = area.y + h + gap;
  const Rect left{area.x, y, half, h}, right{area.x + half + gap, y, half, h};
  if (!kind.has_value) {
    DrawText(ui, s.caption, s.palette.text3, left.x, left.centre().y, "Has no value");
  } else {
    DrawNumber(ui, left, Number("simulation.fault_value", kind.unit, kind.least, kind.most), snap,
               form.value, state.sliders);
  }
  if (!kind.channels.empty()) {
    // The first stands for all of them.
    const std::size_t count = kind.channels.size() + 1;
    const std::string words = form.channel == 0 ? "All" : kind.channels[form.channel - 1].words;
    if (const int by = DrawStepper(ui, "fault/channel", right, words); by != 0) {
      form.channel = Stepped(form.channel, by, count);
    }
  }
  return y + h + gap;
}

/// As a fault is written (faults/fault_text.h), its times counted from now.
std::string TextOf(const FaultOffer& kind, const FaultForm& form) {
  std::string text = kind.name;
  if (kind.has_value) {
    text += "=" + std::to_string(form.value);
  }
  if (form.channel > 0) {
    text += "@" + kind.channels[form.channel - 1].name;
  }
  return text + ":0-" + (form.for_s > 0 ? std::to_string(form.for_s) : std::string());
}

void DrawInject(const Rect& row, const EngineSnapshot& snap, SimulateState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const FaultOffer& kind = state.offered.faults[state.fault.kind];
  const float words_w = TextWidth(s.caption, "For, 0 until ended") + s.Px(8);
  DrawText(ui, s.caption, s.palette.text2, row.x, row.centre().y, "For, 0 until ended");
  DrawNumber(ui, {row.x + words_w, row.y, s.Px(76), row.h},
             Number("simulation.fault_for_s", "s", 0, kLongest_s), snap, state.fault.for_s,
             state.sliders);
  const float x = row.x + words_w + s.Px(84);
  ButtonLook look;
  look.font = s.medium;
  look.hint = kind.what;
  look.enabled = !snap.session->source.ended;
  look.reason = "The flight is over: begin a new one";
  if (DrawButton(ui, "fault/inject", {x, row.y, row.right() - x, row.h}, "Inject now", look)) {
    ui.intents.push_back(UiAction(InjectFault{TextOf(kind, state.fault)}));
  }
}

/// Those that act first, then those to come; what is over is in Events.
std::vector<const ListedFault*> Standing(const std::vector<ListedFault>& faults) {
  std::vector<const ListedFault*> standing;
  for (const bool acts : {true, false}) {
    for (const ListedFault& fault : faults) {
      if (fault.acts == acts && !fault.over) {
        standing.push_back(&fault);
      }
    }
  }
  return standing;
}

std::string EndName(const ListedFault& fault) {
  return "fault/end/" + std::to_string(fault.number);
}

void DrawFaultRow(const Rect& row, const ListedFault& fault, UiFrame& ui) {
  const Style& s = ui.style;
  const std::string until =
      std::isfinite(fault.to_s) ? "to " + Fixed(fault.to_s, 1) + " s" : "until ended";
  const std::string when = fault.acts ? until : "from " + Fixed(fault.from_s, 1) + " s";
  const Rect end{row.right() - s.Px(52), row.y + s.Px(2), s.Px(52), s.Px(22)};
  const float when_x = end.x - s.Px(10);
  DrawText(ui, s.caption, s.palette.text2, when_x, row.centre().y, when, Align::kRight);
  const float room = when_x - TextWidth(s.caption, when) - s.Px(10) - row.x;
  ImFont* font = fault.acts ? s.medium : s.body;
  const bool fits = TextWidth(font, fault.words) <= room;
  DrawText(ui, font, fault.acts ? s.palette.text1 : s.palette.text2, row.x, row.centre().y,
           fits ? fault.words : fault.kind);
  const std::string name = "fault/" + std::to_string(fault.number);
  const std::string whole = fault.words + ", " + when;
  if (Interact(ui, name, row, kPassive).hovered && !fits) {
    DrawTooltip(ui, whole);
  }
  ui.items.Add(name, row, true, whole);
  if (DrawButton(ui, EndName(fault), end, "End")) {
    ui.intents.push_back(UiAction(EndFault{fault.number}));
  }
}

/// Scrolls by whole rows, by the wheel or after the keyboard's focus.
void DrawFaultList(const Rect& area, SimulateState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const std::vector<const ListedFault*> rows = Standing(state.faults);
  const float row_h = s.Px(26);
  const auto fit = static_cast<std::size_t>(std::max(0.0f, area.h / row_h));
  if (rows.empty() && fit > 0) {
    DrawText(ui, s.caption, s.palette.text3, area.x, area.y + row_h / 2,
             "No fault acts, none is to come");
  }
  const auto beyond = static_cast<int>(rows.size()) - static_cast<int>(fit);
  const float wheel = Interact(ui, "panel/Faults", area, kPassive).wheel;
  state.first_fault -= static_cast<int>(std::lround(wheel));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (fit > 0 && ui.focus.shown() != state.followed_fault && ui.focus.Has(EndName(*rows[i]))) {
      const auto at = static_cast<int>(i);  // the keyboard's row comes into sight
      state.first_fault = std::clamp(state.first_fault, at + 1 - static_cast<int>(fit), at);
    }
  }
  state.followed_fault = ui.focus.shown();
  state.first_fault = std::clamp(state.first_fault, 0, std::max(0, beyond));
  const auto first = static_cast<std::size_t>(state.first_fault);
  const float bar = beyond > 0 ? s.Px(10) : 0;
  ui.tab.list = "faults";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i < first || i >= first + fit) {
      OfferHidden(ui, EndName(*rows[i]));
      continue;
    }
    const float y = area.y + row_h * static_cast<float>(i - first);
    DrawFaultRow({area.x, y, area.w - bar, row_h}, *rows[i], ui);
  }
  ui.tab.list = {};
  if (beyond > 0 && fit > 0) {
    const float h = row_h * static_cast<float>(fit), unit = h / static_cast<float>(rows.size());
    FillRect(Canvas(),
             {area.right() - s.Px(4), area.y + unit * static_cast<float>(first), s.Px(4),
              unit * static_cast<float>(fit)},
             s.palette.strong_line, s.Fine(2));
  }
}

}  // namespace

void DrawFaultChoice(const Rect& rect, SimulateState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const Rect content = DrawPanelFrame(ui, rect, "Choose a fault");
  const std::vector<FaultOffer>& kinds = state.offered.faults;
  const std::size_t columns = rect.w < s.Px(400) ? 2 : 3,
                    rows = (kinds.size() + columns - 1) / columns;
  const float pad = s.Px(12), gap = s.Px(3);
  const float w = std::floor((content.w - 2 * pad) / static_cast<float>(columns));
  const float h = std::min(
      s.Px(27), std::floor((rect.bottom() - s.Px(4) - content.y) / static_cast<float>(rows)));
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const Rect box{content.x + pad + w * static_cast<float>(i / rows),
                   content.y + h * static_cast<float>(i % rows), w - gap, h - gap};
    ButtonLook look;
    look.font = s.caption;
    look.hint = kinds[i].what;
    look.active = i == state.fault.kind;
    if (DrawButton(ui, "fault/kind/" + kinds[i].name, box, kinds[i].words, look)) {
      state.fault = {i, 0, NAN, state.fault.for_s};
      state.choosing_fault = false;
    }
  }
}

void DrawFaults(const EngineSnapshot& snap, const Rect& rect, SimulateState& state, UiFrame& ui) {
  if (state.offered.faults.empty()) {
    return;
  }
  const Style& s = ui.style;
  const auto acting = std::count_if(state.faults.begin(), state.faults.end(),
                                    [](const ListedFault& fault) { return fault.acts; });
  const std::string fact =
      acting == 0 ? "" : std::to_string(acting) + (acting == 1 ? " acts" : " act");
  const Rect content = DrawPanelFrame(ui, rect, "Faults", {{fact, 0, true, false}});
  const float pad = s.Px(12), x = content.x + pad, w = content.w - 2 * pad;
  float y = DrawKind({x, content.y + s.Px(2), w, 0}, snap, state, ui);
  DrawInject({x, y, w, s.Px(28)}, snap, state, ui);
  y += s.Px(34);
  DrawFaultList({x, y, w, rect.bottom() - s.Px(6) - y}, state, ui);
}

}  // namespace palace
