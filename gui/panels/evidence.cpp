#include <cmath>
#include <numbers>

#include "engine/core/units.h"
#include "engine/model/cell_explanation.h"
#include "gui/panels/fly_panels.h"
#include "gui/widgets/evidence_row.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

// Advice for the operator; no guard reads them. Wind: what the R-50's controllers hold in hover.
constexpr double kMaxWind_mps = 8;
constexpr double kMaxOffWind_deg = 60;

EvidenceRow MaxRow(std::string name, Figure figure, double limit, int decimals,
                   const std::string& unit) {
  const std::string gap = unit == "°" ? "" : " ";
  EvidenceRow row;
  row.name = std::move(name);
  row.share = ShareOfMax(figure.value, limit);
  row.value = FixedAgainst(figure.value, limit, row.share > 1, decimals);
  row.unit = unit;
  if (std::isfinite(figure.value) && figure.three_sigma > 0) {
    row.spread = "± " + Fixed(figure.three_sigma, decimals) + gap + unit;
    row.share_3s = figure.three_sigma / limit;
  }
  row.limit = "max " + Fixed(limit, DecimalsOf(limit, 0)) + gap + unit;
  return row;
}

Figure Scaled(const Figure& figure, double factor) {
  return {figure.value * factor, figure.three_sigma * factor};
}

/// Angle between the approach and the direction the wind comes from.
double OffWindDeg(const EngineSnapshot& snap, const LandingSite& site) {
  if (!snap.vehicle || !snap.pose) {
    return NAN;
  }
  const Eigen::Vector3d way = site.p_WS - snap.pose->X_WB.p;
  if (way.head<2>().norm() < 0.5) {
    return NAN;
  }
  const double heading = std::atan2(way.y(), way.x());
  return std::abs(Deg(WrapAngle(heading - snap.vehicle->wind_from_rad)));
}

EvidenceRow ClearRow(const LandingSite& site) {
  EvidenceRow row;
  row.name = "Clear radius";
  row.share = ShareOfMin(site.safe_distance_m, site.clear_radius_m);
  row.value = FixedAgainst(site.safe_distance_m, site.clear_radius_m, row.share > 1, 1);
  row.unit = "m";
  row.limit = "min " + Fixed(site.clear_radius_m, DecimalsOf(site.clear_radius_m, 1)) + " m";
  return row;
}

EvidenceRow UnknownRow(const LandingSite& site, double cell_m) {
  const double radius = site.clear_radius_m / std::max(cell_m, 1e-3);
  EvidenceRow row;
  row.name = "Unknown cells";
  row.value =
      std::to_string(site.unknown_cells) + " of " + Fixed(std::numbers::pi * radius * radius, 0);
  row.limit = "max 0";
  row.share = site.unknown_cells == 0 ? 0.0 : 10.0;
  return row;
}

/// "040°", as headings are read.
std::string HeadingText(double heading_rad) {
  const int degrees = static_cast<int>(std::lround(Deg(heading_rad)));
  const std::string digits = std::to_string(((degrees % 360) + 360) % 360);
  return std::string(3 - digits.size(), '0') + digits + "°";
}

/// At the worst heading of the lander, where the gear is known.
EvidenceRow ProbabilityRow(const LandingSite& site, double limit) {
  EvidenceRow row;
  row.name = "Safe probability";
  row.value = Fixed(site.safe_probability, 3);
  if (std::isfinite(site.touchdown.worst_heading_rad)) {
    row.spread = "at " + HeadingText(site.touchdown.worst_heading_rad);
  }
  row.limit = "min " + Fixed(limit, 3);
  row.share = ShareOfProbability(site.safe_probability, limit);
  return row;
}

/// "Gear: worst heading 040°, best 130° with 1.000."; empty when not known.
std::string GearWords(const LandingSite& site) {
  const TouchdownOdds& odds = site.touchdown;
  if (!std::isfinite(odds.worst_heading_rad) || !std::isfinite(odds.best_heading_rad)) {
    return "";
  }
  return "Safe at the worst heading; best " + HeadingText(odds.best_heading_rad) + " with " +
         Fixed(odds.best_probability, 3) + ".";
}

