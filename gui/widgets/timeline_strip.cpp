#include "gui/widgets/timeline_strip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"

namespace palace {
namespace {

constexpr double kLeastWindow_s = 2;
constexpr double kZoomStep = 0.8;
constexpr double kStep_s = 0.1;

/// Seconds to pixels of one strip.
struct Scale {
  Rect area;
  double from_s = 0;
  double to_s = 1;

  float X(double t) const {
    return area.x + static_cast<float>((t - from_s) / (to_s - from_s)) * area.w;
  }
  double T(float x) const {
    return from_s + static_cast<double>((x - area.x) / area.w) * (to_s - from_s);
  }
};

void Seek(UiFrame& ui, const TimelineView& view, double t, TimelineState& state) {
  const double wanted = std::clamp(t, 0.0, view.duration_s);
  if (wanted != state.last_seek_s) {
    state.last_seek_s = wanted;
    ui.intents.push_back(PlaybackControl{PlaybackControl::Kind::kSeek, wanted});
  }
}

void DrawSilhouette(const Style& s, const Scale& scale, const std::vector<ImVec2>& height) {
  float top = 1;
  for (const ImVec2& h : height) {
    top = std::isfinite(h.y) ? std::max(top, h.y) : top;
  }
  const Rect& r = scale.area;
  float last_x = -1;
  for (const ImVec2& h : height) {
    const float x = std::floor(scale.X(static_cast<double>(h.x)));
    if (!std::isfinite(h.y)) {
      last_x = -1;
      continue;
    }
    if (x == last_x) {
      continue;
    }
    const float left = last_x < 0 ? x : last_x;
    const float tall = std::max(0.0f, h.y / top) * (r.h - s.Px(6));
    FillRect(Canvas(), {left, r.bottom() - tall, std::max(1.0f, x - left), tall}, s.palette.hover);
    FillRect(Canvas(), {left, r.bottom() - tall, std::max(1.0f, x - left), s.Px(1)},
             s.palette.text3);
    last_x = x;
  }
}

/// Zooms the lanes about a moment; above 1 shows more of the flight.
void Zoom(const TimelineView& view, double about_s, double factor, TimelineState& state) {
  state.from_s = std::max(0.0, about_s - (about_s - state.from_s) * factor);
  state.to_s = std::min(view.duration_s, about_s + (state.to_s - about_s) * factor);
  state.to_s = std::max(state.to_s, state.from_s + std::min(kLeastWindow_s, view.duration_s));
  state.zoomed = true;
}

/// The overview: its grips and the wheel zoom the lanes, elsewhere it seeks.
void RunOverview(UiFrame& ui, const Scale& scale, const TimelineView& view, TimelineState& state) {
  const Style& s = ui.style;
  const float left = scale.X(state.from_s), right = scale.X(state.to_s);
  const auto at = [&](const Interaction& in) {
    return std::clamp(scale.T(in.pointer.x), 0.0, view.duration_s);
  };
  const Interaction from =
      Interact(ui, "overview/from", {left - s.Px(6), scale.area.y, s.Px(12), scale.area.h}, kNoTab);
  if (from.held) {
    state.from_s = std::min(at(from), state.to_s - kLeastWindow_s);
    state.zoomed = true;
  }
  const Interaction to =
      Interact(ui, "overview/to", {right - s.Px(6), scale.area.y, s.Px(12), scale.area.h}, kNoTab);
  if (to.held) {
    state.to_s = std::max(at(to), state.from_s + kLeastWindow_s);
    state.zoomed = true;
  }
  const Interaction strip =
      Interact(ui, "overview", scale.area, kNoTab | (view.can_seek ? 0U : unsigned{kDisabled}),
               TimeLabel(view.position_s, true));
  if (strip.held) {
    Seek(ui, view, at(strip), state);
  }
  const float wheel = from.wheel + to.wheel + strip.wheel;
  if (wheel != 0) {
    const ImVec2 pointer = ImGui::GetMousePos();
    Zoom(view, std::clamp(scale.T(pointer.x), 0.0, view.duration_s),
         std::pow(kZoomStep, static_cast<double>(wheel)), state);
  }
}

/// The band of a gap on the scale; empty where it is not seen.
Rect GapBand(const Scale& scale, const std::pair<double, double>& gap_s) {
  const float left = std::max(scale.X(gap_s.first), scale.area.x);
  const float right = std::min(scale.X(gap_s.second), scale.area.right());
  return right - left < 1 ? Rect{} : Rect{left, scale.area.y, right - left, scale.area.h};
}

/// Stretches without data, hatched; what is drawn later lies over them.
void HatchGaps(const Style& s, const Scale& scale, const TimelineView& view) {
  for (const auto& gap_s : view.gaps_s) {
    const Rect band = GapBand(scale, gap_s);
    if (band.w > 0) {
      Hatch(Canvas(), band, WithAlpha(s.palette.text3, 0.5f), s.Fine(1), s.Px(8));
    }
  }
}

/// Their lengths, where there is room.
void NameGaps(UiFrame& ui, const Scale& scale, const TimelineView& view) {
  const Style& s = ui.style;
  for (std::size_t i = 0; i < view.gaps_s.size(); ++i) {
    const Rect band = GapBand(scale, view.gaps_s[i]);
    if (band.w <= 0) {
      continue;
    }
    char words[48];
    std::snprintf(words, sizeof words, "No data, %.1f s",
                  view.gaps_s[i].second - view.gaps_s[i].first);
    ui.items.Add("gap/" + std::to_string(i), band, true, words);
    const float half = TextWidth(s.caption, words) / 2 + s.Px(6);
    if (2 * half < band.w) {
      const ImVec2 at = band.centre();
      FillRect(Canvas(), {at.x - half, at.y - s.Px(9), 2 * half, s.Px(18)}, s.palette.panel);
      DrawText(ui, s.caption, s.palette.text2, at.x, at.y, words, Align::kCentre);
    }
  }
}

/// The stretch of the loop: a bar between two posts along the bottom, bright while it is played.
void DrawLoop(UiFrame& ui, const Scale& scale, const TimelineState& state) {
  if (!state.loop_s) {
    return;
  }
  const Style& s = ui.style;
  const float left = std::max(scale.X(state.loop_s->first), scale.area.x);
  const float right = std::min(scale.X(state.loop_s->second), scale.area.right());
  if (right <= left) {
    return;
  }
  const ImU32 ink = state.loops ? s.palette.text1 : s.palette.text3;
  const Rect bar{left, scale.area.bottom() - s.Px(3), std::max(right - left, s.Px(4)), s.Px(3)};
  FillRect(Canvas(), bar, ink);
  for (const float x : {bar.x, bar.right() - s.Px(2)}) {
    FillRect(Canvas(), {x, bar.bottom() - s.Px(9), s.Px(2), s.Px(9)}, ink);
  }
  ui.items.Add(
      "loop", bar, state.loops,
      TimeLabel(state.loop_s->first, true) + " to " + TimeLabel(state.loop_s->second, true));
}

void DrawOverview(UiFrame& ui, const Rect& rect, const TimelineView& view, TimelineState& state) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  ImDrawList* dl = Canvas();
  const Scale scale{rect, 0, std::max(view.duration_s, 1e-3)};
  FillRect(dl, rect, p.plot_floor);
  DrawSilhouette(s, scale, view.height);
  HatchGaps(s, scale, view);
  for (const double at : view.differences_s) {
    const float x = scale.X(at);
    dl->AddTriangleFilled({x - s.Fine(5), rect.y}, {x + s.Fine(5), rect.y}, {x, rect.y + s.Fine(7)},
                          p.unsafe);
  }
  const float left = scale.X(state.from_s), right = scale.X(state.to_s);
  StrokeRect(dl, {left, rect.y, right - left, rect.h}, p.white_mark, s.Fine(1));
  for (const float x : {left, right}) {
    FillRect(dl, {x - s.Px(2), rect.centre().y - s.Px(7), s.Px(4), s.Px(14)}, p.white_mark,
             s.Fine(1));
  }
  FillRect(dl, {std::round(scale.X(view.position_s)) - s.Px(1), rect.y, s.Px(2), rect.h},
           p.white_mark);
  DrawLoop(ui, scale, state);
  RunOverview(ui, scale, view, state);
}

double RulerStep(double span_s, float width_px, float label_px) {
  const std::array<double, 11> steps = {0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600};
  for (const double step : steps) {
    if (static_cast<double>(width_px) * step / span_s > static_cast<double>(label_px)) {
      return step;
    }
  }
  return std::ceil(span_s / 4 / 600) * 600;
}

void DrawRuler(UiFrame& ui, const Scale& scale, double cursor_s) {
  const Style& s = ui.style;
  const double step = RulerStep(scale.to_s - scale.from_s, scale.area.w, s.Px(84));
  for (double t = std::ceil(scale.from_s / step) * step; t <= scale.to_s + 1e-9; t += step) {
    const std::string label = TimeLabel(t, step < 1);
    const float half = TextWidth(s.caption, label) / 2;
    const float x = scale.X(t);
    const bool touches_cursor = std::abs(x - scale.X(cursor_s)) < half + s.Px(8);
    if (x - half >= scale.area.x && x + half <= scale.area.right() && !touches_cursor) {
      DrawText(ui, s.caption, s.palette.text2, x, scale.area.centre().y, label, Align::kCentre);
    }
  }
}

void DrawSegment(UiFrame& ui, const Scale& scale, const Rect& lane, const LaneSegment& segment,
                 float cursor_x) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const float left = std::max(scale.X(segment.from_s), scale.area.x);
  const float right = std::min(scale.X(segment.to_s), scale.area.right());
  if (right - left < 1) {
    return;
  }
  ImDrawList* dl = Canvas();
  if (segment.hatched) {
    const Rect band{left, std::round(lane.centre().y - s.Px(4)), right - left, s.Px(8)};
    FillRect(dl, band, WithAlpha(p.unsafe, 0.25f));
    Hatch(dl, band, p.unsafe, s.Fine(1.5f), s.Px(7));
    return;
  }
  const Rect box{left, lane.y + s.Px(1), right - left - s.Px(1), lane.h - s.Px(2)};
  const ImU32 greys[3] = {p.hover, Mix(p.hover, p.strong_line, 0.35f),
                          Mix(p.hover, p.strong_line, 0.7f)};
  if (segment.dashed) {
    DashedRect(dl, box, p.strong_line, s.Fine(1), s.Fine(3), s.Fine(2));
  } else {
    FillRect(dl, box, greys[std::clamp(segment.shade, 0, 2)], s.Fine(2));
  }
  // A short stretch has its word in the middle, without the room beside it.
  const float width = TextWidth(s.medium, segment.text);
  const bool roomy = s.Px(8) + width + s.Px(6) <= box.w;
  const float text_x = roomy ? box.x + s.Px(8) : std::round(box.centre().x - width / 2);
  const float beside = s.Px(roomy ? 6 : 1);
  const bool touches_cursor = cursor_x > text_x - beside && cursor_x < text_x + width + beside;
  if (width + s.Px(2) <= box.w && !touches_cursor) {
    DrawText(ui, s.medium, p.text1, text_x, box.centre().y, segment.text);
  }
}

