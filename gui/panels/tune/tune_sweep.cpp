// Sweep: what one limit, moved alone, would make of the newest map.
#include <algorithm>
#include <cmath>

#include "engine/model/landing_site.h"
#include "gui/panels/tune/tune.h"
#include "gui/widgets/button.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

/// The next limit of the table that can be swept, `step` of 1 or -1 on, round and round.
std::string NextLimit(const std::string& limit, int step) {
  std::vector<std::string> names;
  for (const SettingInfo& info : SettingTable()) {
    if (MaySweep(info)) {
      names.push_back(info.name);
    }
  }
  const auto at = std::find(names.begin(), names.end(), limit);
  const auto count = static_cast<int>(names.size());
  return names[static_cast<std::size_t>((at - names.begin() + step + count) % count)];
}

std::string LowerFirst(std::string text) {
  text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

/// The one sweep that a frame shows, in the numbers of its limit.
struct SweepView {
  const SettingInfo& limit;
  const LimitSweep* sweep = nullptr;  ///< of this limit, with values; null: none yet
  double applied = 0, preview = 0;
  bool of_these = false;  ///< all other limits are those that it was made under
  double age_s = NAN;     ///< of its map

  float Shown(double value) const { return static_cast<float>(value * limit.shown_per_unit); }
};

SweepView ViewOf(const EngineSnapshot& snap, const TuneState& state, const UiFrame& ui) {
  SweepView view{.limit = *FindSetting(state.swept.limit)};
  const Settings& preview = snap.session->preview_settings;
  view.applied = GetSetting(snap.session->settings, view.limit.name);
  view.preview = GetSetting(preview, view.limit.name);
  if (state.sweep == nullptr || state.sweep->limit != view.limit.name ||
      state.sweep->values.empty()) {
    return view;
  }
  view.sweep = state.sweep.get();
  Settings others = view.sweep->others;
  view.of_these = SetSettingValue(others, view.limit.name, view.preview) && others == preview;
  view.age_s = SecondsBetween(view.sweep->map_time, snap.time) + ui.silent_s;
  return view;
}

/// Between swept values the area goes straight.
double AreaAt(const LimitSweep& sweep, double value) {
  const auto& values = sweep.values;
  const auto after =
      std::lower_bound(values.begin(), values.end(), value,
                       [](const SweptValue& swept, double wanted) { return swept.value < wanted; });
  if (after == values.begin() || after == values.end()) {
    return after == values.end() ? values.back().safe_area_m2 : after->safe_area_m2;
  }
  const SweptValue &a = *std::prev(after), &b = *after;
  return a.safe_area_m2 +
         (b.safe_area_m2 - a.safe_area_m2) * (value - a.value) / (b.value - a.value);
}

/// "+1" is the letter of one list: over the sweep it would name many places.
std::string BestName(const SweptValue& swept) {
  return swept.best_id == 0 ? "no site" : IsNamedSite(swept.best_id) ? swept.best : "a new place";
}

/// "Below 7.4° the best is B, not A." Of the changes on both sides the nearer one.
std::string ChangeWords(const SweepView& view) {
  const std::optional<BestAround> around = BestAroundValue(*view.sweep, view.preview);
  const auto& below = around->below;
  const auto& above = around->above;
  const bool any = around->here.best_id != 0;
  if (!below && !above) {
    return any ? "The best site is " + BestName(around->here) + " at every value here."
               : "No value here gives a site.";
  }
  const bool down = below && (!above || view.preview - below->value <= above->value - view.preview);
  const BestChange& change = down ? *below : *above;
  const std::string where =
      (down ? "Below " : "Above ") + FormatSetting(view.limit, change.value) + " ";
  if (!any) {
    return where + "there is a site: " + BestName(change.then) + ".";
  }
  return change.then.best_id == 0 ? where + "no site is left."
                                  : where + "the best is " + BestName(change.then) + ", not " +
                                        BestName(around->here) + ".";
}

std::string ValueWords(const SweepView& view, double value) {
  const SweptValue here = BestAroundValue(*view.sweep, value)->here;
  const std::string area = Fixed(AreaAt(*view.sweep, value), 0) + " m²";
  return "At " + FormatSetting(view.limit, value) + ": " + area + ", " +
         (here.best_id == 0
              ? "no site."
              : "best " + BestName(here) + ", " + Fixed(here.best_clear_m, 1) + " m clear.");
}

PlotView PlotOf(const Style& s, const SweepView& view) {
  PlotView plot;
  plot.name = "sweep";
  plot.title = "Sweep: " + LowerFirst(view.limit.label);
  plot.unit = "safe area, m²";
  plot.x_axis = PlotView::XAxis::kValue;
  plot.x_unit =
      view.limit.unit.empty() || view.limit.unit == "°" ? view.limit.unit : " " + view.limit.unit;
  plot.reads = false;  // the words below do
  plot.x_min = view.Shown(view.sweep->values.front().value);
  plot.x_max = view.Shown(view.sweep->values.back().value);
  PlotTrace area;
  area.colour = s.palette.safe;
  float most = 1;
  for (const SweptValue& swept : view.sweep->values) {
    area.points.push_back({view.Shown(swept.value), static_cast<float>(swept.safe_area_m2)});
    most = std::max(most, area.points.back().y);
  }
  plot.y_max = most * 1.15f;
  plot.series.push_back(std::move(area));
  return plot;
}

/// The value in force and the previewed one, with their names, on the curve.
void DrawValues(UiFrame& ui, const Rect& floor, const PlotView& plot, const SweepView& view) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const auto at = [&](double value) {
    const float x = (view.Shown(value) - plot.x_min) / (plot.x_max - plot.x_min);
    const auto y = static_cast<float>(AreaAt(*view.sweep, value)) / plot.y_max;
    return ImVec2(floor.x + std::clamp(x, 0.0f, 1.0f) * floor.w, floor.bottom() - y * floor.h);
  };
  const bool moved = view.preview != view.applied;
  const ImVec2 preview = at(view.preview);
  FillRect(Canvas(), {std::round(preview.x), floor.y, s.Px(1), floor.h}, p.white_mark);
  // Beside a curve that rises to the right it is clear below on the right and above on the left.
  const double around = (view.sweep->values.back().value - view.sweep->values.front().value) / 12;
  const auto mark = [&](double value, ImU32 colour, ImU32 ink, const char* name, bool right) {
    const ImVec2 point = at(value);
    Canvas()->AddCircleFilled(point, s.Fine(4), colour);
    Canvas()->AddCircle(point, s.Fine(4), p.plot_floor, 0, s.Fine(1));
    const std::string words = name + (" " + FormatSetting(view.limit, value));
    const float width = TextWidth(s.caption, words) + s.Px(10);
    right = right ? point.x + width < floor.right() : point.x - width < floor.x;
    const bool rises = AreaAt(*view.sweep, value + around) >= AreaAt(*view.sweep, value - around);
    DrawText(ui, s.caption, ink, point.x + s.Px(right ? 8 : -8),
             std::clamp(point.y + s.Px(rises == right ? 12 : -12), floor.y + s.Px(9),
                        floor.bottom() - s.Px(9)),
             words, right ? Align::kLeft : Align::kRight);
  };
  if (moved) {
    mark(view.applied, p.text2, p.text2, "applied", view.applied > view.preview);
  }
  mark(view.preview, p.safe, p.text1, moved ? "preview" : "applied",
       !moved || view.preview > view.applied);
}

