#include "gui/app/view.h"

#include <algorithm>
#include <cmath>

#include "engine/core/time.h"
#include "engine/mission/leaving.h"
#include "engine/mission/way_rules.h"
#include "engine/slad/hazards/explanation.h"
#include "gui/app/key_help.h"
#include "gui/app/layout.h"
#include "gui/app/leave_dialog.h"
#include "gui/app/take_fonts.h"
#include "gui/app/toast.h"
#include "gui/app/view3d_input.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/fly_workspace.h"
#include "gui/widgets/button.h"
#include "gui/widgets/draw.h"
#include "gui/widgets/interact.h"

namespace palace {
namespace {

constexpr double kOrbitSettles_s = 0.5;  // the camera glides to a preset in less

ImTextureID Id(GLuint name) {
  return reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(name));
}

Palette PaletteOf(const std::string& theme) {
  if (theme == "light") {
    return MakeLightPalette();
  }
  return theme == "contrast" ? MakeHighContrastPalette() : MakeDarkPalette();
}

CellExplanation Explain(const TerrainDecision& decision, Cell cell) {
  return ExplainCell(*decision.elevation, *decision.hazards, decision.settings, cell);
}

/// The preset that the 3-D view is seen from.
std::optional<ViewPreset> PresetOf(const OrbitCamera& orbit) {
  if (!orbit.preset()) {
    return std::nullopt;
  }
  switch (*orbit.preset()) {
    case View3dPreset::kOrbit:
      return ViewPreset::kOrbit;
    case View3dPreset::kAbove:
      return ViewPreset::kAbove;
    case View3dPreset::kBehind:
    case View3dPreset::kOblique:
      break;
  }
  return ViewPreset::kBehind;
}

}  // namespace

Result<std::unique_ptr<View>> View::Create(const std::string& theme, const World* world,
                                           VehicleBody body) {
  Result<std::unique_ptr<View3dRenderer>> view3d = View3dRenderer::Create();
  if (!view3d) {
    return view3d.error();
  }
  std::unique_ptr<View> view(new View(std::move(*view3d)));
  view->style_.palette = PaletteOf(theme);
  view->body_ = body;
  if (world != nullptr) {
    view->world_ = std::make_unique<WorldViews>(*world, body);
  }
  return view;
}

double View::FittingScale(int width_px, int height_px, double wanted) {
  return palace::FittingScale(width_px, height_px, wanted);
}

void View::Fit(const UiState& state, const ViewFrame& frame) {
  style_.scale = static_cast<float>(FittingScale(frame.width_px, frame.height_px, state.scale));
}

Rect View::SceneRect(const EngineSnapshot& snapshot, const UiState& state,
                     const ViewFrame& frame) const {
  const double w = frame.width_px, h = frame.height_px, scale = style_.scale;
  if (state.frame.workspace == Workspace::kFly) {
    return View3dScene(ComputeFlyLayout(w, h, scale, ShowsDescent(snapshot)).view_3d, style_);
  }
  if (state.frame.workspace == Workspace::kReview && HasSource(snapshot.session->role)) {
    const Rect body = ComputeFrameLayout(w, h, scale).body;
    const Rect panel = LayReview(body, style_, state.review.picture).view_3d;
    return panel.h > 0 ? View3dScene(panel, style_) : Rect{};
  }
  return {};
}

void View::UploadPictures(const EngineSnapshot& snapshot, const UiState& state,
                          const ViewFrame& frame) {
  double camera_scale = 1;
  if (state.frame.workspace == Workspace::kFly && snapshot.sensors->left_rectified) {
    const FlyLayout fly =
        ComputeFlyLayout(frame.width_px, frame.height_px, style_.scale, ShowsDescent(snapshot));
    camera_scale = static_cast<double>(LeftCameraImage(snapshot, fly.left_camera, style_).w) /
                   snapshot.sensors->left_rectified->width();
  }
  textures_.ShowRange(state.fly.camera.show_depth);
  textures_.Update(snapshot, camera_scale);
  const TextureNames& names = textures_.names();
  ids_.left_camera = Id(names.left_camera);
  ids_.right_camera = Id(names.right_camera);
  for (std::size_t i = 0; i < names.maps.size(); ++i) {
    ids_.maps[i] = Id(names.maps[i]);
  }
  ids_.elevation_low_m = static_cast<float>(textures_.ranges().elevation_m.low);
  ids_.elevation_high_m = static_cast<float>(textures_.ranges().elevation_m.high);
  ids_.recorded_safe_distance = Id(names.recorded_safe_distance);
  ids_.difference = Id(names.difference);
  ids_.anchor_patch = Id(names.anchor_patch);
  ids_.current_patch = Id(names.current_patch);
  ids_.difference_patch = Id(names.difference_patch);
  ids_.range_tint = Id(names.range_tint);
  ids_.range_near_m = names.range_tint_m.low;
  ids_.range_far_m = names.range_tint_m.high;
}

