// Time of the simulation: pause, step, run to a moment, speed.
#include <algorithm>
#include <cmath>

#include "gui/panels/session_words.h"
#include "gui/panels/simulate/simulate.h"
#include "gui/widgets/button.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

using Kind = PlaybackControl::Kind;

constexpr std::array<const char*, 9> kSpeeds = {"0.1", "0.2", "0.5", "1", "2",
                                                "5",   "10",  "20",  "50"};
constexpr double kAhead_s = 10;

void Ask(UiFrame& ui, Kind kind, double value = 0) {
  ui.intents.push_back(PlaybackControl{kind, value});
}

std::string WordsOf(const SourceStatus& source) {
  if (source.ended) {
    return "Ended";
  }
  if (source.simulation->run_to_s) {
    return "Runs to " + Fixed(*source.simulation->run_to_s, 1) + " s";
  }
  return source.paused ? "Paused" : "Runs";
}

bool IconButton(UiFrame& ui, const char* name, const Rect& rect, Icon icon, bool active,
                bool enabled, const char* hint) {
  const Style& s = ui.style;
  ButtonLook look;
  look.active = active;
  look.enabled = enabled;
  look.reason = "The flight is over: begin a new one";
  look.hint = hint;
  const bool clicked = DrawButton(ui, name, rect, "", look);
  DrawIcon(Canvas(), icon, rect.centre(), s.Px(20),
           !enabled ? s.palette.text3 : (active ? s.palette.on_white : s.palette.text1));
  return clicked;
}

void DrawTransport(const EngineSnapshot& snap, const Rect& row, UiFrame& ui) {
  const Style& s = ui.style;
  const SourceStatus& source = snap.session->source;
  const bool playing = IsPlaying(snap), can = !source.ended;
  const Rect play{row.x, row.y, s.Px(48), row.h};
  if (IconButton(ui, "sim/play", play, playing ? Icon::kPause : Icon::kPlay, playing, can,
                 playing ? "Pauses (Space)" : "Runs (Space)")) {
    Ask(ui, playing ? Kind::kPause : Kind::kPlay);
  }
  const Rect step{play.right() + s.Px(8), row.y, s.Px(48), row.h};
  if (IconButton(ui, "sim/step", step, Icon::kFrameForward, false, can,
                 "One period of the cameras (.)")) {
    Ask(ui, Kind::kStepForward);
  }
  const std::string now = Fixed(source.position_s, 1);
  const float y = row.centre().y;
  const float unit = TextWidth(s.caption, "s");
  DrawText(ui, s.caption, s.palette.text2, row.right(), y, "s", Align::kRight);
  DrawText(ui, s.replay_time, s.palette.text1, row.right() - unit - s.Px(6), y, now, Align::kRight);
  ui.items.Add("sim/time", row, true, now + " s");
}

/// "max 600.0 s" of "700.0 s is over the limit, max 600.0 s"; empty where nothing was refused.
std::string RefusalOf(const UiFrame& ui, const std::string& item) {
  const Item* refused = ui.items.Find(item);
  if (refused == nullptr) {
    return {};
  }
  const std::size_t comma = refused->text.find(", ");
  return comma == std::string::npos ? refused->text : refused->text.substr(comma + 2);
}

