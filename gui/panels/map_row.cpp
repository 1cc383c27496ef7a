// The maps of Fly, and the question that a moved limit asks: a limit of safety is never changed by
// a pull at a picture alone.
#include <algorithm>

#include "gui/panels/fly_panels.h"
#include "gui/panels/map_views.h"
#include "gui/widgets/button.h"

namespace palace {

void DrawMapRowPanel(const EngineSnapshot& snap, const std::array<Rect, 5>& rects, float side,
                     bool named, MapRowState& state, UiFrame& ui) {
  MapMarks marks = MarksOf(snap, ui.highlighted_site);
  MapSource source = ShownMap(snap, ui.silent_s);
  if (source.decision != nullptr && source.decision->hazards) {
    marks.probe = ProbeCell(state.probe, source.decision->hazards->geometry);
  }
  source.cursor = marks.probe;
  source.site = SiteInView(snap, ui.highlighted_site);  // as the evidence beside them
  for (std::size_t i = 0; i < rects.size(); ++i) {
    MapView view = MakeMapView(static_cast<MapKind>(i), source, ui.textures);
    view.preview = snap.terrain->preview != nullptr;
    view.letter = named ? view.letter : "";
    if (state.asked && state.asked->setting == view.limit.setting) {
      view.limit.asked = state.asked->value;
      view.limit.label = FormatSetting(*FindSetting(view.limit.setting), state.asked->value) + "?";
    }
    const MapAnswer answer = DrawMapPanel(ui, rects[i], side, view, marks, state.drag);
    state.asked = answer.tick ? answer.tick : state.asked;
    OfferProbe(view, answer, state.probe);
    if (answer.discards) {
      ui.intents.push_back(CommandAction(DiscardSettings{}));
    }
  }
}

void DrawTickQuestion(const EngineSnapshot& snap, const Rect& body, MapRowState& state,
                      UiFrame& ui) {
  const SettingInfo* info = state.asked ? FindSetting(state.asked->setting) : nullptr;
  if (info == nullptr) {
    return;
  }
  const Style& s = ui.style;
  const double now = GetSetting(snap.session->preview_settings, info->name);
  const std::string words = info->label + ": " + FormatSetting(*info, now) + " to " +
                            FormatSetting(*info, state.asked->value) + "?";
  const LimitsApply apply = snap.session->limits_apply;
  const char* when = apply == LimitsApply::kAtOnce ? "Applies at once, to every map from now on."
                     : apply == LimitsApply::kNotNow
                         ? "Only a preview: the descent keeps its limits."
                         : "A preview, until it is applied on Tune.";
  const float width =
      std::max({TextWidth(s.medium, words), TextWidth(s.caption, when), s.Px(200)}) + s.Px(24);
  const Rect& tick = state.asked->tick;
  const Rect box{std::clamp(std::round(tick.centre().x - width / 2), body.x, body.right() - width),
                 tick.y - s.Px(104), width, s.Px(96)};
  BeginOverlay("##tick_question", box);
  ui.items.Add("tick_question", box, true, words);  // the overlay shields what lies below
  FillRect(Canvas(), box, s.palette.control, s.Fine(4));
  StrokeRect(Canvas(), box, s.palette.strong_line, s.Fine(1), s.Fine(4));
  DrawText(ui, s.medium, s.palette.text1, box.x + s.Px(12), box.y + s.Px(18), words);
  DrawText(ui, s.caption, s.palette.text2, box.x + s.Px(12), box.y + s.Px(38), when);
  const float half = std::floor((box.w - s.Px(32)) / 2);
  const Rect keep{box.x + s.Px(12), box.bottom() - s.Px(40), half, s.Px(32)};
  const Rect set{keep.right() + s.Px(8), keep.y, half, keep.h};
  const bool kept = DrawButton(ui, "tick_keep", keep, "Keep " + FormatSetting(*info, now));
  if (DrawButton(ui, "tick_set", set, "Set " + FormatSetting(*info, state.asked->value))) {
    ui.intents.push_back(CommandAction(SetSetting{info->name, state.asked->value}));
    state.asked.reset();
  } else if (kept) {
    state.asked.reset();
  }
  EndOverlay();
}

}  // namespace palace
