#include <cmath>

#include "engine/core/units.h"
#include "gui/panels/fly_panels.h"
#include "gui/widgets/evidence_row.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr double kMaxResidual_sigma = 3;

/// The distance from the centre is a limit once the vehicle is to be above the site.
bool SettlesOrLater(VehicleMode mode) {
  return mode == VehicleMode::kSettle || mode == VehicleMode::kSink || mode == VehicleMode::kLanded;
}

EvidenceRow Row(std::string name, double value, double spread, int decimals, double limit,
                const std::string& unit, bool is_min = false) {
  const std::string gap = unit == "°" || unit.empty() ? "" : " ";
  EvidenceRow row;
  row.name = std::move(name);
  row.share = is_min ? ShareOfMin(value, limit) : ShareOfMax(value, limit);
  row.value = FixedAgainst(value, limit, row.share > 1, decimals);
  row.unit = unit;
  if (std::isfinite(value) && std::isfinite(spread) && spread > 0) {
    row.spread = "± " + Fixed(spread, decimals) + gap + unit;
    row.share_3s = spread / limit;
  }
  row.limit = (is_min ? "min " : "max ") +
              Fixed(limit, DecimalsOf(limit, limit >= 3 ? 0 : (unit.empty() ? 2 : 1))) + gap + unit;
  return row;
}

}  // namespace

void DrawLimitsInForcePanel(const EngineSnapshot& snap, const Rect& rect, bool narrow,
                            UiFrame& ui) {
  const Style& s = ui.style;
  const Settings& settings = snap.settings;
  const HistorySample now =
      snap.history && !snap.history->empty() ? snap.history->back() : HistorySample{};
  const PositionEstimate& estimate = snap.navigation.vision.estimate;
  const double position_3s = 3 * estimate.sigma_p_m.head<2>().norm();
  const double rate_3s = 3 * estimate.sigma_v_mps.z();
  std::vector<EvidenceRow> rows;
  const VehicleMode mode = snap.vehicle ? snap.vehicle->mode : VehicleMode::kUnknown;
  const bool landed = snap.mission.state == MissionState::kLanded;
  const bool moving_over = mode == VehicleMode::kSettle;
  if (SettlesOrLater(mode) || landed) {
    rows.push_back(
        Row("From centre", now.from_site_m, position_3s, 2, settings.slad.lander.nav_error_m, "m"));
    if (moving_over) {
      // Still on the level leg towards the site: the limit holds from where it sinks.
      rows.back().share = rows.back().share_3s = NAN;
      rows.back().limit = "moving over";
    }
  } else {
    rows.push_back(Row("Off the path", now.glide_deviation_m, position_3s, 2, kMaxOffPath_m, "m"));
  }
  rows.push_back(Row("Descent rate", now.descent_rate_mps, rate_3s, 2,
                     settings.mission.descent_rate_mps * 1.5, "m/s"));
  const bool locked = snap.tracker.locked;
  rows.push_back(Row("Coherence", locked ? snap.tracker.coherence : NAN, NAN, 2,
                     settings.tracking.min_coherence, "", true));
  rows.push_back(Row("Residual", locked ? snap.navigation.vision.residual_sigma : NAN, NAN, 1,
                     kMaxResidual_sigma, "σ"));
  const TerrainDecision* shown = ShownDecision(snap);
  const LandingSite* site = SiteInView(snap, 0);
  for (std::size_t i = 0; shown != nullptr && site != nullptr && i < shown->selection.sites.size();
       ++i) {
    if (shown->selection.sites[i].id == site->id) {
      site = &shown->selection.sites[i];  // the newest map's figures, not the frozen ones
      break;
    }
  }
  if (site != nullptr) {
    if (!narrow) {
      rows.push_back(Row("Slope", Deg(site->slope_rad.value), Deg(site->slope_rad.three_sigma), 1,
                         settings.slad.limits.max_slope_deg, "°"));
      rows.push_back(Row("Roughness", site->roughness_m.value * 100,
                         site->roughness_m.three_sigma * 100, 1,
                         settings.slad.limits.max_deviation_m * 100, "cm"));
    }
    rows.push_back(
        Row("Clear radius", site->safe_distance_m, NAN, 1, site->clear_radius_m, "m", true));
  }
  rows.push_back(Row("Wind", snap.vehicle ? snap.vehicle->wind_speed_mps : NAN, NAN, 1, 8, "m/s"));
  int over = 0;
  int unknown = 0;
  for (const EvidenceRow& row : rows) {
    over += row.share > 1 ? 1 : 0;
    unknown += std::isfinite(row.share) ? 0 : 1;
  }
  unknown -= moving_over ? 1 : 0;
  std::string fact = "All inside";
  if (over > 0) {
    fact = std::to_string(over) + " over a limit";
  } else if (landed) {
    fact = "On the ground";
  } else if (unknown > 0) {
    fact = std::to_string(unknown) + " unknown";
  }
  const Rect content = DrawPanelFrame(ui, rect, "Limits in force", {{fact, 0, false, over > 0}});
  DrawEvidenceRows(ui, {content.x, content.y + s.Px(4), content.w, content.h}, rows, narrow);
}

}  // namespace palace