/// Which place would be the best, below the values for which it would.
void DrawBest(UiFrame& ui, const Rect& strip, const PlotView& plot, const SweepView& view) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const std::vector<SweptValue>& values = view.sweep->values;
  const auto x = [&](double value) {
    return strip.x + (view.Shown(value) - plot.x_min) / (plot.x_max - plot.x_min) * strip.w;
  };
  for (std::size_t i = 0; i < values.size();) {
    std::size_t end = i + 1;
    while (end < values.size() && SameBest(values[i], values[end])) {
      ++end;
    }
    const float left = i == 0 ? strip.x : (x(values[i - 1].value) + x(values[i].value)) / 2;
    const float right = end == values.size()
                            ? strip.right()
                            : (x(values[end - 1].value) + x(values[end].value)) / 2;
    const Rect box{left, strip.y, right - left - s.Px(1), strip.h};
    if (values[i].best_id == 0) {
      UnknownFill(s, Canvas(), box);
    } else {
      FillRect(Canvas(), box, p.hover);
    }
    const bool named = values[i].best_id == 0 || IsNamedSite(values[i].best_id);
    const std::string name = named ? BestName(values[i]) : "new";
    if (TextWidth(s.caption, name) + s.Px(4) < box.w) {
      DrawText(ui, s.caption, p.text1, box.centre().x, box.centre().y, name, Align::kCentre);
    }
    ui.items.Add("sweep/best/" + std::to_string(i), box, true, name);
    i = end;
  }
  const float here = std::clamp(x(view.preview), strip.x, strip.right());
  Canvas()->AddTriangleFilled({here - s.Fine(5), strip.bottom() + s.Fine(7)},
                              {here + s.Fine(5), strip.bottom() + s.Fine(7)},
                              {here, strip.bottom() + s.Fine(1)}, p.white_mark);
}

