#include "gui/panels/map_views.h"

#include <cmath>

#include "engine/core/units.h"
#include "engine/model/size_words.h"
#include "gui/render/map_scale.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

struct Layer {
  const char* key;
  const char* title;
  Ramp ramp;
};

Layer LayerOf(MapKind kind) {
  switch (kind) {
    case MapKind::kElevation:
      return {"elevation", "Elevation", Ramp::kElevation};
    case MapKind::kSlope:
      return {"slope", "Slope", Ramp::kSlope};
    case MapKind::kRoughness:
      return {"roughness", "Roughness", Ramp::kRoughness};
    case MapKind::kCost:
      return {"cost", "Cost", Ramp::kCost};
    case MapKind::kSafeDistance:
      break;
  }
  return {"safe_distance", "Safe distance", Ramp::kSafeDistance};
}

const GridF* ValuesOf(MapKind kind, const TerrainDecision& d) {
  if (kind == MapKind::kElevation) {
    return d.elevation ? &d.elevation->Measured() : nullptr;
  }
  if (!d.hazards) {
    return nullptr;
  }
  switch (kind) {
    case MapKind::kSlope:
      return &d.hazards->slope_rad;
    case MapKind::kRoughness:
      return &d.hazards->roughness_m;
    case MapKind::kCost:
      return &d.hazards->cost;
    default:
      return &d.hazards->safe_distance_m;
  }
}

/// A size that noise alone could make of nothing is told by what it is below: "< 2.0 cm".
std::string Size(const Figure& size, double factor, const char* unit) {
  const double below = KnownBelow(size);
  return std::isnan(below) ? Fixed(size.value * factor, 1) + unit
                           : "< " + Fixed(below * factor, 1) + unit;
}

Figure FigureAt(const GridF& values, const GridF& sigmas, Cell cell) {
  const double sigma = sigmas.rows() == values.rows() ? static_cast<double>(sigmas.at(cell)) : NAN;
  return {static_cast<double>(values.at(cell)), 3 * sigma};
}

std::string ValueText(MapKind kind, const TerrainDecision& d, const GridF& values, Cell cell) {
  const auto value = static_cast<double>(values.at(cell));
  if (!std::isfinite(value)) {
    return "––";
  }
  switch (kind) {
    case MapKind::kElevation:
      return Fixed(value, 2) + " m";
    case MapKind::kSlope:
      return Size(FigureAt(values, d.hazards->slope_sigma_rad, cell), kDegPerRad, "°");
    case MapKind::kRoughness:
      return Size(FigureAt(values, d.hazards->roughness_sigma_m, cell), 100, " cm");
    case MapKind::kCost:
      return Fixed(value, 2);
    case MapKind::kSafeDistance:
      break;
  }
  return Fixed(value, 1) + " m";
}

/// A limit as a colour bar shows it.
struct BarLimit {
  double value = 0;    ///< of the decision, in setting units
  double applied = 0;  ///< dashed where it differs
  double wanted = 0;   ///< of the setting that a drag moves
  double top = 0;      ///< end of the bar
  const char* setting = "";
  std::string label;
};

void FillLimit(const BarLimit& limit, LimitTick& tick) {
  tick.at = static_cast<float>(limit.value / limit.top);
  if (limit.applied != limit.value) {
    tick.applied_at = static_cast<float>(limit.applied / limit.top);
  }
  tick.label = limit.label;
  tick.setting = limit.setting;
  tick.value = limit.wanted;
  tick.per_bar = limit.top;
}

