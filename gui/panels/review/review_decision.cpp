// Review: what was decided at the time shown, by the record and by the reviewer's limits.
#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/units.h"
#include "engine/model/find_site.h"
#include "engine/model/size_words.h"
#include "gui/panels/review/review.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

constexpr const char* kUnknown = "––";

/// Words of one column of the table.
struct Column {
  std::string head, best = kUnknown, clear = kUnknown, slope = kUnknown, rough = kUnknown,
                    area = kUnknown, decision = kUnknown;
};

/// Of a LandingSite, or of the RecordedPlace that the record lists: a map that was rebuilt after a
/// jump is not the one that was flown on.
template <typename Place>
void FillFigures(const Place& place, Column& column) {
  column.clear = Fixed(place.safe_distance_m, 1) + " m";
  column.slope = SizeWords(place.slope_rad, kDegPerRad, "°", 1);
  column.rough = SizeWords(place.roughness_m, 100, " cm", 1);
}

void FillFromSite(const LandingSite* site, Column& column) {
  if (site != nullptr) {
    column.best = site->letter;
    FillFigures(*site, column);
  }
}

/// "68 m²"; unknown stands without its unit.
std::string AreaWords(double area_m2) {
  return std::isfinite(area_m2) ? Fixed(area_m2, 0) + " m²" : std::string(kUnknown);
}

/// What the figures are of: the site that was selected or flown to, before that the best.
const char* SubjectWord(const MissionStatus& m) {
  return !m.armed                                                ? "Best site"
         : m.IsLook()                                            ? "Site looked at"
         : IsFlying(m.state) || m.state == MissionState::kLanded ? "Landing site"
                                                                 : "Selected site";
}

/// "Armed A": state and site of the mission, as the chain at the top says it.
std::string StateOf(const MissionStatus& m) {
  std::string words = MissionStateWord(m.state);
  if (m.armed) {
    words += " " + m.armed->letter;
  }
  return words;
}

/// The selected site on the newest map, as it was re-checked or listed.
const LandingSite* ArmedOnMap(const EngineSnapshot& snap, const LandingSite& armed) {
  const auto& now = snap.flight->mission.armed_now;
  return now ? &*now : FindSite(snap.terrain->OfRecord().get(), armed.id);
}

/// After a jump: nothing of the map that was rebuilt since, and what no message tells is unknown.
void FillFromRecord(const MissionStatus& m, const FlightRecord& record, Timestamp time,
                    Column& column) {
  const FlightRecordSample* sample = record.SampleAt(time);
  const std::string letter = m.armed             ? m.armed->letter
                             : sample != nullptr ? sample->best_site
                                                 : std::string();
  const RecordedProposal* proposal = record.ProposalAt(time);
  if (const RecordedPlace* place = proposal != nullptr ? proposal->Place(letter) : nullptr) {
    FillFigures(*place, column);
  }
}

Column InTheFlight(const EngineSnapshot& snap, const FlightRecord* record, bool rebuilding) {
  const MissionStatus& m = snap.flight->mission;
  const TerrainDecision* map = snap.terrain->OfRecord().get();
  Column column;
  column.head = FollowsRecord(snap.session->role) ? FlightWord(record) : "Now";
  column.decision = StateOf(m);
  if (IsOfRecordAlone(snap, record)) {
    FillFromRecord(m, *record, snap.time, column);
  } else if (!rebuilding) {
    column.area = AreaWords(SafeArea(map));
    column.best = LetterOf(BestSite(snap, map));
    FillFromSite(m.armed ? ArmedOnMap(snap, *m.armed) : BestSite(snap, map), column);
  }
  const FlightRecordSample* sample = record != nullptr ? record->SampleAt(snap.time) : nullptr;
  if (m.armed) {
    column.best = m.armed->letter;
  } else if (sample != nullptr) {
    column.best = !sample->best_site.empty() ? sample->best_site : "none";
    column.clear = !sample->best_site.empty() ? Fixed(sample->best_safe_distance_m, 1) + " m"
                                              : std::string(kUnknown);
  }
  return column;
}

/// What the flight's own limits make of the rebuilt map, where the flight's map said otherwise: so
/// much of the difference is none of the limits'. Empty where they agree as shown.
std::string RebuiltWords(const EngineSnapshot& snap, const Column& flown) {
  const auto& armed = snap.flight->mission.armed;
  const TerrainDecision* map = snap.terrain->OfRecord().get();
  Column rebuilt;
  FillFromSite(armed ? FindSite(map, armed->id) : BestSite(snap, map), rebuilt);
  if (flown.clear == kUnknown || rebuilt.clear == flown.clear) {
    return {};
  }
  return "On this map, rebuilt after a jump, the flight's limits " +
         (rebuilt.clear == kUnknown ? "do not list it. " : "give " + rebuilt.clear + " clear. ");
}

