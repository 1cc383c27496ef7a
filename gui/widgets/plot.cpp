#include "gui/widgets/plot.h"

#include <algorithm>
#include <cmath>

#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

struct Axes {
  Rect floor;
  const PlotView& view;

  float X(float x) const {
    return floor.x + (x - view.x_min) / (view.x_max - view.x_min) * floor.w;
  }
  float Y(float y) const {
    return floor.bottom() - (y - view.y_min) / (view.y_max - view.y_min) * floor.h;
  }
  ImVec2 At(ImVec2 p) const { return {X(p.x), Y(p.y)}; }
};

int DecimalsFor(const std::vector<float>& ticks) {
  const float step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0f;
  int decimals = 0;
  for (float scaled = step; decimals < 3 && std::abs(scaled - std::round(scaled)) > 1e-3f;
       scaled *= 10) {
    ++decimals;
  }
  return decimals;
}

/// As many values as the height holds without two labels touching, at least two.
std::vector<float> ValueTicks(const Style& s, const Axes& axes) {
  const PlotView& v = axes.view;
  const int most = std::clamp(static_cast<int>(axes.floor.h / s.Px(18)) + 1, 2, 7);
  std::vector<float> best;
  for (int rows = 1; rows <= 6; ++rows) {
    std::vector<float> ticks = RoundTicks(v.y_min, v.y_max, rows);
    if (static_cast<int>(ticks.size()) <= most && ticks.size() > best.size()) {
      best = std::move(ticks);
    }
  }
  return best.size() >= 2 ? best : std::vector<float>{v.y_min, v.y_max};
}

std::string ClockLabel(float seconds) {
  const int total = static_cast<int>(std::lround(seconds));
  const std::string rest = std::to_string(total % 60);
  return std::to_string(total / 60) + (rest.size() < 2 ? ":0" : ":") + rest;
}

/// Tick label of the x axis.
std::string TickText(const PlotView& view, float x, int decimals) {
  if (view.x_axis == PlotView::XAxis::kValue) {
    return Fixed(static_cast<double>(x), decimals);
  }
  if (view.x_axis == PlotView::XAxis::kClock) {
    return ClockLabel(x);
  }
  const std::string text = Fixed(static_cast<double>(x), 0);
  return std::abs(x) < 1e-3f ? view.zero : (x > 0 ? "+" + text : text);
}

std::vector<float> XTicks(const Style& s, const Axes& axes) {
  const PlotView& v = axes.view;
  if (!v.x_ticks.empty()) {
    return v.x_ticks;
  }
  const int count = std::max(2, static_cast<int>(axes.floor.w / s.Px(60)));
  return v.x_axis == PlotView::XAxis::kClock ? ClockTicks(v.x_min, v.x_max, count)
                                             : RoundTicks(v.x_min, v.x_max, count);
}

void DrawGrid(UiFrame& ui, const Axes& axes) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const PlotView& v = axes.view;
  ImDrawList* dl = Canvas();
  FillRect(dl, axes.floor, p.plot_floor);
  const std::vector<float> ys = ValueTicks(s, axes);
  const int decimals = DecimalsFor(ys);
  for (const float y : ys) {
    const float at = std::round(axes.Y(y));
    FillRect(dl, {axes.floor.x, at, axes.floor.w, s.Px(1)}, p.plot_grid);
    DrawText(ui, s.caption, p.text2, axes.floor.x - s.Px(8), at,
             Fixed(static_cast<double>(y), decimals), Align::kRight);
  }
  // The unit once: beside every figure it would touch the next.
  std::string unit = v.x_axis == PlotView::XAxis::kRelative ? " s" : v.x_unit;
  const std::vector<float> xs = XTicks(s, axes);
  for (const float x : xs) {
    const float at = std::round(axes.X(x));
    FillRect(dl, {at, axes.floor.y, s.Px(1), axes.floor.h}, p.plot_grid);
    const std::string label = TickText(v, x, DecimalsFor(xs)) + unit;
    unit.clear();
    // The last label would stick out of the panel.
    if (at + s.Px(16) < axes.floor.right() + s.Px(10)) {
      DrawText(ui, s.caption, p.text2, at, axes.floor.bottom() + s.Px(12), label, Align::kCentre);
    }
  }
}

float LeftOf(const Axes& axes, const PlotLimit& limit) {
  return std::max(axes.floor.x, axes.X(std::max(limit.from_x, axes.view.x_min)));
}