/// Ends of the colours and the limit between them.
void FillRange(MapKind kind, const SladSettings& now, const SladSettings& applied,
               const SladSettings& wanted, MapView& view) {
  const auto label = [](const char* which, double value, const char* unit) {
    return which + Fixed(value, DecimalsOf(value, 0)) + unit;
  };
  switch (kind) {
    case MapKind::kElevation:
      break;
    case MapKind::kSlope:
      view.low = "0°";
      view.high = Fixed(kSlopeLimitsShown * now.limits.max_slope_deg, 0) + "°+";
      FillLimit({now.limits.max_slope_deg, applied.limits.max_slope_deg,
                 wanted.limits.max_slope_deg, kSlopeLimitsShown * now.limits.max_slope_deg,
                 "slad.max_slope_deg", label("max ", now.limits.max_slope_deg, "°")},
                view.limit);
      break;
    case MapKind::kRoughness:
      view.low = "0 cm";
      view.high = Fixed(100 * kRoughnessLimitsShown * now.limits.max_deviation_m, 0) + " cm+";
      FillLimit({now.limits.max_deviation_m, applied.limits.max_deviation_m,
                 wanted.limits.max_deviation_m, kRoughnessLimitsShown * now.limits.max_deviation_m,
                 "slad.max_deviation_m", label("max ", 100 * now.limits.max_deviation_m, " cm")},
                view.limit);
      break;
    case MapKind::kCost:
      view.low = "0.0";
      view.limit.at = 1;
      view.limit.label = "limit 1.0";
      break;
    case MapKind::kSafeDistance:
      view.low = "0 m";
      view.high = Fixed(kClearRadiiShown * now.lander.clear_radius_m(), 1) + " m+";
      FillLimit(
          {now.lander.clear_radius_m(), applied.lander.clear_radius_m(), wanted.lander.nav_error_m,
           kClearRadiiShown * now.lander.clear_radius_m(), "slad.nav_error_m",
           "min " + Fixed(now.lander.clear_radius_m(), DecimalsOf(now.lander.clear_radius_m(), 1)) +
               " m"},
          view.limit);
      break;
  }
}

}  // namespace

MapView MakeMapView(MapKind kind, const MapSource& source, const PanelTextures& textures) {
  const Layer layer = LayerOf(kind);
  MapView view;
  view.key = layer.key;
  view.title = layer.title;
  view.ramp = layer.ramp;
  view.texture = textures.maps[static_cast<int>(kind)];
  view.value = "––";
  if (source.decision == nullptr) {
    return view;
  }
  const TerrainDecision& decision = *source.decision;
  view.values = ValuesOf(kind, decision);
  view.geometry = decision.hazards     ? decision.hazards->geometry
                  : decision.elevation ? decision.elevation->geometry
                                       : GridGeometry{};
  if (kind == MapKind::kSafeDistance && decision.hazards) {
    view.reasons = &decision.hazards->reasons;
  }
  view.old = std::isfinite(source.old_s) ? AgeText(source.old_s) + " old" : "";
  view.flags = decision.hazards ? &decision.hazards->flags : nullptr;
  const SladSettings& now = decision.settings;
  FillRange(kind, now, source.applied != nullptr ? *source.applied : now,
            source.wanted != nullptr ? *source.wanted : now, view);
  if (kind == MapKind::kElevation) {
    view.low = "≤" + Fixed(static_cast<double>(textures.elevation_low_m), 1) + " m";
    view.high = Fixed(static_cast<double>(textures.elevation_high_m), 1) + " m+";
  }
  std::optional<Cell> at = source.cursor;
  if (!at && source.site != nullptr && view.geometry.rows > 0) {
    at = view.geometry.CellFromPoint(source.site->p_WS.x(), source.site->p_WS.y());
    view.letter = source.site->letter;
  }
  if (at && view.values != nullptr && view.geometry.Contains(*at)) {
    view.value = ValueText(kind, decision, *view.values, *at);
  }
  return view;
}

double ShownMapAge(const EngineSnapshot& snap, double silent_s) { return MapAge(snap) + silent_s; }

MapSource ShownMap(const EngineSnapshot& snap, double silent_s) {
  MapSource source;
  source.old_s = IsMapOld(snap, silent_s) ? ShownMapAge(snap, silent_s) : NAN;
  source.decision = snap.terrain->Shown();
  source.applied =
      snap.terrain->preview && snap.terrain->applied ? &snap.terrain->applied->settings : nullptr;
  source.wanted = &snap.session->preview_settings.slad;
  return source;
}

}  // namespace palace
