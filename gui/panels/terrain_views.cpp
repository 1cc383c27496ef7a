#include "gui/panels/terrain_views.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"
#include "gui/widgets/map/flag_marks.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

struct Layer {
  const char* key;
  const char* title;
  Ramp ramp;
  int texture;
};

Layer LayerOf(MapKind kind) {
  switch (kind) {
    case MapKind::kElevation:
      return {"elevation", "Elevation", Ramp::kElevation, 0};
    case MapKind::kSlope:
      return {"slope", "Slope", Ramp::kSlope, 1};
    case MapKind::kRoughness:
      return {"roughness", "Roughness", Ramp::kRoughness, 2};
    case MapKind::kCost:
      return {"cost", "Cost", Ramp::kCost, 3};
    case MapKind::kSafeDistance:
      break;
  }
  return {"safe_distance", "Safe distance", Ramp::kSafeDistance, 4};
}

const GridF* ValuesOf(MapKind kind, const TerrainDecision& d) {
  if (kind == MapKind::kElevation) {
    return d.elevation ? &d.elevation->height_m : nullptr;
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

std::string ValueText(MapKind kind, double value) {
  switch (kind) {
    case MapKind::kElevation:
      return Fixed(value, 2) + " m";
    case MapKind::kSlope:
      return Fixed(Deg(value), 1) + "°";
    case MapKind::kRoughness:
      return Fixed(value * 100, 1) + " cm";
    case MapKind::kCost:
      return Fixed(value, 2);
    case MapKind::kSafeDistance:
      break;
  }
  return Fixed(value, 1) + " m";
}

/// Range of the colours: slope 0..2 limits, roughness 0..2.5, safe distance 0..2.5 clear radii, as
/// the pictures are coloured.
void FillRange(MapKind kind, const SladSettings& now, const SladSettings* applied, MapView& view) {
  LimitTick& tick = view.limit;
  const auto limit = [&](double value, double top, double before) {
    tick.at = static_cast<float>(value / top);
    if (applied != nullptr && before != value) {
      tick.applied_at = static_cast<float>(before / top);
    }
  };
  switch (kind) {
    case MapKind::kElevation:
      break;
    case MapKind::kSlope:
      view.low = "0°";
      view.high = Fixed(2 * now.max_slope_deg, 0) + "°+";
      limit(now.max_slope_deg, 2 * now.max_slope_deg,
            applied != nullptr ? applied->max_slope_deg : 0);
      tick.label = "max " + Fixed(now.max_slope_deg, 1) + "°";
      tick.setting = "slad.max_slope_deg";
      tick.value = now.max_slope_deg;
      tick.per_bar = 2 * now.max_slope_deg;
      break;
    case MapKind::kRoughness:
      view.low = "0 cm";
      view.high = Fixed(250 * now.max_deviation_m, 0) + " cm+";
      limit(now.max_deviation_m, 2.5 * now.max_deviation_m,
            applied != nullptr ? applied->max_deviation_m : 0);
      tick.label = "max " + Fixed(100 * now.max_deviation_m, 1) + " cm";
      tick.setting = "slad.max_deviation_m";
      tick.value = now.max_deviation_m;
      tick.per_bar = 2.5 * now.max_deviation_m;
      break;
    case MapKind::kCost:
      view.low = "0.0";
      tick.at = 1;
      tick.label = "limit 1.0";
      break;
    case MapKind::kSafeDistance:
      view.low = "0 m";
      view.high = Fixed(2.5 * now.clear_radius_m(), 1) + " m+";
      limit(now.clear_radius_m(), 2.5 * now.clear_radius_m(),
            applied != nullptr ? applied->clear_radius_m() : 0);
      tick.label = "min " + Fixed(now.clear_radius_m(), 1) + " m";
      break;
  }
}

Rect FitPicture(const Rect& area, const EngineSnapshot& snap) {
  const auto camera = LeftCamera(snap);
  const float aspect = camera && camera->height > 0
                           ? static_cast<float>(camera->width) / static_cast<float>(camera->height)
                           : 4.0f / 3.0f;
  const float w = std::min(area.w, std::floor(area.h * aspect));
  const float h = std::floor(w / aspect);
  return {std::round(area.x + (area.w - w) / 2), area.y, w, h};
}

}  // namespace

const LandingSite* BestSite(const TerrainDecision* decision) {
  return decision != nullptr && !decision->selection.sites.empty()
             ? &decision->selection.sites.front()
             : nullptr;
}

bool SitesDiffer(const LandingSite& a, const LandingSite& b) {
  constexpr double kSamePlace_m = 0.3;
  return (a.p_WS - b.p_WS).head<2>().norm() > kSamePlace_m || a.clear_radius_m != b.clear_radius_m;
}

double SafeArea(const TerrainDecision* decision) {
  if (decision == nullptr || !decision->hazards) {
    return NAN;
  }
  const double cell_m = decision->hazards->geometry.cell_m;
  return decision->hazards->safe_cells * cell_m * cell_m;
}

std::string BestLetter(const TerrainDecision* decision) {
  const LandingSite* best = BestSite(decision);
  return best != nullptr ? std::string(1, best->letter) : std::string("none");
}

double MapAge(const EngineSnapshot& snap, const TerrainDecision* decision) {
  if (decision == nullptr) {
    return NAN;
  }
  return SecondsBetween(decision->map_time, snap.frame ? snap.frame->time : snap.time);
}

void DrawCurrentVerdict(UiFrame& ui, const Rect& image, const EngineSnapshot& snap,
                        const TerrainDecision* decision, OverlayCache& cache) {
  if (decision != nullptr && !(MapAge(snap, decision) > kOldMap_s)) {
    DrawVerdict(ui, image, decision->verdict, cache);
    const auto camera = LeftCamera(snap);
    if (camera && decision->hazards && decision->elevation) {
      DrawFlagsOnPicture(ui.style, {*camera, snap.X_WC, image}, decision->hazards->geometry,
                         decision->elevation->height_m, decision->hazards->flags);
    }
  }
}

void DrawVerdictPlate(UiFrame& ui, const Rect& image, const EngineSnapshot& snap,
                      const TerrainDecision* decision) {
  const double age_s = MapAge(snap, decision);
  if (decision == nullptr) {
    TextPlate(ui, image, Corner::kTopLeft, "No map yet");
  } else if (age_s > kOldMap_s) {
    TextPlate(ui, image, Corner::kTopLeft, "Last map " + Duration(age_s) + " old");
  } else {
    DrawVerdictLegend(ui, image, decision->hazards ? FlagsPresent(decision->hazards->flags) : 0U);
  }
}

MapView MakeMapView(MapKind kind, const TerrainDecision* decision, ImTextureID texture,
                    const SladSettings* applied, std::optional<Cell> cursor) {
  const Layer layer = LayerOf(kind);
  MapView view;
  view.key = layer.key;
  view.title = layer.title;
  view.ramp = layer.ramp;
  view.texture = texture;
  view.value = "––";
  if (decision == nullptr) {
    return view;
  }
  view.values = ValuesOf(kind, *decision);
  view.geometry = decision->hazards     ? decision->hazards->geometry
                  : decision->elevation ? decision->elevation->geometry
                                        : GridGeometry{};
  view.flags = decision->hazards ? &decision->hazards->flags : nullptr;
  FillRange(kind, decision->settings, applied, view);
  const LandingSite* best = BestSite(decision);
  if (view.values != nullptr && cursor && view.geometry.Contains(*cursor)) {
    view.value = ValueText(kind, static_cast<double>(view.values->at(*cursor)));
  } else if (view.values != nullptr && best != nullptr && view.geometry.Contains(best->cell)) {
    view.letter = best->letter;
    view.value = ValueText(kind, static_cast<double>(view.values->at(best->cell)));
  }
  return view;
}

void DrawLeftPicture(UiFrame& ui, const Rect& area, const EngineSnapshot& snap,
                     const LeftPicture& look, OverlayCache& cache) {
  const Style& s = ui.style;
  const Rect image = FitPicture(area, snap);
  const auto camera = LeftCamera(snap);
  if (ui.textures.left_camera == nullptr || !camera) {
    UnknownFill(s, Canvas(), image);
    TextPlate(ui, image, Corner::kBottomLeft, "No picture yet");
    return;
  }
  ImDrawList* dl = Canvas();
  dl->PushClipRect(image.min(), image.max(), true);
  dl->AddImage(ui.textures.left_camera, image.min(), image.max());
  const PictureView view{*camera, snap.X_WC, image};
  if (look.decision != nullptr) {
    DrawCurrentVerdict(ui, image, snap, look.decision, cache);
    SiteOverlay overlay;
    overlay.sites = &look.decision->selection.sites;
    if (const LandingSite* best = BestSite(look.decision)) {
      overlay.selected = *best;
    }
    const LandingSite* ghost = BestSite(look.ghost);
    if (ghost != nullptr && (!overlay.selected || SitesDiffer(*overlay.selected, *ghost))) {
      overlay.ghost = *ghost;
      overlay.ghost_words = std::string(look.ghost_word) + " " + ghost->letter;
    }
    DrawSites(ui, view, overlay);
    if (overlay.selected) {
      DrawScaleBar(ui, image, view.PixelsPerMetre(overlay.selected->p_WS));
    }
  }
  if (look.probe != nullptr) {
    DrawProbeOnPicture(ui, view, look.decision, *look.probe);
  }
  dl->PopClipRect();
  DrawVerdictPlate(ui, image, snap, look.decision);
  if (look.preview) {
    PreviewChip(ui, {image.right() - s.Px(92), image.y + s.Px(8)});
  }
  if (!look.plate.empty()) {
    TextPlate(ui, image, Corner::kBottomRight, look.plate);
  }
  ui.items.Add("picture/left", image, true, "Left camera");
}

void DrawPlainPicture(UiFrame& ui, const Rect& area, const EngineSnapshot& snap,
                      ImTextureID texture, const std::string& plate, const MapProbe* probe) {
  const Rect image = FitPicture(area, snap);
  if (texture == nullptr) {
    UnknownFill(ui.style, Canvas(), image);
    TextPlate(ui, image, Corner::kBottomLeft, "No picture yet");
    return;
  }
  Canvas()->AddImage(texture, image.min(), image.max());
  const auto camera = LeftCamera(snap);
  if (probe != nullptr && camera) {
    if (const auto view = RightView(snap, {*camera, snap.X_WC, image}, image)) {
      DrawProbeOnPicture(ui, *view, snap.preview ? snap.preview.get() : snap.applied.get(), *probe);
    }
  }
  if (!plate.empty()) {
    TextPlate(ui, image, Corner::kBottomRight, plate);
  }
}

}  // namespace palace
