#include <array>
#include <cmath>
#include <utility>

#include "engine/core/units.h"
#include "engine/model/mission/map_age.h"
#include "gui/panels/fly_panels.h"
#include "gui/widgets/evidence_row.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

/// "Gear: worst heading 040°, best 130° with 1.000."; empty when not known.
std::string GearWords(const LandingSite& site) {
  const TouchdownOdds& odds = site.touchdown;
  if (!std::isfinite(odds.worst_heading_rad) || !std::isfinite(odds.best_heading_rad)) {
    return "";
  }
  return "Safe at the worst heading; best " + HeadingText(odds.best_heading_rad) + " with " +
         Fixed(odds.best_probability, 3) + ".";
}

/// The site's figures from the top, then what the mission says of the air; folded: what the folded
/// panel shows first, and the rest below.
std::vector<EvidenceRow> RowsOf(const EngineSnapshot& snap, const LandingSite& site, bool folded) {
  constexpr std::array kSite = {
      LimitId::kSlope,        LimitId::kRoughness,   LimitId::kStep,        LimitId::kClearRadius,
      LimitId::kUnknownCells, LimitId::kProbability, LimitId::kHeightNoise, LimitId::kAirSeen};
  const auto in_folded = [](const LimitRow& limit) {
    return limit.over || (limit.id != LimitId::kStep && limit.id != LimitId::kUnknownCells &&
                          limit.id != LimitId::kOffWind);
  };
  const MissionStatus& mission = snap.flight->mission;
  const TerrainDecision* known = SitesInForce(snap);
  // What is frozen stands under the limits that it was frozen with; nothing under a preview's.
  const std::vector<LimitRow> limits = mission.armed      ? mission.armed_limits
                                       : known != nullptr ? SiteLimits(site, known->settings)
                                                          : std::vector<LimitRow>{};
  std::vector<EvidenceRow> rows, below;
  const auto add = [&](const LimitRow* limit, const auto& change) {
    if (limit != nullptr) {
      EvidenceRow row = RowOf(*limit);
      change(row);
      (folded && !in_folded(*limit) ? below : rows).push_back(std::move(row));
    }
  };
  for (const LimitId id : kSite) {
    add(FindLimit(limits, id), [&](EvidenceRow& row) {
      // At the worst heading of the lander, where the gear is known.
      if (id == LimitId::kProbability && std::isfinite(site.touchdown.worst_heading_rad)) {
        row.spread = "at " + HeadingText(site.touchdown.worst_heading_rad);
      }
    });
  }
  for (const LimitId id : {LimitId::kWind, LimitId::kOffWind}) {
    add(FindLimit(snap.flight->mission.limits, id), [&](EvidenceRow& row) {
      row.name += mission.armed ? " now" : "";  // among frozen figures
    });
  }
  rows.insert(rows.end(), below.begin(), below.end());
  return rows;
}

}  // namespace

void DrawEvidencePanel(const EngineSnapshot& snap, const Rect& rect, bool folded, bool narrow,
                       std::uint64_t highlighted, RowScroll& scroll, UiFrame& ui) {
  const Style& s = ui.style;
  const LandingSite* site = SiteInView(snap, highlighted);
  if (site == nullptr) {
    DrawPanelFrame(ui, rect, "Evidence");
    DrawText(ui, s.body, s.palette.text2, rect.x + s.Px(12), rect.y + s.Px(48),
             snap.flight->mission.state == MissionState::kAborting
                 ? "In a wave-off no site is proposed."
                 : "No site to show evidence for.");
    return;
  }
  const bool frozen = snap.flight->mission.armed.has_value();
  const bool old = !frozen && IsMapOld(snap, ui.silent_s);
  const std::string age =
      AgeText(SecondsBetween(frozen ? snap.flight->mission.armed_at : site->map_time, snap.time) +
              ui.silent_s);
  const std::vector<EvidenceRow> rows = RowsOf(snap, *site, folded);
  const Rect below_head = PanelContent(rect, s);
  const Rect area{below_head.x, below_head.y + s.Px(4), below_head.w, below_head.h - s.Px(4)};
  const std::size_t beyond = RowsBeyond(area, rows.size(), s, narrow);
  DrawPanelFrame(ui, rect, std::string("Evidence for site ") + site->letter,
                 {{RowsBeyondWords(beyond), s.palette.text1, true, false},
                  {(frozen ? "Frozen " : "Map ") + age + " ago", 0, old, old}});
  DrawScrolledRows(ui, "evidence_rows", area, rows, narrow, scroll);
  const float foot =
      area.y + EvidenceRowHeight(s, narrow) * static_cast<float>(rows.size() - beyond);
  if (rect.bottom() - foot > s.Px(28)) {
    DrawText(ui, s.caption, s.palette.text2, rect.x + s.Px(12), foot + s.Px(14),
             "Share used; whisker 3σ; line: the limit; at: worst heading; who acts.");
  }
  const std::string gear = GearWords(*site);
  if (rect.bottom() - foot > s.Px(46) && !gear.empty()) {
    DrawText(ui, s.caption, s.palette.text2, rect.x + s.Px(12), foot + s.Px(32), gear);
  }
}

}  // namespace palace
