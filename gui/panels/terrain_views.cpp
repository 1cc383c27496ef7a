#include "gui/panels/terrain_views.h"

#include <algorithm>
#include <cmath>

#include "gui/panels/arrival.h"
#include "gui/panels/session_words.h"
#include "gui/panels/track_view.h"
#include "gui/widgets/map/flag_marks.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

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

const LandingSite* BestSite(const EngineSnapshot& snap, const TerrainDecision* decision) {
  return decision != nullptr ? snap.flight->mission.BestStanding(decision->selection.sites)
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

std::string LetterOf(const LandingSite* site) {
  return site != nullptr ? site->letter : std::string("none");
}

double AgeBehindPicture(const EngineSnapshot& snap, const TerrainDecision* decision) {
  if (decision == nullptr) {
    return NAN;
  }
  return SecondsBetween(decision->map_time,
                        snap.sensors->frame ? snap.sensors->frame->time : snap.time);
}

void DrawCurrentVerdict(UiFrame& ui, const Rect& image, const EngineSnapshot& snap,
                        const TerrainDecision* decision, OverlayCache& cache) {
  if (decision != nullptr && !(AgeBehindPicture(snap, decision) > kVerdictOld_s)) {
    DrawVerdict(ui, image, decision->verdict, cache);
    const auto camera = LeftCamera(snap);
    if (camera && decision->hazards && decision->elevation) {
      DrawFlagsOnPicture(ui.style, {*camera, snap.sensors->X_WC, image},
                         decision->hazards->geometry, decision->elevation->Measured(),
                         decision->hazards->flags);
    }
  }
}

void DrawVerdictPlate(UiFrame& ui, const Rect& image, const EngineSnapshot& snap,
                      const TerrainDecision* decision, LegendPlace& legend) {
  const double age_s = AgeBehindPicture(snap, decision);
  if (decision == nullptr) {
    TextPlate(ui, image, Corner::kTopLeft, NoMapWords(snap));
  } else if (age_s > kVerdictOld_s) {
    const std::string& why = snap.terrain->why_no_map;
    const std::string last = "Last map " + Duration(age_s) + " old";
    // The reason without what follows from it, where there is no room for both.
    const std::string brief = last + ". " + why.substr(0, why.find(','));
    const bool told =
        !why.empty() && (TextPlate(ui, image, Corner::kTopLeft, last + ". " + why).w > 0 ||
                         TextPlate(ui, image, Corner::kTopLeft, brief).w > 0);
    if (!told) {
      TextPlate(ui, image, Corner::kTopLeft, last);
    }
  } else {
    DrawVerdictLegend(ui, image, decision->hazards ? FlagsPresent(decision->hazards->flags) : 0U,
                      legend);
  }
}

std::string NoMapWords(const EngineSnapshot& snap) {
  return snap.terrain->why_no_map.empty() ? "No map yet" : snap.terrain->why_no_map;
}

std::string NoPictureWords(const EngineSnapshot& snap) {
  const ChannelHealth* left = FindChannel(snap.sensors->channels, ChannelId::kCameraLeft);
  if (FollowsRecord(snap.session->role) && left != nullptr &&
      left->state != ChannelHealth::State::kNever) {
    return "No picture here, the last came " + AgeText(left->age_s) + " before";
  }
  return snap.session->missing_inputs.empty() ? "No picture yet"
                                              : "Missing: " + snap.session->missing_inputs;
}

void DrawLeftPicture(UiFrame& ui, const Rect& area, const EngineSnapshot& snap,
                     const LeftPicture& look, OverlayCache& cache) {
  const Style& s = ui.style;
  const Rect image = FitPicture(area, snap);
  const auto camera = LeftCamera(snap);
  if (ui.textures.left_camera == nullptr || !camera) {
    UnknownFill(s, Canvas(), image);
    TextPlate(ui, image, Corner::kBottomLeft, NoPictureWords(snap));
    return;
  }
  ImDrawList* dl = Canvas();
  dl->PushClipRect(image.min(), image.max(), true);
  dl->AddImage(ui.textures.left_camera, image.min(), image.max());
  const PictureView view{*camera, snap.sensors->X_WC, image};
  if (look.decision != nullptr) {
    DrawCurrentVerdict(ui, image, snap, look.decision, cache);
    SiteOverlay overlay;
    overlay.sites = &look.decision->selection.sites;
    if (const LandingSite* best = BestSite(snap, look.decision)) {
      overlay.selected = *best;
    }
    const LandingSite* ghost = BestSite(snap, look.ghost);
    if (ghost != nullptr && (!overlay.selected || SitesDiffer(*overlay.selected, *ghost))) {
      overlay.ghost = *ghost;
      overlay.ghost_words = std::string(look.ghost_word) + " " + ghost->letter;
    }
    MarkLanding(snap, overlay);
    overlay.landing_word = LandingWord(snap.flight->mission);
    DrawSites(ui, view, overlay);
    if (overlay.selected) {
      DrawScaleBar(ui, image, view.ScaleOfPicture(overlay.selected->p_WS));
    }
  }
  if (look.track_view) {
    DrawTrackMarks(snap, view, ui);
  }
  if (look.probe != nullptr) {
    DrawProbeOnPicture(ui, view, look.decision, *look.probe);
  }
  DrawStale(ui, image, snap, ArrivalOf(snap, ChannelId::kCameraLeft, ui.silent_s));
  dl->PopClipRect();
  if (look.track_view) {
    DrawTrackLegend(snap, image, ui);
  }
  DrawVerdictPlate(ui, image, snap, look.decision, cache.legend);
  if (look.preview) {
    PreviewChip(ui, {image.right() - s.Px(92), image.y + s.Px(8)});
  }
  const std::string plate =
      look.track_view ? TrackFact(snap, RoomForTrackFact(image), s) : look.plate;
  if (!plate.empty()) {
    TextPlate(ui, image, Corner::kBottomRight, plate);
  }
  if (look.track_view) {
    DrawCoherences(snap, view, ui);
  }
  ui.items.Add("picture/left", image, true, "Left camera");
}

void DrawPlainPicture(UiFrame& ui, const Rect& area, const EngineSnapshot& snap,
                      ImTextureID texture, const std::string& plate, const MapProbe* probe) {
  const Rect image = FitPicture(area, snap);
  if (texture == nullptr) {
    UnknownFill(ui.style, Canvas(), image);
    TextPlate(ui, image, Corner::kBottomLeft, NoPictureWords(snap));
    return;
  }
  Canvas()->AddImage(texture, image.min(), image.max());
  const auto camera = LeftCamera(snap);
  if (probe != nullptr && camera) {
    if (const auto view = RightView(snap, {*camera, snap.sensors->X_WC, image}, image)) {
      DrawProbeOnPicture(ui, *view, snap.terrain->Shown(), *probe);
    }
  }
  DrawStale(ui, image, snap, ArrivalOf(snap, ChannelId::kCameraRight, ui.silent_s));
  if (!plate.empty()) {
    TextPlate(ui, image, Corner::kBottomRight, plate);
  }
}

}  // namespace palace