/// Word of the stretch at that time; empty between stretches.
std::string ValueAt(const Lane& lane, double t) {
  for (const LaneSegment& segment : lane.segments) {
    if (t >= segment.from_s && t < segment.to_s) {
      return segment.text;
    }
  }
  return {};
}

/// A mark and those that lie under it, which speak through it; in order of time.
struct MarkGroup {
  std::size_t shown = 0;
  std::vector<std::size_t> all{};
};

/// What the marks of a group say, a line each in order of time; of very many the first.
std::string HintOf(const MarkGroup& group, const std::vector<LaneMark>& marks) {
  constexpr std::size_t kMost = 6;
  if (group.all.size() == 1) {
    return marks[group.shown].hint;
  }
  std::string hint;
  for (std::size_t n = 0; n < group.all.size(); ++n) {
    if (n == kMost) {
      return hint + "\nand " + std::to_string(group.all.size() - n) + " more: zoom in";
    }
    const LaneMark& mark = marks[group.all[n]];
    hint += (n == 0 ? "" : "\n") + TimeLabel(mark.at_s, true) + "  " + mark.hint;
  }
  return hint;
}

/// The marks that are shown, in order of time: none lies on a heavier one.
std::vector<MarkGroup> ShownMarks(const Style& s, const Scale& scale,
                                  const std::vector<LaneMark>& marks) {
  std::vector<std::size_t> by_weight;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const float x = scale.X(marks[i].at_s);
    if (x >= scale.area.x + s.Px(6) && x <= scale.area.right() - s.Px(6)) {
      by_weight.push_back(i);
    }
  }
  std::stable_sort(by_weight.begin(), by_weight.end(),
                   [&](std::size_t a, std::size_t b) { return marks[a].weight > marks[b].weight; });
  const auto earlier = [&](std::size_t a, std::size_t b) { return marks[a].at_s < marks[b].at_s; };
  std::vector<MarkGroup> groups;
  for (const std::size_t i : by_weight) {
    const auto distance = [&](const MarkGroup& group) {
      return std::abs(scale.X(marks[i].at_s) - scale.X(marks[group.shown].at_s));
    };
    const auto nearest = std::min_element(
        groups.begin(), groups.end(),
        [&](const MarkGroup& a, const MarkGroup& b) { return distance(a) < distance(b); });
    if (nearest == groups.end() || distance(*nearest) >= s.Px(12)) {
      groups.push_back({i, {i}});
    } else {
      nearest->all.push_back(i);
    }
  }
  for (MarkGroup& group : groups) {
    std::stable_sort(group.all.begin(), group.all.end(), earlier);
  }
  std::stable_sort(groups.begin(), groups.end(), [&](const MarkGroup& a, const MarkGroup& b) {
    return earlier(a.shown, b.shown);
  });
  return groups;
}