void DrawChoice(UiFrame& ui, const Rect& rect, TuneState& state) {
  const Style& s = ui.style;
  const float side = s.Px(24), y = rect.y + s.Px(2);
  const struct {
    const char* name;
    const char* hint;
    Icon icon;
    int step;
    float right;
  } buttons[] = {
      {"sweep/next", "The next limit", Icon::kChevronRight, 1, rect.right() - s.Px(4)},
      {"sweep/previous", "The limit before", Icon::kChevronLeft, -1, rect.right() - s.Px(30)}};
  for (const auto& button : buttons) {
    ButtonLook look;
    look.flat = true;
    look.hint = button.hint;
    const Rect box{button.right - side, y, side, side};
    if (DrawButton(ui, button.name, box, "", look)) {
      state.swept.limit = NextLimit(state.swept.limit, button.step);
    }
    DrawIcon(Canvas(), button.icon, box.centre(), s.Px(12), s.palette.text2);
  }
}

/// What a press on the plot asks for, as the slider's grab at that place would.
void TakePress(UiFrame& ui, const Rect& floor, const PlotView& plot, const SweepView& view,
               bool withheld) {
  const Interaction in = Interact(ui, "sweep/plot", floor, kNoTab, view.limit.label);
  if (in.clicked && !withheld) {
    const float shown = plot.x_min + (in.pointer.x - floor.x) / floor.w * (plot.x_max - plot.x_min);
    const double step = std::pow(10.0, view.limit.decimals);
    const double value = std::round(static_cast<double>(shown) * step) / step;
    ui.intents.push_back(CommandAction(
        SetSetting{view.limit.name, ClampSetting(view.limit, value / view.limit.shown_per_unit)}));
  }
}

/// Age of the map, or that another answer is on its way.
std::string StateWords(const SweepView& view) {
  return view.of_these ? "Map " + AgeText(view.age_s) + " old" : "Being worked out anew";
}

}  // namespace

void DrawSweepPanel(const EngineSnapshot& snap, const Rect& rect, TuneState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const SweepView view = ViewOf(snap, state, ui);
  if (view.sweep == nullptr) {
    const Rect content = DrawPanelFrame(ui, rect, "Sweep: " + LowerFirst(view.limit.label));
    DrawText(ui, s.body, p.text2, content.centre().x, content.centre().y,
             snap.terrain->applied ? "Being worked out" : "No map yet", Align::kCentre);
    DrawChoice(ui, rect, state);
    return;
  }
  const bool beside = rect.w > s.Px(600);  // no height for words below, but width
  constexpr float kStrip = 16;
  PlotView plot = PlotOf(s, view);
  plot.foot = s.Px(beside ? kStrip + 8 : kStrip + 8 + 42);
  plot.side = beside ? std::round(rect.w * 0.4f) : 0;
  const Rect floor = DrawPlot(ui, rect, plot, state.sweep_hover);
  DrawChoice(ui, rect, state);
  DrawValues(ui, floor, plot, view);
  DrawBest(ui, {floor.x, floor.bottom() + s.Px(22), floor.w, s.Px(kStrip)}, plot, view);
  DrawText(ui, s.caption, p.text2, floor.x - s.Px(8), floor.bottom() + s.Px(22 + kStrip / 2),
           "Best", Align::kRight);
  TakePress(ui, floor, plot, view, IsWithheld(state, ui));
  const auto& hover = state.sweep_hover.x;
  const std::string words =
      hover ? ValueWords(view, static_cast<double>(*hover) / view.limit.shown_per_unit)
            : ChangeWords(view);
  const float x = beside ? floor.right() + s.Px(24) : rect.x + s.Px(12);
  const float y = beside ? rect.y + s.Px(46) : floor.bottom() + s.Px(22 + kStrip + 20);
  DrawText(ui, s.body, p.text1, x, y, FitWords(s.body, words, rect.right() - s.Px(12) - x));
  DrawText(ui, s.caption, p.text2, x, y + s.Px(20), StateWords(view));
}

}  // namespace palace