void View::UploadWorld(const EngineSnapshot& snapshot, const ViewFrame& frame, UiState& state,
                       double dt_s) {
  if (!world_ || state.frame.workspace != Workspace::kSimulate) {
    return;
  }
  const Rect body = ComputeFrameLayout(frame.width_px, frame.height_px, style_.scale).body;
  state.world_orbit.Advance(dt_s);
  world_->Update(snapshot, LaySimulate(body, style_), style_, state.simulate, state.world_orbit,
                 state.orbit_moves, /*all=*/std::isinf(dt_s));
  for (std::size_t i = 0; i < kWorldEyes; ++i) {
    ids_.world[i] = Id(world_->texture(static_cast<WorldEye>(i)));
  }
  ids_.world_waits_for = world_->waits_for();
}

void View::Upload(const EngineSnapshot& snapshot, const ViewFrame& frame, UiState& state,
                  double dt_s) {
  Fit(state, frame);
  UploadPictures(snapshot, state, frame);
  UploadWorld(snapshot, frame, state, dt_s);
  const Rect scene = SceneRect(snapshot, state, frame);
  if (scene.w < 16 || scene.h < 16) {
    return;
  }
  const View3dKey key{snapshot.sequence, state.highlighted_site, state.orbit_moves, scene.w,
                      scene.h};
  settle_s_ = key.orbit_moves != drawn_3d_.orbit_moves ? kOrbitSettles_s : settle_s_ - dt_s;
  if (key == drawn_3d_ && settle_s_ <= 0) {
    return;
  }
  drawn_3d_ = key;
  View3dInput input =
      MakeView3dInput(snapshot, state.highlighted_site, static_cast<double>(style_.scale));
  input.body = body_;
  FrameView3d(input, state.orbit);
  state.orbit.Advance(dt_s);
  const Result<View3dLabels> labels =
      view3d_->Render(input, state.orbit, static_cast<int>(scene.w), static_cast<int>(scene.h));
  if (!labels) {
    return;
  }
  ids_.scene_3d = Id(view3d_->texture());
  ids_.scene_3d_ticks.clear();
  for (const View3dLabel& label : labels->height_ticks) {
    ids_.scene_3d_ticks.push_back({{label.pixel.x(), label.pixel.y()}, label.text});
  }
}

Intents View::Draw(const EngineSnapshot* snapshot, const FlightRecord* record, UiState& state,
                   const Fonts& fonts, const ViewFrame& frame) {
  TakeFonts(fonts, style_);
  Fit(state, frame);
  const FrameLayout layout = ComputeFrameLayout(frame.width_px, frame.height_px, style_.scale);
  ids_.scene_3d_preset = PresetOf(state.orbit);
  items_.Clear();
  Intents intents;
  UiFrame ui{style_,
             ids_,
             items_,
             intents,
             state.focus,
             frame.ui_time_s,
             state.key_help || state.leave_asked,
             layout.wave_off,
             Explain};
  ui.highlighted_site = state.highlighted_site;
  ui.window_focused = frame.window_focused;
  ui.after_review = state.after_review;
  ui.why_not_flown = WhyNotFlown;
  ui.unseen_on_way = UnseenOnWay;
  if (snapshot != nullptr) {
    ui.silent_s = AgeNow(*snapshot, snapshot->time, MonotonicSeconds());
    state.frame.preset_name = LimitsName(state.tune, snapshot->session->settings);
  }
  state.frame.frame_ms = frame.frame_ms;
  const auto percent = [](double scale) { return std::to_string(std::lround(100 * scale)) + " %"; };
  const double scale = style_.scale;
  state.frame.text_note = state.scale > scale + 0.01
                              ? "Text " + percent(scale) + ", no room for " + percent(state.scale)
                              : "";
  BeginCanvas(ui);
  if (snapshot == nullptr) {
    DrawWaiting(layout, ui);
  } else {
    DrawFrameBar(*snapshot, layout, state.frame, ui);
    DrawWorkspace(*snapshot, record, layout, frame, state, ui);
    DrawFrameOverlay(*snapshot, layout, state.frame, ui);
  }
  DrawComplaint(layout, frame.complaint, ui);
  DrawMessage(snapshot, layout, frame, state, ui);
  if (state.key_help) {
    DrawKeyHelp(layout.body, ui);
  }
  DrawLeaveQuestion(snapshot, layout, state, ui);
  EndCanvas(ui);
  return intents;
}

