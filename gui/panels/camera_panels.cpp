#include <algorithm>
#include <cmath>

#include "gui/panels/arrival.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/terrain_views.h"
#include "gui/panels/track_view.h"
#include "gui/widgets/button.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

void DrawMissing(UiFrame& ui, const EngineSnapshot& snap, const Rect& image) {
  UnknownFill(ui.style, Canvas(), image);
  TextPlate(ui, image, Corner::kBottomLeft, NoPictureWords(snap));
}

bool TrackerShown(const EngineSnapshot& snap) {
  const MissionState state = snap.flight->mission.state;
  return IsFlying(state) || state == MissionState::kHold;
}

SiteOverlay OverlayOf(const EngineSnapshot& snap, std::uint64_t highlighted) {
  SiteOverlay overlay;
  const TerrainDecision* known = SitesInForce(snap);
  const bool descent = IsDescentView(snap);
  overlay.sites = known != nullptr && !descent ? &known->selection.sites : nullptr;
  overlay.mission = descent ? nullptr : &snap.flight->mission;
  if (const LandingSite* site = SiteInView(snap, 0)) {
    overlay.selected = *site;
  }
  overlay.highlighted = highlighted;
  overlay.commanded = IsCommanded(snap.flight->mission);
  return overlay;
}

/// The range map was measured in the picture that is shown.
bool RangesAreOfPicture(const EngineSnapshot& snap) {
  return snap.terrain->range && snap.sensors->frame &&
         snap.terrain->range->time == snap.sensors->frame->time;
}

/// "Depth" switches the tint by the range map; beside it the colours' ends, or how old the last
/// ranges are: those are of another picture, and not laid over this one. The chip appears with the
/// pointer or the focus, so that the picture stays free, above the scale bar.
void DrawDepthChip(const EngineSnapshot& snap, UiFrame& ui, const Rect& image, CameraState& state) {
  const Style& s = ui.style;
  const Rect chip{image.x + s.Px(8), image.bottom() - s.Px(76), s.Px(64), s.Px(24)};
  ButtonLook look;
  look.active = state.show_depth;
  look.unseen = !state.show_depth && !Interact(ui, "left_camera", image, kPassive).hovered;
  if (DrawButton(ui, "depth", chip, "Depth", look)) {
    state.show_depth = !state.show_depth;
  }
  if (!state.show_depth || ui.textures.range_tint == nullptr) {
    return;
  }
  if (!RangesAreOfPicture(snap)) {
    const std::string words =
        snap.terrain->range
            ? "Last depth " + AgeText(SecondsBetween(snap.terrain->range->time, snap.time)) + " ago"
            : "No depth yet";
    const Rect plate{chip.right() + s.Px(6), chip.y, TextWidth(s.caption, words) + s.Px(16),
                     chip.h};
    FillRect(Canvas(), plate, picture::kPlate, s.Fine(3));
    DrawText(ui, s.caption, picture::kPlateText, plate.centre().x, plate.centre().y, words,
             Align::kCentre);
    return;
  }
  const std::string near = Fixed(static_cast<double>(ui.textures.range_near_m), 1) + " m";
  const std::string far = Fixed(static_cast<double>(ui.textures.range_far_m), 1) + " m+";
  const float near_w = TextWidth(s.caption, near), far_w = TextWidth(s.caption, far);
  const Rect bar{chip.right() + s.Px(22) + near_w, chip.centre().y - s.Px(4), s.Px(96), s.Px(8)};
  FillRect(Canvas(),
           {chip.right() + s.Px(6), chip.y, bar.right() + s.Px(16) + far_w - chip.right() - s.Px(6),
            chip.h},
           picture::kPlate, s.Fine(3));
  DrawRampBar(Canvas(), bar, Ramp::kElevation);
  DrawText(ui, s.caption, picture::kPlateText, bar.x - s.Px(8), chip.centre().y, near,
           Align::kRight);
  DrawText(ui, s.caption, picture::kPlateText, bar.right() + s.Px(8), chip.centre().y, far);
}

std::string LeftFact(const EngineSnapshot& snap, double silent_s) {
  if (TrackerShown(snap) && snap.flight->tracker.locked) {
    const std::size_t features = snap.flight->tracker.features.size();
    const std::string some =
        features > kFeaturesDrawn ? ", " + std::to_string(kFeaturesDrawn) + " drawn" : "";
    return "Tracking " + std::to_string(snap.flight->tracker.inliers) + " of " +
           std::to_string(features) + " features" + some;
  }
  return LaserPlate(snap, silent_s);
}

}  // namespace

Rect PictureRect(const Rect& content, double aspect) {
  const float by_width = std::round(content.w / static_cast<float>(aspect));
  if (by_width <= content.h + 1) {
    return {content.x, content.y, content.w, std::min(by_width, content.h)};
  }
  const float w = std::round(content.h * static_cast<float>(aspect));
  return {std::round(content.x + (content.w - w) / 2), content.y, w, content.h};
}