Column UnderOtherLimits(const EngineSnapshot& snap, std::string& reason) {
  const auto& armed = snap.flight->mission.armed;
  const TerrainDecision* map = snap.terrain->applied.get();
  const LandingSite* best = BestSite(snap, map);
  Column column;
  column.head = "Re-decided";
  column.area = AreaWords(SafeArea(map));
  column.best = LetterOf(best);
  // Decisions under other limits have the ids of the record.
  FillFromSite(armed ? FindSite(map, armed->id) : best, column);
  if (armed) {
    column.best = armed->letter;
  }
  const auto& review = snap.terrain->site_review;
  if (review) {
    column.decision = (review->kept ? "Keeps " : "Refuses ") + review->letter;
    const bool first = armed || best == nullptr || LetterOf(best) == review->letter;
    reason = (review->kept && !first ? LetterOf(best) + " ranks first. " : "") + review->reason;
  } else {
    column.decision = best != nullptr ? "Proposes " + LetterOf(best) : "No site";
  }
  return column;
}

/// Maps that the record holds after that time; empty where it tells of none.
std::optional<int> MapsAhead(const FlightRecord* record, Timestamp time) {
  if (record == nullptr || record->proposals.empty()) {
    return std::nullopt;
  }
  return static_cast<int>(
      std::count_if(record->proposals.begin(), record->proposals.end(),
                    [&](const RecordedProposal& proposal) { return proposal.map_time > time; }));
}

std::string WhyRebuilding(const EngineSnapshot& snap, const FlightRecord* record) {
  const int missing = snap.terrain->maps_to_rebuild;
  if (!snap.terrain->why_no_map.empty()) {
    return snap.terrain->why_no_map + "; after a jump none is here to show. Go back and play.";
  }
  const int ahead = snap.session->source.ended ? 0 : MapsAhead(record, snap.time).value_or(missing);
  if (ahead < missing) {
    return "After the jump the map lacks " + std::to_string(missing) + " frames, and " +
           (ahead == 0 ? std::string("none follows") : std::to_string(ahead) + " follow") +
           " in this log. Go back and play.";
  }
  return "After the jump the map is built anew: " + std::to_string(missing) +
         " frames still to come. Play on.";
}

/// Whole lines, as many as fit; the pointer reads the rest.
void DrawReason(UiFrame& ui, const std::string& reason, const Rect& area) {
  const Style& s = ui.style;
  const float pitch = s.Px(20);
  const float most = std::max(1.0F, std::floor((area.h - s.Px(8)) / pitch) + 1);
  const auto lines = WrapText(s.body, reason, area.w, static_cast<std::size_t>(most));
  float y = area.y;
  for (const std::string& line : lines) {
    DrawText(ui, s.body, s.palette.text2, area.x, y, line);
    y += pitch;
  }
  ui.items.Add("decision/reason", area, true, reason);
  const bool cut = lines != WrapText(s.body, reason, area.w);
  if (cut && Interact(ui, "decision/reason", area, kPassive).hovered) {
    DrawTooltip(ui, reason);
  }
}

}  // namespace

bool IsOfRecordAlone(const EngineSnapshot& snap, const FlightRecord* record) {
  return !SeenFromStart(snap.session->role) && record != nullptr && !record->samples.empty();
}

void DrawDecisionPanel(const EngineSnapshot& snap, const FlightRecord* record, const Rect& rect,
                       UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect content =
      DrawPanelFrame(ui, rect, "Decision at " + TimeLabel(snap.session->source.position_s, true));
  const bool rebuilding = snap.terrain->maps_to_rebuild > 0;
  const bool redecided = LimitsMoved(snap) > 0;
  std::string reason = rebuilding ? WhyRebuilding(snap, record) : std::string();
  const Column was = InTheFlight(snap, record, rebuilding);
  Column is;
  if (redecided && !rebuilding) {
    is = UnderOtherLimits(snap, reason);
    reason = (IsOfRecordAlone(snap, record) ? RebuiltWords(snap, was) : std::string()) + reason;
  }
  const struct {
    const char* name;
    const std::string &was, &is;
  } rows[] = {{"", was.head, is.head},
              {SubjectWord(snap.flight->mission), was.best, is.best},
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
  ui.items.Add("decision/figures", rect, true,
               was.clear + ", " + was.slope + ", " + was.rough + ", " + was.area);
  ui.items.Add("decision/now", rect, redecided, is.best + ", " + is.decision);
  DrawReason(ui, reason, {content.x + pad, y, content.w - 2 * pad, rect.bottom() - y});
}

}  // namespace palace