void View::DrawWorkspace(const EngineSnapshot& snapshot, const FlightRecord* record,
                         const FrameLayout& layout, const ViewFrame& frame, UiState& state,
                         UiFrame& ui) {
  switch (state.frame.workspace) {
    case Workspace::kFly:
      DrawFlyWorkspace(
          snapshot,
          ComputeFlyLayout(frame.width_px, frame.height_px, style_.scale, ShowsDescent(snapshot)),
          state.fly, ui);
      break;
    case Workspace::kTune:
      DrawTuneWorkspace(snapshot, layout.body, state.tune, ui);
      break;
    case Workspace::kReview:
      DrawReviewWorkspace(snapshot, record, layout.body, state.review, ui);
      break;
    case Workspace::kDiagnose:
      DrawDiagnoseWorkspace(snapshot, layout.body, state.diagnose, ui);
      break;
    case Workspace::kSimulate:
      DrawSimulateWorkspace(snapshot, layout.body, state.simulate, ui);
      break;
  }
}

void View::DrawWaiting(const FrameLayout& layout, UiFrame& ui) {
  DrawText(ui, style_.section, style_.palette.text1, layout.window.centre().x,
           layout.window.centre().y, "Waiting for the first pictures", Align::kCentre);
}

void View::DrawLeaveQuestion(const EngineSnapshot* snapshot, const FrameLayout& layout,
                             UiState& state, UiFrame& ui) {
  if (!state.leave_asked || snapshot == nullptr) {
    return;
  }
  const std::string alone = WhatTheVehicleDoesAlone(*snapshot, ui.silent_s);
  ui.blocked_by_popup = false;  // the keyboard is for this question alone
  const LeaveAnswer answer =
      DrawLeaveDialog(layout.body, alone.empty() ? "Nothing flies any more." : alone, ui);
  state.leave_asked = answer == LeaveAnswer::kNone;
  state.quit = state.quit || answer == LeaveAnswer::kLeave;
}

/// Over the alarm strip: the alarms below it are those of an engine that does not answer.
void View::DrawComplaint(const FrameLayout& layout, const std::string& complaint, UiFrame& ui) {
  if (complaint.empty()) {
    return;
  }
  const Style& s = style_;
  const Rect& strip = layout.alarm_strip;
  ImDrawList* dl = Canvas();
  FillRect(dl, strip, s.palette.warning_fill);
  StrokeRect(dl, strip, s.palette.warning, 2);
  const std::string shown = FitClauses(s.medium, complaint, strip.w - s.Px(24));
  DrawText(ui, s.medium, s.palette.text1, strip.x + s.Px(12), strip.centre().y, shown);
  if (shown != complaint && Interact(ui, "engine_complaint", strip, kPassive).hovered) {
    DrawTooltip(ui, complaint);
  }
  ui.items.Add("engine_complaint", strip, true, complaint);
}

void View::DrawMessage(const EngineSnapshot* snapshot, const FrameLayout& layout,
                       const ViewFrame& frame, const UiState& state, UiFrame& ui) {
  if (state.message.empty() || ui.ui_time_s > state.message_until_s) {
    return;
  }
  const bool fly = snapshot != nullptr && state.frame.workspace == Workspace::kFly;
  const Rect room = fly ? ToastRoom(ComputeFlyLayout(frame.width_px, frame.height_px, style_.scale,
                                                     ShowsDescent(*snapshot)),
                                    style_)
                        : ToastRoom(layout, style_);
  DrawToast(room, state.message, ui);
}

}  // namespace palace