/// Returns what the mark under the pointer says; empty without one.
std::string DrawMarks(UiFrame& ui, const Scale& scale, const Rect& row, const Lane& lane,
                      float cursor_x) {
  const Style& s = ui.style;
  const std::vector<MarkGroup> groups = ShownMarks(s, scale, lane.marks);
  std::string pointed;
  for (std::size_t n = 0; n < groups.size(); ++n) {
    const MarkGroup& group = groups[n];
    const LaneMark& mark = lane.marks[group.shown];
    const std::string hint = HintOf(group, lane.marks);
    const float x = scale.X(mark.at_s);
    const Rect box{x - s.Px(6), row.y, s.Px(12), row.h};
    DrawIcon(Canvas(), mark.icon, {x, row.centre().y}, s.Px(12),
             mark.colour != 0 ? mark.colour : s.palette.text1);
    ui.items.Add("mark/" + lane.name + "/" + std::to_string(group.shown), box, true, hint);
    if (box.Contains(ImGui::GetMousePos())) {
      pointed = hint;
    }
    const float text_x = x + s.Px(12);
    const float next = n + 1 < groups.size()
                           ? scale.X(lane.marks[groups[n + 1].shown].at_s) - s.Px(12)
                           : scale.area.right();
    // How many lie under it is told before what it says.
    const std::string more =
        group.all.size() > 1 ? "+" + std::to_string(group.all.size() - 1) : std::string();
    for (const std::string& words : {mark.text + (more.empty() ? "" : " " + more), more}) {
      const float end = text_x + TextWidth(s.caption, words);
      const bool touches_cursor = cursor_x > text_x - s.Px(6) && cursor_x < end + s.Px(6);
      if (!words.empty() && end <= std::min(next, scale.area.right()) && !touches_cursor) {
        DrawText(ui, s.caption, s.palette.text2, text_x, row.centre().y, words);
        break;
      }
    }
  }
  return pointed;
}

