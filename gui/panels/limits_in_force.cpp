#include <array>
#include <cmath>

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

}  // namespace

void DrawLimitsInForcePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow,
                            UiFrame& ui) {
  std::vector<EvidenceRow> rows;
  int over = 0;
  int unknown = 0;
  for (const ShownLimit& shown : kShown) {
    const LimitRow* limit = FindLimit(snap.flight->mission.limits, shown.id);
    if (limit == nullptr || (narrow && shown.wide_only)) {
      continue;
    }
    rows.push_back(RowOf(*limit));
    over += limit->over ? 1 : 0;
    unknown += limit->enforced_by != EnforcedBy::kNobody && std::isnan(limit->value) ? 1 : 0;
  }
  std::string fact = "All inside";
  if (over > 0) {
    fact = std::to_string(over) + " over a limit";
  } else if (snap.flight->mission.state == MissionState::kLanded) {
    fact = "On the ground";
  } else if (unknown > 0) {
    fact = std::to_string(unknown) + " unknown";
  }
  const Rect content = DrawPanelFrame(ui, rect, "Limits in force", {{fact, 0, false, over > 0}});
  DrawEvidenceRows(ui, {content.x, content.y + ui.style.Px(4), content.w, content.h}, rows, narrow);
}

}  // namespace palace