Rect LeftCameraImage(const EngineSnapshot& snap, const Rect& panel, const Style& style) {
  const auto camera = LeftCamera(snap);
  const double aspect = camera ? static_cast<double>(camera->width) / camera->height : 4.0 / 3;
  return PictureRect(PanelContent(panel, style), aspect);
}

void DrawLeftCameraPanel(const EngineSnapshot& snap, const Rect& rect, CameraState& state,
                         const MapProbe& probe, UiFrame& ui) {
  const Style& s = ui.style;
  const Arrival arrival = ArrivalOf(snap, ChannelId::kCameraLeft, ui.silent_s);
  DrawPanelFrame(ui, rect, "Left camera",
                 {{arrival.age, 0, true, arrival.late()}, {arrival.rate, 0, true, false}});
  OfferTrackView("Left camera", rect, state.track_view, ui);
  const auto camera = LeftCamera(snap);
  const Rect image = LeftCameraImage(snap, rect, s);
  ui.items.Add("left_camera", image, true, "");
  if (ui.textures.left_camera == nullptr || !camera) {
    DrawMissing(ui, snap, image);
    DrawDepthChip(snap, ui, image, state);
    return;
  }
  ImDrawList* dl = Canvas();
  dl->PushClipRect(image.min(), image.max(), true);
  dl->AddImage(ui.textures.left_camera, image.min(), image.max());
  if (state.show_depth && ui.textures.range_tint != nullptr && RangesAreOfPicture(snap)) {
    dl->AddImage(ui.textures.range_tint, image.min(), image.max());
  }
  const TerrainDecision* shown = snap.terrain->Shown();
  DrawCurrentVerdict(ui, image, snap, shown, state.overlay);
  const PictureView view{*camera, snap.sensors->X_WC, image};
  if (!state.track_view && TrackerShown(snap)) {
    DrawTracker(ui, view, snap.flight->tracker);
  }
  DrawSites(ui, view, OverlayOf(snap, ui.highlighted_site));
  if (state.track_view) {
    DrawTrackMarks(snap, view, ui);  // over the ring's own middle
  }
  DrawProbeOnPicture(ui, view, shown, probe);
  DrawStale(ui, image, snap, arrival);
  if (!snap.session->missing_inputs.empty()) {
    TextPlate(ui, image, Corner::kTopLeft, "For maps is missing: " + snap.session->missing_inputs);
  }
  if (state.track_view) {
    DrawTrackLegend(snap, image, ui);
  }
  DrawVerdictPlate(ui, image, snap, shown, state.overlay.legend);
  DrawDepthChip(snap, ui, image, state);
  if (snap.terrain->preview) {
    PreviewChip(ui, {image.right() - s.Px(92), image.y + s.Px(8)});
  }
  const LandingSite* site = SiteInView(snap, 0);
  if (site != nullptr) {
    DrawScaleBar(ui, image, view.ScaleOfPicture(site->p_WS));
  }
  TextPlate(
      ui, image, Corner::kBottomRight,
      state.track_view ? TrackFact(snap, RoomForTrackFact(image), s) : LeftFact(snap, ui.silent_s));
  if (state.track_view) {
    DrawCoherences(snap, view, ui);
  }
  dl->PopClipRect();
}

void DrawRightCameraPanel(const EngineSnapshot& snap, const Rect& rect, const MapProbe& probe,
                          UiFrame& ui) {
  const Arrival arrival = ArrivalOf(snap, ChannelId::kCameraRight, ui.silent_s);
  const Rect content =
      DrawPanelFrame(ui, rect, "Right camera",
                     {{arrival.age, 0, true, arrival.late()}, {arrival.rate, 0, true, false}});
  const auto camera = LeftCamera(snap);
  const double aspect = camera ? static_cast<double>(camera->width) / camera->height : 4.0 / 3;
  const Rect image = PictureRect(content, aspect);
  ui.items.Add("right_camera", image, true, "");
  if (ui.textures.right_camera == nullptr) {
    DrawMissing(ui, snap, image);
    return;
  }
  ImDrawList* dl = Canvas();
  dl->AddImage(ui.textures.right_camera, image.min(), image.max());
  if (camera) {
    if (const auto view = RightView(snap, {*camera, snap.sensors->X_WC, image}, image)) {
      DrawProbeOnPicture(ui, *view, snap.terrain->Shown(), probe);
    }
  }
  DrawStale(ui, image, snap, arrival);
  const LandingSite* site = SiteInView(snap, 0);
  if (image.w < ui.style.Px(300)) {
    return;  // plates would hide a small picture
  }
  if (camera && site != nullptr) {
    const PictureView view{*camera, snap.sensors->X_WC, image};
    DrawScaleBar(ui, image, view.ScaleOfPicture(site->p_WS));
  }
  // Of another picture it says nothing here; Diagnose tells it with its age.
  if (RangesAreOfPicture(snap) && std::isfinite(snap.terrain->stereo_quality.row_error_px)) {
    TextPlate(ui, image, Corner::kBottomRight,
              "Row error " + Fixed(snap.terrain->stereo_quality.row_error_px, 2) + " px");
  }
}

}  // namespace palace
