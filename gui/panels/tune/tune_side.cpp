// Right column of Tune: cells, site chosen, history, apply.
#include <cmath>

#include "engine/core/hash.h"
#include "engine/model/mission/map_age.h"
#include "engine/model/site_standing.h"
#include "gui/panels/tune/tune.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

/// Cells of one kind, with what they were under the applied limits.
struct CellCount {
  const char* name;
  int now = 0;
  int before = 0;
  ImU32 fill = 0;
  ImU32 hatch = 0;
};

/// The classes of the ground, as maps and pictures draw them; `split`: hazards by what they are.
std::vector<CellCount> CountCells(const Style& s, const TuneFacts& f, bool split) {
  using Ground = GroundClass;
  const HazardMaps none;
  const HazardMaps& now = f.shown != nullptr && f.shown->hazards ? *f.shown->hazards : none;
  const HazardMaps& was = f.applied != nullptr && f.applied->hazards ? *f.applied->hazards : now;
  const Palette& p = s.palette;
  std::vector<CellCount> cells;
  const auto add = [&](Ground ground, const char* name, ImU32 fill, ImU32 hatch) {
    cells.push_back({name, now.counts[ground], was.counts[ground], fill, hatch});
  };
  add(Ground::kLandable, GroundClassWord(Ground::kLandable), p.bar, 0);
  if (split) {
    cells.push_back({"Over slope", now.rejected.slope, was.rejected.slope, 0, p.unsafe});
    cells.push_back({"Over roughness", now.rejected.roughness, was.rejected.roughness,
                     WithAlpha(p.unsafe, 0.35f), p.unsafe});
    cells.push_back(
        {"Flagged", now.rejected.flagged, was.rejected.flagged, WithAlpha(p.unsafe, 0.7f), 0});
    cells.push_back({"Not sure enough", now.rejected.doubtful, was.rejected.doubtful,
                     WithAlpha(p.unsafe, 0.2f), 0});
  } else {
    add(Ground::kHazard, GroundClassWord(Ground::kHazard), 0, p.unsafe);
  }
  add(Ground::kTooNear, GroundClassWord(Ground::kTooNear), p.hover, 0);
  add(Ground::kFootprint, GroundClassWord(Ground::kFootprint), p.hover, p.line);
  add(Ground::kUnknown, GroundClassWord(Ground::kUnknown), picture::kUnknown,
      picture::kUnknownLine);
  return cells;
}

void DrawSwatch(const Style& s, const Rect& box, const CellCount& c) {
  FillRect(Canvas(), box, c.fill != 0 ? c.fill : s.palette.window);
  if (c.hatch != 0) {
    Hatch(Canvas(), box, c.hatch, s.Fine(1.5f), s.Px(6));
  }
}

std::string Signed(int value) {
  return value > 0 ? "+" + Fixed(value, 0) : (value == 0 ? std::string("0") : Fixed(value, 0));
}

/// What the apply panel says and whether its buttons work.
struct ApplyWords {
  std::string sentence;
  std::string detail;
  std::string state;
  bool can_apply = false;
  bool can_discard = false;
  std::string why_not;
};

/// "site A"; of a place that the flight has not named "a new place, +1".
std::string PlaceName(const LandingSite& site) {
  return IsNamedSite(site.id) ? "site " + site.letter : "a new place, " + site.letter;
}

std::string RankEffect(const TuneFacts& f) {
  const LandingSite* was = f.best_applied;
  const LandingSite* is = f.best_shown;
  if (was == nullptr && is == nullptr) {
    return "No site either way. ";
  }
  if (is == nullptr) {
    return std::string("Site ") + was->letter + " is lost, no site remains. ";
  }
  if (was == nullptr) {
    return "Found: " + PlaceName(*is) + ". ";
  }
  if (was->id != is->id) {
    return std::string("Site ") + was->letter + " loses its rank to " + PlaceName(*is) + ". ";
  }
  return std::string("Site ") + is->letter + " stays first. ";
}

ApplyWords WordsFor(const EngineSnapshot& snap, const TuneFacts& f) {
  const SessionPart& session = *snap.session;
  const bool at_once = session.limits_apply == LimitsApply::kAtOnce;
  const bool not_now = session.limits_apply == LimitsApply::kNotNow;
  const std::string hash =
      (session.recording ? "Recorded with hash " : "Hash ") + ShortHash(session.preview_hash) + ".";
  ApplyWords w;
  w.why_not = "Nothing waits to be applied";
  if (at_once) {
    w.state = "Applies at once";
    w.sentence = "Limits apply at once.";
    const std::string& ended = snap.flight->mission.selection_ended;
    w.detail = ended + (ended.empty() ? "" : " ") +
               "A moved limit judges the newest map, and all after it. " + hash;
    return w;
  }
  if (f.pending == 0) {
    w.state = "No preview";
    w.sentence = "Nothing waits to be applied.";
    w.detail = not_now ? "While descending, a moved limit is a preview only."
                       : "A moved limit is a preview until you apply it.";
    return w;
  }
  const std::string count = std::to_string(f.pending) + (f.pending == 1 ? " change" : " changes");
  w.state = "Preview, not applied";
  w.can_discard = true;
  if (not_now) {
    w.sentence = count + ", preview only.";
    w.detail = RankEffect(f) + "The descent keeps the limits it was approved under.";
    w.why_not = "Not while descending";
    return w;
  }
  w.can_apply = true;
  const auto& armed = snap.flight->mission.armed;
  w.sentence = session.apply_drops && armed
                   ? std::string("Applying ends the selection of ") + armed->letter + "."
                   : count + (f.pending == 1 ? " waits" : " wait") + " to be applied.";
  w.detail = RankEffect(f) + hash;
  return w;
}