/// The lanes: press and drag seek, the wheel zooms about the pointer; Left and Right step by 0.1 s
/// (with Shift 1 s), Up and Down zoom about the cursor.
void RunLanes(UiFrame& ui, const Scale& scale, const TimelineView& view, TimelineState& state) {
  const Interaction in =
      Interact(ui, "timeline", scale.area,
               kAllSteps | kKeepsStop | (view.can_seek ? 0U : unsigned{kDisabled}),
               TimeLabel(view.position_s, true));
  if (in.held) {
    Seek(ui, view, std::clamp(scale.T(in.pointer.x), scale.from_s, scale.to_s), state);
  }
  if (in.wheel != 0) {
    Zoom(view, scale.T(in.pointer.x), std::pow(kZoomStep, static_cast<double>(in.wheel)), state);
  }
  if (in.step_right != 0) {
    ui.intents.push_back(PlaybackControl{PlaybackControl::Kind::kPause, 0});
    Seek(ui, view, view.position_s + kStep_s * in.step_right, state);
  }
  if (in.step_up != 0) {
    Zoom(view, view.position_s, std::pow(kZoomStep, in.step_up), state);
  }
}

}  // namespace

std::string TimeLabel(double seconds, bool tenths) {
  const double t = std::isfinite(seconds) ? std::max(0.0, seconds) : 0;
  // Round first: 59.96 s must not read "00:60.0".
  const long total = tenths ? std::lround(t * 10) : std::lround(t) * 10;
  char text[32];
  if (tenths) {
    std::snprintf(text, sizeof text, "%02ld:%02ld.%ld", total / 600, total / 10 % 60, total % 10);
  } else {
    std::snprintf(text, sizeof text, "%02ld:%02ld", total / 600, total / 10 % 60);
  }
  return text;
}

