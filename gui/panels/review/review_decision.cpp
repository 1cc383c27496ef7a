// Review: what was decided at the time shown, by the record and by the reviewer's limits.
#include <algorithm>

#include "engine/core/units.h"
#include "engine/model/size_words.h"
#include "gui/panels/review/review.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

constexpr const char* kUnknown = "––";

/// Words of one column of the table.
struct Column {
  std::string head, best = kUnknown, clear = kUnknown, slope = kUnknown, rough = kUnknown,
                    area = kUnknown, decision = kUnknown;
};

/// The record's own sample at that time; null where it tells none.
const FlightRecordSample* SampleAt(const FlightRecord* record, Timestamp time) {
  if (record == nullptr || record->samples.empty()) {
    return nullptr;
  }
  const auto after = std::upper_bound(
      record->samples.begin(), record->samples.end(), time,
      [](Timestamp t, const FlightRecordSample& sample) { return t < sample.time; });
  return after == record->samples.begin() ? nullptr : &*(after - 1);
}

void FillFigures(const EngineSnapshot& snap, const TerrainDecision* decision, Column& column) {
  column.area = Fixed(SafeArea(decision), 0) + " m²";
  const LandingSite* site = BestSite(snap, decision);
  column.best = LetterOf(site);
  if (site != nullptr) {
    column.clear = Fixed(site->safe_distance_m, 1) + " m";
    column.slope = SizeWords(site->slope_rad, kDegPerRad, "°", 1);
    column.rough = SizeWords(site->roughness_m, 100, " cm", 1);
  }
}

/// "Armed A": state and site of the mission, as the chain at the top says it.
std::string StateOf(const MissionStatus& m) {
  std::string words = MissionStateWord(m.state);
  if (m.armed) {
    words += " " + m.armed->letter;
  }
  return words;
}

Column InTheFlight(const EngineSnapshot& snap, const FlightRecord* record, bool rebuilding) {
  Column column;
  column.head = FollowsRecord(snap.session->role) ? FlightWord(record) : "Now";
  if (!rebuilding) {
    FillFigures(snap, snap.terrain->OfRecord().get(), column);
  }
  if (const FlightRecordSample* sample = SampleAt(record, snap.time)) {
    column.best = !sample->best_site.empty() ? sample->best_site : "none";
    column.clear = !sample->best_site.empty() ? Fixed(sample->best_safe_distance_m, 1) + " m"
                                              : std::string(kUnknown);
  }
  column.decision = StateOf(snap.flight->mission);
  return column;
}

Column UnderOtherLimits(const EngineSnapshot& snap, std::string& reason) {
  Column column;
  column.head = "Re-decided";
  FillFigures(snap, snap.terrain->applied.get(), column);
  const LandingSite* best = BestSite(snap, snap.terrain->applied.get());
  const auto& review = snap.terrain->site_review;
  if (review) {
    column.decision = (review->kept ? "Keeps " : "Refuses ") + review->letter;
    reason = review->reason;
  } else {
    column.decision = best != nullptr ? "Proposes " + LetterOf(best) : "No site";
  }
  return column;
}

std::string WhyRebuilding(const EngineSnapshot& snap) {
  return "After the jump the map is built anew: " + std::to_string(snap.terrain->maps_to_rebuild) +
         (snap.session->source.ended
              ? " frames are missing, and the log ends here. Go back and play."
              : " frames still to come. Play on.");
}

}  // namespace

void DrawDecisionPanel(const EngineSnapshot& snap, const FlightRecord* record, const Rect& rect,
                       UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect content =
      DrawPanelFrame(ui, rect, "Decision at " + TimeLabel(snap.session->source.position_s, true));
  const bool rebuilding = snap.terrain->maps_to_rebuild > 0;
  const bool redecided = LimitsMoved(snap) > 0;
  std::string reason = rebuilding ? WhyRebuilding(snap) : std::string();
  const Column was = InTheFlight(snap, record, rebuilding);
  Column is;
  if (redecided && !rebuilding) {
    is = UnderOtherLimits(snap, reason);
  }
  const struct {
    const char* name;
    const std::string &was, &is;
  } rows[] = {{"", was.head, is.head},
              {"Best site", was.best, is.best},
              {"Clear radius", was.clear, is.clear},
              {"Slope", was.slope, is.slope},
              {"Roughness", was.rough, is.rough},
              {"Safe area", was.area, is.area},
              {"Decision", was.decision, is.decision}};
  const float pad = s.Px(12);
  // Room for the seven rows and one line of reason, also in a narrow window.
  const float pitch = std::min(s.Px(25), std::floor((content.h - s.Px(34)) / 7));
  float y = content.y + s.Px(10);
  for (const auto& row : rows) {
    const bool head = row.name[0] == '\0';
    DrawText(ui, s.body, p.text2, content.x + pad, y, row.name);
    const float was_x = redecided ? content.right() - s.Px(130) : content.right() - pad;
    DrawText(ui, head ? s.caption : s.body, redecided || head ? p.text2 : p.text1, was_x, y,
             row.was, Align::kRight);
    if (redecided) {
      DrawText(ui, head ? s.caption : s.medium, head ? p.text2 : p.text1, content.right() - pad, y,
               row.is, Align::kRight);
    }
    y += pitch;
  }
  ui.items.Add("decision/recorded", rect, true, was.best + ", " + was.decision);
  ui.items.Add("decision/now", rect, redecided, is.best + ", " + is.decision);
  for (const std::string& line : WrapText(s.body, reason, content.w - 2 * pad)) {
    if (y + s.Px(8) > rect.bottom()) {
      break;
    }
    DrawText(ui, s.body, p.text2, content.x + pad, y, line);
    y += s.Px(20);
  }
}

}  // namespace palace