void DrawLimitArea(const Style& s, const Axes& axes, const PlotLimit& limit) {
  if (limit.kind == PlotLimit::Kind::kInformation) {
    return;
  }
  const float y = std::clamp(axes.Y(limit.value), axes.floor.y, axes.floor.bottom());
  const float left = LeftOf(axes, limit);
  const float right = axes.view.now ? axes.X(*axes.view.now) : axes.floor.right();
  const Rect area = limit.kind == PlotLimit::Kind::kMost
                        ? Rect{left, axes.floor.y, right - left, y - axes.floor.y}
                        : Rect{left, y, right - left, axes.floor.bottom() - y};
  if (area.h > 0 && area.w > 0) {
    FillRect(Canvas(), area, WithAlpha(s.palette.unsafe, 0.06f));
    Hatch(Canvas(), area, WithAlpha(s.palette.unsafe, 0.32f), s.Fine(1), s.Px(9));
  }
}

bool OnTrace(const Axes& axes, const Rect& words) {
  const auto hits = [&](const PlotTrace& trace) {
    return std::any_of(trace.points.begin(), trace.points.end(),
                       [&](const ImVec2& point) { return words.Contains(axes.At(point)); });
  };
  return std::any_of(axes.view.series.begin(), axes.view.series.end(), hits);
}

/// The lowest place at or above text_y where words do not lie on a trace.
float ClearOfTraces(const Axes& axes, float left, float right, float text_y, float half) {
  float clear_y = text_y;
  for (const PlotTrace& trace : axes.view.series) {
    for (const ImVec2& point : trace.points) {
      const ImVec2 at = axes.At(point);
      if (at.x >= left && at.x <= right && std::abs(at.y - text_y) < half) {
        clear_y = std::min(clear_y, at.y - half);
      }
    }
  }
  return clear_y;
}

void DrawLimitLine(UiFrame& ui, const Axes& axes, const PlotLimit& limit) {
  const Style& s = ui.style;
  const float y = std::round(axes.Y(limit.value));
  if (y < axes.floor.y || y > axes.floor.bottom()) {
    return;
  }
  const bool forbids = limit.kind != PlotLimit::Kind::kInformation;
  const ImU32 colour = forbids ? s.palette.unsafe : s.palette.text3;
  DashedLine(Canvas(), {LeftOf(axes, limit), y}, {axes.floor.right(), y}, colour, s.Fine(1.5f),
             s.Fine(8), s.Fine(4));
  // The words stand where nothing is measured yet; short of room they lose their second half.
  const float room = axes.floor.right() - s.Px(8) -
                     (axes.view.now ? axes.X(*axes.view.now) + s.Px(4) : axes.floor.x);
  std::string_view words = limit.text;
  if (TextWidth(s.caption, words) > room) {
    words = words.substr(0, words.find(':'));
  }
  const float width = TextWidth(s.caption, words);
  if (width > room && axes.floor.h > s.Px(40)) {
    // No future to stand in: at the beginning, where no trace is.
    const float half = s.Px(9), left = axes.floor.x + s.Px(6);
    const float whole = TextWidth(s.caption, limit.text);
    const float above = ClearOfTraces(axes, left, left + whole, y - half, half);
    const Rect box{left, above - half, whole, 2 * half};
    if (box.y >= axes.floor.y && box.right() < axes.floor.right() && !OnTrace(axes, box)) {
      DrawText(ui, s.caption, colour, left, above, limit.text);
    }
  } else if (axes.floor.h > s.Px(40)) {
    // Above the line, and above what is known of the traces further on; else below.
    const float half = s.Px(9), right = axes.floor.right() - s.Px(6);
    const float above = ClearOfTraces(axes, right - width, right, y - half, half);
    const float text_y = above - axes.floor.y > s.Px(11) ? above : y + s.Px(10);
    DrawText(ui, s.caption, colour, axes.floor.right() - s.Px(6), text_y, words, Align::kRight);
  }
  ui.items.Add("plot_limit/" + axes.view.name,
               {LeftOf(axes, limit), y, axes.floor.right() - LeftOf(axes, limit), 1}, forbids,
               limit.text);
}

void DrawBand(const Axes& axes, const PlotTrace& series) {
  ImDrawList* dl = Canvas();
  const ImU32 fill = WithAlpha(series.colour, 0.22f);
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  for (std::size_t i = 1; i < series.points.size() && i < series.band.size(); ++i) {
    const ImVec2 a = series.points[i - 1];
    const ImVec2 b = series.points[i];
    const float wa = series.band[i - 1];
    const float wb = series.band[i];
    if (!std::isfinite(a.y + b.y + wa + wb)) {
      continue;
    }
    const ImVec2 quad[4] = {axes.At({a.x, a.y + wa}), axes.At({b.x, b.y + wb}),
                            axes.At({b.x, b.y - wb}), axes.At({a.x, a.y - wa})};
    dl->PrimReserve(6, 4);  // no anti-aliased seams between the quads
    dl->PrimQuadUV(quad[0], quad[1], quad[2], quad[3], white, white, white, white, fill);
  }
}