void DrawTimeline(UiFrame& ui, const Rect& rect, const TimelineView& view, TimelineState& state) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  if (!state.zoomed || state.to_s > view.duration_s || state.to_s <= state.from_s) {
    state.from_s = 0;
    state.to_s = std::max(view.duration_s, 1e-3);
    state.zoomed = false;
  }
  if (!ImGui::IsMouseDown(0)) {
    state.last_seek_s = -1;
  }
  const float names = s.Px(128);
  const Rect overview{rect.x + names, rect.y, rect.w - names, s.Px(32)};
  DrawText(ui, s.caption, p.text2, rect.x, overview.centre().y, "Whole flight");
  DrawOverview(ui, overview, view, state);
  const float ruler_y = overview.bottom() + s.Px(4);
  const Scale scale{
      {overview.x, ruler_y, overview.w, rect.bottom() - ruler_y}, state.from_s, state.to_s};
  DrawRuler(ui, {{overview.x, ruler_y, overview.w, s.Px(20)}, state.from_s, state.to_s},
            view.position_s);
  const float cursor_x = std::round(scale.X(view.position_s));
  const float lanes_y = ruler_y + s.Px(20);
  const auto room = static_cast<std::size_t>((rect.bottom() + 1 - lanes_y) / s.Px(24));
  const auto lanes_h = s.Px(24) * static_cast<float>(std::min(room, view.lanes.size()));
  const Scale lanes{{scale.area.x, lanes_y, scale.area.w, lanes_h}, scale.from_s, scale.to_s};
  HatchGaps(s, lanes, view);
  float y = lanes_y;
  std::string pointed;
  const ImVec2 pointer = ImGui::GetMousePos();
  for (const Lane& lane : view.lanes) {
    const Rect row{overview.x, y, overview.w, s.Px(24)};
    if (row.bottom() > rect.bottom() + 1) {
      break;
    }
    // Under the pointer the lane says its value, however short the stretch is.
    const std::string value =
        row.Contains(pointer) ? ValueAt(lane, scale.T(pointer.x)) : std::string();
    const std::string said = value.empty() ? lane.name : lane.name + ": " + value;
    DrawText(ui, s.caption, value.empty() ? p.text2 : p.text1, rect.x, row.centre().y,
             FitWords(s.caption, said, names - s.Px(4)));
    FillRect(Canvas(), {row.x, row.bottom() - s.Px(1), row.w, s.Px(1)}, p.plot_grid);
    for (const LaneSegment& segment : lane.segments) {
      DrawSegment(ui, scale, row, segment, cursor_x);
    }
    pointed += DrawMarks(ui, scale, row, lane, cursor_x);
    ui.items.Add("lane/" + lane.name, row, true, said);
    y = row.bottom();
  }
  NameGaps(ui, lanes, view);
  if (cursor_x >= scale.area.x && cursor_x <= scale.area.right()) {
    FillRect(Canvas(), {cursor_x - s.Px(1), ruler_y + s.Px(14), s.Px(2), y - ruler_y - s.Px(14)},
             p.white_mark);
    Canvas()->AddTriangleFilled({cursor_x - s.Fine(6), ruler_y + s.Fine(10)},
                                {cursor_x + s.Fine(6), ruler_y + s.Fine(10)},
                                {cursor_x, ruler_y + s.Fine(18)}, p.white_mark);
  }
  RunLanes(ui,
           {{scale.area.x, scale.area.y, scale.area.w, y - scale.area.y}, scale.from_s, scale.to_s},
           view, state);
  if (!pointed.empty() && !ImGui::IsMouseDown(0)) {
    DrawTooltip(ui, pointed);
  }
}

}  // namespace palace