/// "Max slope", "7 limits" and from where to where.
void DrawStep(UiFrame& ui, const Rect& row, const SettingStep& step, bool undone) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const SettingChange& first = step.changes.front();
  const SettingInfo* info = FindSetting(first.name);
  if (info == nullptr) {
    return;
  }
  const bool one = step.changes.size() == 1;
  const std::string name = one ? info->label : std::to_string(step.changes.size()) + " limits";
  std::string change =
      one ? FormatSetting(*info, first.before) + " to " + FormatSetting(*info, first.after) : "";
  if (undone) {
    change += one ? ", undone" : "undone";
  }
  const float middle = row.centre().y;
  const float x = row.x + s.Px(16);
  const float name_x =
      x + DrawText(ui, s.mono, p.text2, x, middle, ClockText(step.time)) + s.Px(16);
  const float name_end =
      name_x + DrawText(ui, s.body, undone ? p.text3 : p.text1, name_x, middle, name);
  if (row.right() - s.Px(12) - TextWidth(s.caption, change) > name_end + s.Px(8)) {
    DrawText(ui, s.caption, undone ? p.text3 : p.text1, row.right() - s.Px(12), middle, change,
             Align::kRight);
  }
}

}  // namespace

void DrawCellsPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const TuneFacts facts = FactsOf(snap);
  constexpr float kHead = 28 + 4 + 14 + 8, kRow = 17;
  const std::vector<CellCount> counts = CountCells(s, facts, rect.h >= s.Px(kHead + 8 * kRow));
  int total = 0;
  for (const CellCount& c : counts) {
    total += c.now;
  }
  const Rect content =
      DrawPanelFrame(ui, rect, facts.previewing ? "Cells in preview" : "Cells",
                     {{total > 0 ? Fixed(total, 0) + " cells" : "no map yet", 0, false, false}});
  const float pad = s.Px(12);
  const Rect bar{content.x + pad, content.y + s.Px(4), content.w - 2 * pad, s.Px(14)};
  if (total == 0) {
    UnknownFill(s, Canvas(), bar);
  }
  float x = bar.x;
  for (const CellCount& c : counts) {
    const float w =
        total > 0 ? bar.w * static_cast<float>(c.now) / static_cast<float>(total) : 0.0f;
    if (w >= 1) {
      DrawSwatch(s, {x, bar.y, w - 1, bar.h}, c);
    }
    x += w;
  }
  const float row = std::min(
      s.Px(25), (rect.bottom() - bar.bottom() - s.Px(8)) / static_cast<float>(counts.size()));
  float y = bar.bottom() + s.Px(4);
  for (const CellCount& c : counts) {
    const float middle = y + row / 2;
    DrawSwatch(s, {bar.x, std::round(middle - s.Px(6)), s.Px(12), s.Px(12)}, c);
    DrawText(ui, s.body, p.text2, bar.x + s.Px(22), middle, c.name);
    DrawText(ui, s.medium, p.text1, bar.x + bar.w * 0.74f, middle,
             total > 0 ? Fixed(c.now, 0) : "––", Align::kRight);
    ui.items.Add(std::string("cells/") + c.name, {bar.x, y, bar.w, row}, true, Fixed(c.now, 0));
    if (facts.previewing) {
      DrawText(ui, s.body, p.text2, bar.right(), middle,
               Signed(c.now - c.before) + (std::abs(c.now - c.before) == 1 ? " cell" : " cells"),
               Align::kRight);
    }
    y += row;
  }
}

void DrawChosenPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const TuneFacts facts = FactsOf(snap);
  const LandingSite* best = facts.best_shown;
  const Rect content =
      DrawPanelFrame(ui, rect, facts.previewing ? "Site chosen in preview" : "Site chosen");
  const float x = content.x + s.Px(12);
  if (best == nullptr) {
    const std::string why = facts.shown != nullptr && !facts.shown->selection.none_reason.empty()
                                ? "No site listed: " + facts.shown->selection.none_reason + "."
                                : "No site yet.";
    float y = content.y + s.Px(14);
    for (const std::string& line : WrapText(s.body, why, content.w - s.Px(24))) {
      DrawText(ui, s.body, p.text1, x, y, line);
      y += s.Px(20);
    }
    return;
  }
  const float middle = content.y + s.Px(16);
  LetterPlate(ui, {x + s.Px(10), middle}, best->letter, true);
  DrawText(ui, s.medium, p.text1, x + s.Px(30), middle,
           Fixed(best->safe_distance_m, 1) + " m clear");
  DrawText(ui, s.caption, p.text2, content.right() - s.Px(12), middle,
           IsMapOld(snap, ui.silent_s) ? "Old map"
                                       : StandingWord(StandingOf(*best, facts.shown->settings)),
           Align::kRight);
  float y = content.y + s.Px(42);
  const std::string reason = best->reason.empty() ? "Best of the newest map." : best->reason + ".";
  for (const std::string& line : WrapText(s.body, reason, content.w - s.Px(24))) {
    if (y + s.Px(8) > rect.bottom()) {
      break;
    }
    DrawText(ui, s.body, p.text2, x, y, line);
    y += s.Px(20);
  }
  if (facts.previewing && facts.applied != nullptr && y + s.Px(8) < rect.bottom()) {
    DrawText(ui, s.body, p.text1, x, y, RankEffect(facts));
  }
}

void DrawHistoryPanel(const EngineSnapshot&, const Rect& rect, const TuneState& state,
                      UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect content = DrawPanelFrame(ui, rect, "History", {{"Ctrl+Z", 0, false, false}});
  const std::vector<SettingStep>& steps = state.history.steps();
  if (steps.empty()) {
    DrawText(ui, s.body, p.text2, content.x + s.Px(12), content.y + s.Px(14),
             "No limit moved yet. Drag a slider.");
    return;
  }
  float y = content.y;
  for (std::size_t i = steps.size(); i-- > 0;) {
    const Rect row{content.x, y, content.w, s.Px(28)};
    if (row.bottom() > rect.bottom()) {
      break;
    }
    y = row.bottom();
    if (i + 1 == state.history.done()) {  // what Ctrl+Z takes back
      FillRect(Canvas(), row, p.hover);
      FillRect(Canvas(), {row.x, row.y, s.Px(4), row.h}, p.white_mark);
    }
    DrawStep(ui, row, steps[i], i >= state.history.done());
  }
}

void DrawApplyPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const TuneFacts facts = FactsOf(snap);
  const ApplyWords words = WordsFor(snap, facts);
  const Rect content = DrawPanelFrame(ui, rect, "Apply", {{words.state, 0, false, false}});
  const bool wide = rect.w > s.Px(600);
  const float pad = s.Px(12);
  const float text_w = wide ? content.w - s.Px(420) : content.w - 2 * pad;
  float y = content.y + s.Px(14);
  for (const std::string& line : WrapText(s.section, words.sentence, text_w)) {
    DrawText(ui, s.section, p.text1, content.x + pad, y, line);
    y += s.Px(24);
  }
  for (const std::string& line : WrapText(s.body, words.detail, text_w)) {
    if (y + s.Px(8) > (wide ? rect.bottom() : rect.bottom() - s.Px(84))) {
      break;
    }
    DrawText(ui, s.body, p.text2, content.x + pad, y, line);
    y += s.Px(20);
  }
  const float h = s.Px(wide ? 52 : 68);
  const float row_y = wide ? std::round(content.centre().y - h / 2) : rect.bottom() - pad - h;
  const float left = wide ? rect.right() - s.Px(396) : rect.x + pad;
  const float discard_w = s.Px(wide ? 120 : 112);
  ButtonLook discard;
  discard.enabled = words.can_discard;
  discard.font = s.medium;
  discard.reason = words.why_not;  // read only where it is disabled
  if (DrawButton(ui, "discard", {left, row_y, discard_w, h}, "Discard", discard)) {
    ui.intents.push_back(CommandAction(DiscardSettings{}));
  }
  const Rect apply{left + discard_w + s.Px(12), row_y,
                   rect.right() - pad - left - discard_w - s.Px(12), h};
  const std::string label = !words.can_discard ? "Apply"
                                               : "Apply " + std::to_string(facts.pending) +
                                                     (facts.pending == 1 ? " change" : " changes");
  if (!words.can_apply) {
    ButtonLook look;
    look.enabled = false;
    look.font = s.medium;
    look.sub = words.why_not;
    look.reason = words.why_not;
    DrawButton(ui, "apply", apply, label, look);
    return;
  }
  const Interaction in = Interact(ui, "apply", apply, 0, label);
  FillRect(Canvas(), apply, in.hovered ? p.bar : p.go, s.Fine(4));
  StrokeRect(Canvas(), apply, p.safe, s.Fine(2), s.Fine(4));
  DrawText(ui, s.button, p.on_go, apply.centre().x, apply.centre().y - s.Px(9), label,
           Align::kCentre);
  DrawText(ui, s.caption, p.on_go, apply.centre().x, apply.centre().y + s.Px(13), "One click",
           Align::kCentre);
  if (in.clicked) {
    ui.intents.push_back(CommandAction(ApplySettings{}));
  }
}

}  // namespace palace