void DrawRunTo(const EngineSnapshot& snap, const Rect& row, SimulateState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const SourceStatus& source = snap.session->source;
  SettingInfo info;
  info.name = "simulation.run_to_s";
  info.label = "Run to";
  info.unit = "s";
  info.max = info.soft_max = source.duration_s.value_or(source.position_s);
  const bool past = state.run_to_s <= source.position_s;
  if (past && !state.run_to_typed) {
    state.run_to_s = std::min(info.max, kAhead_s * (std::floor(source.position_s / kAhead_s) + 1));
  }
  info.default_value = state.run_to_s;
  const Rect button{row.right() - s.Px(96), row.y, s.Px(96), row.h};
  const Rect field{button.x - s.Px(8) - s.Px(96), row.y, s.Px(96), row.h};
  SliderRow value{&info, state.run_to_s};
  value.ask = [&](double to_s) {
    state.run_to_s = to_s;
    state.run_to_typed = true;
  };
  DrawValueField(ui, field, value, snap.session->settings, state.sliders, FieldKeys::kOwn);
  const bool passed = past && state.run_to_typed;
  const std::string why = passed ? "has passed" : RefusalOf(ui, "refused/" + info.name);
  const float y = row.centre().y, up = why.empty() ? 0 : s.Px(8);
  DrawText(ui, s.body, s.palette.text2, row.x, y - up, "Run to");
  DrawText(ui, s.caption, s.palette.caution, row.x, y + s.Px(9), why);
  if (!why.empty()) {
    ui.items.Add("sim/run_to_refused", row, true, why);
  }
  const std::string it_is = "That moment has passed: it is " + Fixed(source.position_s, 1) + " s";
  ButtonLook look;
  look.enabled = !source.ended && !passed;
  look.reason = source.ended ? "The flight is over: begin a new one" : std::string_view(it_is);
  look.hint = "Runs to the first pictures at or after that moment, and pauses there";
  if (DrawButton(ui, "sim/run_to", button, "Run to it", look)) {
    Ask(ui, Kind::kRunTo, state.run_to_s);
    state.run_to_typed = false;
  }
}

void DrawSpeeds(const SourceStatus& source, const Rect& row, UiFrame& ui) {
  const Style& s = ui.style;
  const float fastest_w = s.Px(64), gap = s.Px(2);
  const float w =
      std::floor((row.w - fastest_w - gap * static_cast<float>(kSpeeds.size())) / kSpeeds.size());
  float x = row.x;
  ButtonLook look;
  look.font = s.caption;
  for (const char* speed : kSpeeds) {
    const double value = std::stod(speed);
    look.active = source.speed == value;
    if (DrawButton(ui, std::string("sim/speed/") + speed, {x, row.y, w, row.h}, speed, look)) {
      Ask(ui, Kind::kSpeed, value);
    }
    x += w + gap;
  }
  look.active = source.speed == 0;
  look.hint = "As fast as this machine can";
  if (DrawButton(ui, "sim/speed/fastest", {x, row.y, row.right() - x, row.h}, "Fastest", look)) {
    Ask(ui, Kind::kSpeed, 0);
  }
}

std::string TimesReal(double speed) { return Fixed(speed, speed < 1 ? 2 : 1) + "×"; }

}  // namespace

void DrawSimulatedTime(const EngineSnapshot& snap, const Rect& rect, SimulateState& state,
                       UiFrame& ui) {
  const Style& s = ui.style;
  const SourceStatus& source = snap.session->source;
  const std::string words = WordsOf(source);
  const Rect content = DrawPanelFrame(ui, rect, "Time", {{words, 0, true, false}});
  ui.items.Add("sim/state", content, true, words);
  const float pad = s.Px(12), x = content.x + pad, w = content.w - 2 * pad;
  float y = content.y + s.Px(4);
  DrawTransport(snap, {x, y, w, s.Px(36)}, ui);
  y += s.Px(44);
  DrawRunTo(snap, {x, y, w, s.Px(28)}, state, ui);
  y += s.Px(36);
  DrawSpeeds(source, {x, y, w, s.Px(26)}, ui);
  y += s.Px(26) + s.Px(16);
  const std::string asked =
      "Speed asked " + (source.speed > 0 ? TimesReal(source.speed) + " real time" : "fastest");
  const std::string reached =
      "reached " + (IsPlaying(snap) ? TimesReal(source.speed_reached) + " real time" : "––");
  DrawText(ui, s.caption, s.palette.text2, x, y, asked);
  DrawText(ui, s.caption, s.palette.text1, x + w, y, reached, Align::kRight);
  ui.items.Add("sim/reached", rect, true, reached);
}

}  // namespace palace
