#include <algorithm>
#include <array>
#include <cmath>

#include "gui/panels/arrival.h"
#include "gui/panels/fly_panels.h"
#include "gui/widgets/evidence_row.h"

namespace palace {

namespace {

struct ShownLimit {
  LimitId id;
  bool wide_only = false;
};
/// From the top. The engine gives the place as one of the first two.
constexpr std::array kShown = {ShownLimit{LimitId::kOffPath},
                               ShownLimit{LimitId::kFromCentre},
                               ShownLimit{LimitId::kDescentRate},
                               ShownLimit{LimitId::kCoherence},
                               ShownLimit{LimitId::kResidual},
                               ShownLimit{LimitId::kSlope, true},
                               ShownLimit{LimitId::kRoughness, true},
                               ShownLimit{LimitId::kClearRadius},
                               ShownLimit{LimitId::kWind}};

/// The rows of the list, then whatever else is over its limit. Short of room, what is inside its
/// limit goes first, from the bottom.
std::vector<const LimitRow*> RowsToShow(const std::vector<LimitRow>& limits, bool narrow,
                                        std::size_t room) {
  std::vector<const LimitRow*> rows;
  for (const ShownLimit& shown : kShown) {
    const LimitRow* limit = FindLimit(limits, shown.id);
    if (limit != nullptr && (limit->over || !narrow || !shown.wide_only)) {
      rows.push_back(limit);
    }
  }
  for (const LimitRow& limit : limits) {
    if (limit.over && std::find(rows.begin(), rows.end(), &limit) == rows.end()) {
      rows.push_back(&limit);
    }
  }
  for (std::size_t i = rows.size(); i-- > 0 && rows.size() > room;) {
    if (!rows[i]->over) {
      rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  rows.resize(std::min(rows.size(), room));  // the head counts them all
  return rows;
}

}  // namespace

void DrawLimitsInForcePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow,
                            UiFrame& ui) {
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
  if (snap.flight->mission.state == MissionState::kLanded) {
    fact = "On the ground";
  } else if (snap.flight->mission.state == MissionState::kAborting) {
    fact = "Waved off";
  } else if (old) {
    fact = "As of " + pose.age + " ago";
  } else if (over > 0) {
    fact = std::to_string(over) + " over a limit";
  } else if (unknown > 0) {
    fact = std::to_string(unknown) + " unknown";
  }
  const Rect content =
      DrawPanelFrame(ui, rect, "Limits in force", {{fact, 0, old, old || over > 0}});
  const Rect area{content.x, content.y + s.Px(4), content.w, content.h - s.Px(4)};
  const auto room = static_cast<std::size_t>(std::max(area.h, 0.0f) / EvidenceRowHeight(s, narrow));
  std::vector<EvidenceRow> rows;
  for (const LimitRow* limit : RowsToShow(limits, narrow, room)) {
    rows.push_back(RowOf(*limit));
  }
  DrawEvidenceRows(ui, area, rows, narrow);
  if (old) {
    StaleVeil(s, Canvas(), area);
  }
}

}  // namespace palace