/// From where the first series ends to now nothing is known: hatched, not left as if it were calm.
void DrawUnknownEnd(UiFrame& ui, const Axes& axes) {
  const PlotView& v = axes.view;
  if (!v.now || v.series.empty() || v.series.front().points.empty()) {
    return;
  }
  const std::vector<ImVec2>& points = v.series.front().points;
  const auto last = std::find_if(points.rbegin(), points.rend(),
                                 [](const ImVec2& p) { return std::isfinite(p.x + p.y); });
  const float from = last == points.rend() ? axes.floor.x : axes.X(std::max(last->x, v.x_min));
  const Rect gap{from, axes.floor.y, axes.X(*v.now) - from, axes.floor.h};
  if (gap.w > ui.style.Px(6)) {
    UnknownFill(ui.style, Canvas(), gap);
    ui.items.Add("plot_unknown/" + v.name, gap, true, "unknown");
  }
}

void StrokeRun(const Style& s, const std::vector<ImVec2>& run, const PlotTrace& series) {
  if (run.size() < 2) {
    return;
  }
  ImDrawList* dl = Canvas();
  const float width = s.Fine(series.width);
  if (series.stroke == PlotTrace::Stroke::kDotted) {
    DashedPolyline(dl, run, series.colour, s.Fine(2), s.Fine(2), s.Fine(3));
  } else if (series.stroke == PlotTrace::Stroke::kDashed) {
    DashedPolyline(dl, run, series.colour, width, s.Fine(3), s.Fine(5));
  } else {
    dl->AddPolyline(run.data(), static_cast<int>(run.size()), series.colour, 0, width);
  }
}

/// Draws the line; where many points share a pixel column only their minimum and maximum remain.
void DrawLine(const Style& s, const Axes& axes, const PlotTrace& series) {
  std::vector<ImVec2> run;
  float column = -1e9f;
  ImVec2 low, high;
  bool open = false;
  const auto flush = [&] {
    if (open) {
      // Both ends of a column lie at its middle: a line that steps back would grow spikes.
      const float x = column + 0.5f;
      if (low.y - high.y < s.Fine(1)) {
        run.push_back({x, (low.y + high.y) / 2});
      } else {
        const bool from_low = run.empty() || run.back().y > (low.y + high.y) / 2;
        run.push_back({x - 0.25f, from_low ? low.y : high.y});
        run.push_back({x + 0.25f, from_low ? high.y : low.y});
      }
      open = false;
    }
  };
  for (const ImVec2& point : series.points) {
    if (!std::isfinite(point.x + point.y)) {
      flush();
      StrokeRun(s, run, series);
      run.clear();
      column = -1e9f;
      continue;
    }
    const ImVec2 at = axes.At(point);
    if (open && std::floor(at.x) == column) {
      low = at.y > low.y ? at : low;
      high = at.y < high.y ? at : high;
      continue;
    }
    flush();
    column = std::floor(at.x);
    low = high = at;
    open = true;
  }
  flush();
  StrokeRun(s, run, series);
  if (series.dot_at_end && !run.empty()) {
    Canvas()->AddCircleFilled(run.back(), s.Fine(4), series.colour);
    Canvas()->AddCircle(run.back(), s.Fine(4), s.palette.plot_floor, 0, s.Fine(1));
  }
}

void DrawHover(UiFrame& ui, const Axes& axes, const PlotHover& hover) {
  if (!hover.x || *hover.x < axes.view.x_min || *hover.x > axes.view.x_max) {
    return;
  }
  const Style& s = ui.style;
  const float x = std::round(axes.X(*hover.x));
  FillRect(Canvas(), {x, axes.floor.y, s.Px(1), axes.floor.h}, WithAlpha(s.palette.text2, 0.8f));
  if (axes.view.series.empty() || !axes.view.reads) {
    return;
  }
  const double value = static_cast<double>(SeriesValueAt(axes.view.series.front(), *hover.x));
  if (!std::isfinite(value)) {
    return;
  }
  const std::string text = Fixed(value, 2) + " " + axes.view.unit;
  const float width = TextWidth(s.caption, text) + s.Px(12);
  const float left = x + s.Px(6) + width < axes.floor.right() ? x + s.Px(6) : x - s.Px(6) - width;
  const Rect box{left, axes.floor.y + s.Px(4), width, s.Px(20)};
  FillRect(Canvas(), box, s.palette.control, s.Fine(3));
  StrokeRect(Canvas(), box, s.palette.strong_line, s.Fine(1), s.Fine(3));
  DrawText(ui, s.caption, s.palette.text1, box.centre().x, box.centre().y, text, Align::kCentre);
}

}  // namespace