std::vector<EvidenceRow> RowsOf(const EngineSnapshot& snap, const LandingSite& site, bool folded) {
  const TerrainDecision* shown = ShownDecision(snap);
  const SladSettings& slad = shown != nullptr ? shown->settings : snap.settings.slad;
  const double rough_cm = slad.limits.max_deviation_m * 100;
  const double wind = snap.vehicle ? snap.vehicle->wind_speed_mps : NAN;
  std::vector<EvidenceRow> rows;
  rows.push_back(
      MaxRow("Slope", Scaled(site.slope_rad, kDegPerRad), slad.limits.max_slope_deg, 1, "°"));
  rows.push_back(MaxRow("Roughness", Scaled(site.roughness_m, 100), rough_cm, 1, "cm"));
  if (!folded) {
    rows.push_back(
        MaxRow("Largest step", Scaled(site.step_m, 100), slad.limits.max_step_m * 100, 1, "cm"));
  }
  rows.push_back(ClearRow(site));
  if (!folded) {
    const GridGeometry geometry =
        shown != nullptr && shown->hazards ? shown->hazards->geometry : GridGeometry{};
    rows.push_back(UnknownRow(site, geometry.rows > 0 ? geometry.cell_m : slad.grid.cell_m));
  }
  rows.push_back(
      ProbabilityRow(site, RequiredSafeProbability(slad, site.roughness_m.three_sigma / 3)));
  rows.push_back(
      MaxRow("Height noise, 3σ", {site.height_m.three_sigma * 100, 0}, rough_cm, 1, "cm"));
  rows.push_back(MaxRow("Wind", {wind, 0}, kMaxWind_mps, 1, "m/s"));
  if (!folded) {
    rows.push_back(
        MaxRow("Approach off wind", {OffWindDeg(snap, site), 0}, kMaxOffWind_deg, 0, "°"));
  }
  return rows;
}

}  // namespace

void DrawEvidencePanel(const EngineSnapshot& snap, const Rect& rect, bool folded, bool narrow,
                       std::uint64_t highlighted, UiFrame& ui) {
  const Style& s = ui.style;
  const LandingSite* site = SiteInView(snap, highlighted);
  if (site == nullptr) {
    DrawPanelFrame(ui, rect, "Evidence");
    DrawText(ui, s.body, s.palette.text2, rect.x + s.Px(12), rect.y + s.Px(48),
             "No site to show evidence for.");
    return;
  }
  const bool frozen = snap.mission.armed.has_value();
  const std::string age =
      AgeText(SecondsBetween(frozen ? snap.mission.armed_at : site->map_time, snap.time));
  const Rect content =
      DrawPanelFrame(ui, rect, std::string("Evidence for site ") + site->letter,
                     {{frozen ? "Frozen " + age + " ago" : "Map " + age + " ago"}});
  const std::vector<EvidenceRow> rows = RowsOf(snap, *site, folded);
  const Rect area{content.x, content.y + s.Px(4), content.w, content.h - s.Px(4)};
  DrawEvidenceRows(ui, area, rows, narrow);
  const float foot = area.y + EvidenceRowHeight(s, narrow) * static_cast<float>(rows.size());
  if (rect.bottom() - foot > s.Px(28)) {
    DrawText(ui, s.caption, s.palette.text2, rect.x + s.Px(12), foot + s.Px(14),
             "Share of limit used; whisker 3σ; white line: the limit.");
  }
  const std::string gear = GearWords(*site);
  if (rect.bottom() - foot > s.Px(46) && !gear.empty()) {
    DrawText(ui, s.caption, s.palette.text2, rect.x + s.Px(12), foot + s.Px(32), gear);
  }
}

}  // namespace palace
