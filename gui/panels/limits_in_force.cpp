#include <algorithm>
#include <array>
#include <cmath>

#include "engine/model/mission/map_age.h"
#include "gui/panels/arrival.h"
#include "gui/panels/fly_panels.h"
#include "gui/widgets/evidence_row.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

/// From the top, whoever acts on them. The engine gives the place as one of the first two.
constexpr std::array kFirst = {LimitId::kOffPath,     LimitId::kFromCentre,  LimitId::kDescentRate,
                               LimitId::kCoherence,   LimitId::kResidual,    LimitId::kClearRadius,
                               LimitId::kProbability, LimitId::kSlope,       LimitId::kWind,
                               LimitId::kRoughness,   LimitId::kStep,        LimitId::kGroundAge,
                               LimitId::kApproach,    LimitId::kVisionOutage};

/// Of the site, as its newest map shows it.
bool IsOfMap(LimitId id) { return id >= LimitId::kSlope && id <= LimitId::kApproach; }

/// What is over its limit, then the list above, then every other limit that somebody enforces.
/// `landed`: that list alone, of the descent that is over. `map_age`: "8.8 s old" of a map too old
/// to tell what is; empty while it is new.
std::vector<EvidenceRow> RowsToShow(const std::vector<LimitRow>& limits, bool landed,
                                    const std::string& map_age) {
  std::vector<const LimitRow*> order;
  const auto add = [&](const LimitRow* limit) {
    if (limit != nullptr && std::find(order.begin(), order.end(), limit) == order.end()) {
      order.push_back(limit);
    }
  };
  for (const LimitId id : kFirst) {
    add(FindLimit(limits, id));
  }
  for (const LimitRow& limit : limits) {
    add(!landed && limit.enforced_by != EnforcedBy::kNobody ? &limit : nullptr);
  }
  std::stable_partition(order.begin(), order.end(),
                        [](const LimitRow* limit) { return limit->over; });
  std::vector<EvidenceRow> rows;
  for (const LimitRow* limit : order) {
    rows.push_back(RowOf(*limit));
    if (landed && std::isfinite(limit->limit)) {  // the limit that it was under
      rows.back().limit = (limit->is_least ? "min " : "max ") + LimitWords(*limit);
    }
    if (IsOfMap(limit->id)) {
      rows.back().age = map_age;
    }
  }
  return rows;
}

}  // namespace

void DrawLimitsInForcePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow,
                            RowScroll& scroll, UiFrame& ui) {
  const Style& s = ui.style;
  const std::vector<LimitRow>& limits = snap.flight->mission.limits;
  const auto over =
      std::count_if(limits.begin(), limits.end(), [](const LimitRow& limit) { return limit.over; });
  const auto unknown = std::count_if(limits.begin(), limits.end(), [](const LimitRow& limit) {
    return limit.enforced_by != EnforcedBy::kNobody && std::isnan(limit.value);
  });
  const bool measured = std::any_of(limits.begin(), limits.end(), [](const LimitRow& limit) {
    return limit.enforced_by != EnforcedBy::kNobody && std::isfinite(limit.value);
  });
  // Of the vehicle's own place: without it nothing here says what is.
  const Arrival pose = ArrivalOf(snap, ChannelId::kVehiclePose, ui.silent_s);
  const bool old = pose.state == ChannelHealth::State::kStale;
  std::string fact = measured ? "All inside" : "Nothing measured";
  // On the ground nobody enforces any of them; the mission keeps them as the last turn in the air
  // told them.
  const bool landed = snap.flight->mission.state == MissionState::kLanded;
  if (landed) {
    fact = "None in force";
  } else if (snap.flight->mission.state == MissionState::kAborting) {
    fact = "Waved off";
  } else if (old) {
    fact = "As of " + pose.age + " ago";
  } else if (over > 0) {
    fact = std::to_string(over) + " over a limit";
  } else if (unknown > 0) {
    fact = std::to_string(unknown) + " unknown";
  }
  const std::string map_age = !landed && IsMapOld(snap, ui.silent_s)
                                  ? AgeText(MapAge(snap) + ui.silent_s) + " old"
                                  : std::string();
  const std::vector<EvidenceRow> rows = RowsToShow(limits, landed, map_age);
  const Rect below_head = PanelContent(rect, s);
  const Rect area{below_head.x, below_head.y + s.Px(4), below_head.w, below_head.h - s.Px(4)};
  const std::string beyond = RowsBeyondWords(RowsBeyond(area, rows.size(), s, narrow));
  DrawPanelFrame(ui, rect, landed ? "Limits at touchdown" : "Limits in force",
                 {{beyond}, {fact, 0, old, old || over > 0}});
  DrawScrolledRows(ui, "limit_rows", area, rows, narrow, scroll);
  if (old) {
    StaleVeil(s, Canvas(), area);
  }
}

}  // namespace palace