void BeginPlots(PlotHover& hover) {
  hover.x = hover.next_x;
  hover.next_x.reset();
}

std::vector<float> RoundTicks(float low, float high, int count) {
  std::vector<float> ticks;
  const float span = high - low;
  if (!(span > 0) || count < 1) {
    return ticks;
  }
  const float raw = span / static_cast<float>(count);
  const float power = std::pow(10.0f, std::floor(std::log10(raw)));
  float step = power * 10;
  for (const float factor : {1.0f, 2.0f, 5.0f}) {
    if (raw <= factor * power * 1.001f) {
      step = factor * power;
      break;
    }
  }
  for (float i = std::ceil(low / step - 1e-4f); i * step <= high + step * 1e-4f; ++i) {
    ticks.push_back(i * step);
  }
  return ticks;
}

std::vector<float> ClockTicks(float low, float high, int count) {
  const float span = high - low;
  float step = 3600;
  for (const float candidate : {1.f, 2.f, 5.f, 10.f, 15.f, 30.f, 60.f, 120.f, 300.f, 600.f}) {
    if (span <= candidate * static_cast<float>(std::max(1, count))) {
      step = candidate;
      break;
    }
  }
  std::vector<float> ticks;
  for (float i = std::ceil(low / step - 1e-4f); i * step <= high + step * 1e-4f; ++i) {
    ticks.push_back(i * step);
  }
  return ticks;
}

float SeriesValueAt(const PlotTrace& series, float x) {
  const auto after = std::upper_bound(series.points.begin(), series.points.end(), x,
                                      [](float at, const ImVec2& p) { return at < p.x; });
  if (after == series.points.begin() ||
      (after == series.points.end() && series.points.back().x < x - 1)) {
    return NAN;
  }
  return std::prev(after)->y;
}

Rect DrawPlot(UiFrame& ui, const Rect& panel, const PlotView& view, PlotHover& hover) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  DrawPanelBackground(ui, panel, view.title);
  const float title_y = panel.y + s.Px(14);
  const float title_w = DrawText(ui, s.medium, p.text1, panel.x + s.Px(12), title_y, view.title);
  DrawText(ui, s.body, p.text3, panel.x + s.Px(18) + title_w, title_y, view.unit);
  DrawText(ui, s.medium, p.text1, panel.right() - s.Px(14), title_y, view.current, Align::kRight);
  const Axes axes{{panel.x + s.Px(52), panel.y + s.Px(32), panel.w - s.Px(66) - view.side,
                   panel.h - s.Px(56) - view.foot},
                  view};
  DrawGrid(ui, axes);
  ImDrawList* dl = Canvas();
  dl->PushClipRect(axes.floor.min(), axes.floor.max(), true);
  DrawUnknownEnd(ui, axes);
  for (const PlotLimit& limit : view.limits) {
    DrawLimitArea(s, axes, limit);
  }
  for (const PlotTrace& series : view.series) {
    DrawBand(axes, series);
  }
  if (view.now) {
    const float x = std::round(axes.X(*view.now));
    FillRect(dl, {x, axes.floor.y, axes.floor.right() - x, axes.floor.h},
             WithAlpha(p.panel, 0.45f));
    FillRect(dl, {x, axes.floor.y, s.Px(1), axes.floor.h}, p.white_mark);
  }
  for (auto it = view.series.rbegin(); it != view.series.rend(); ++it) {
    if (it->stroke != PlotTrace::Stroke::kDotted) {
      DrawLine(s, axes, *it);  // the first series lies on top
    }
  }
  for (const PlotTrace& series : view.series) {
    if (series.stroke == PlotTrace::Stroke::kDotted) {
      DrawLine(s, axes, series);  // dots hide nothing, and would be hidden
    }
  }
  for (const PlotLimit& limit : view.limits) {
    DrawLimitLine(ui, axes, limit);
  }
  DrawHover(ui, axes, hover);
  dl->PopClipRect();
  if (const Interaction in = Interact(ui, view.name, axes.floor, kPassive); in.hovered) {
    const float share = (in.pointer.x - axes.floor.x) / axes.floor.w;
    hover.next_x = view.x_min + share * (view.x_max - view.x_min);
  }
  ui.items.Add("plot/" + view.name, panel, true, view.title + " " + view.current);
  return axes.floor;
}

}  // namespace palace
