#include "gui/app/view.h"

#include <algorithm>
#include <cmath>

#include "engine/slad/hazards/explanation.h"
#include "gui/app/key_help.h"
#include "gui/app/layout.h"
#include "gui/app/view3d_input.h"
#include "gui/widgets/draw.h"

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

void TakeFonts(const Fonts& fonts, Style& style) {
  style.caption = fonts.caption;
  style.body = fonts.body;
  style.medium = fonts.medium;
  style.section = fonts.section;
  style.button = fonts.button;
  style.readout = fonts.readout;
  style.mode = fonts.mode;
  style.mode_replay = fonts.mode_replay;
  style.wave_off = fonts.wave_off;
  style.replay_time = fonts.replay_time;
  style.mono = fonts.mono;
}

std::string PresetName(const UiState& state) {
  const std::size_t slash = state.preset_path.find_last_of('/');
  std::string name =
      slash == std::string::npos ? state.preset_path : state.preset_path.substr(slash + 1);
  if (name.size() > 5 && name.substr(name.size() - 5) == ".toml") {
    name.resize(name.size() - 5);
  }
  return name.empty() ? "defaults" : name;
}

CellExplanation Explain(const TerrainDecision& decision, Cell cell) {
  return ExplainCell(*decision.elevation, *decision.hazards, decision.settings, cell);
}

/// Hands the operator's drags over the 3-D view to its camera. True when there were any.
bool MoveOrbit(View3dState& view, OrbitCamera& orbit) {
  const bool moved = view.wanted_preset || view.drag_x != 0 || view.drag_y != 0 ||
                     view.pan_x != 0 || view.pan_y != 0 || view.wheel != 0;
  constexpr View3dPreset kPresets[] = {View3dPreset::kOrbit, View3dPreset::kAbove,
                                       View3dPreset::kBehind};
  if (view.wanted_preset) {
    orbit.SetPreset(kPresets[static_cast<int>(*view.wanted_preset)]);
  }
  if (view.drag_x != 0 || view.drag_y != 0) {
    orbit.Drag(view.drag_x, view.drag_y);
  }
  if (view.pan_x != 0 || view.pan_y != 0) {
    orbit.Pan(view.pan_x, view.pan_y, view.scene.h);
  }
  if (view.wheel != 0) {
    orbit.Zoom(view.wheel);
  }
  view.wanted_preset.reset();
  view.drag_x = view.drag_y = view.pan_x = view.pan_y = view.wheel = 0;
  return moved;
}

}  // namespace

Result<std::unique_ptr<View>> View::Create(const std::string& theme) {
  Result<std::unique_ptr<View3dRenderer>> view3d = View3dRenderer::Create();
  if (!view3d) {
    return view3d.error();
  }
  std::unique_ptr<View> view(new View(std::move(*view3d)));
  view->style_.palette = PaletteOf(theme);
  return view;
}

double View::FittingScale(int width_px, int height_px, double wanted) {
  return palace::FittingScale(width_px, height_px, wanted);
}

void View::Upload(const EngineSnapshot& snapshot, const UiState& state, double dt_s) {
  const Item* camera = items_.Find("left_camera");
  const double camera_scale =
      camera && snapshot.left_rectified ? camera->rect.w / snapshot.left_rectified->width() : 1;
  textures_.ShowRange(fly_.camera.show_depth);
  textures_.Update(snapshot, camera_scale);
  const TextureNames& names = textures_.names();
  ids_.left_camera = Id(names.left_camera);
  ids_.right_camera = Id(names.right_camera);
  for (std::size_t i = 0; i < names.maps.size(); ++i) {
    ids_.maps[i] = Id(names.maps[i]);
  }
  ids_.recorded_safe_distance = Id(names.recorded_safe_distance);
  ids_.difference = Id(names.difference);
  ids_.anchor_patch = Id(names.anchor_patch);
  ids_.current_patch = Id(names.current_patch);
  ids_.difference_patch = Id(names.difference_patch);
  ids_.range_tint = Id(names.range_tint);
  ids_.range_near_m = names.range_tint_m.low;
  ids_.range_far_m = names.range_tint_m.high;
  fly_.maps.elevation_low_m = static_cast<float>(textures_.ranges().elevation_m.low);
  fly_.maps.elevation_high_m = static_cast<float>(textures_.ranges().elevation_m.high);

  const Item* scene = items_.Find("view_3d");
  if (scene == nullptr || scene->rect.w < 16 || scene->rect.h < 16) {
    return;
  }
  const bool moved = MoveOrbit(fly_.view, orbit_);
  settle_s_ = moved ? kOrbitSettles_s : settle_s_ - dt_s;
  const View3dKey key{snapshot.sequence, state.highlighted_site, scene->rect.w, scene->rect.h};
  if (key == drawn_3d_ && settle_s_ <= 0) {
    return;
  }
  drawn_3d_ = key;
  const View3dInput input = MakeView3dInput(snapshot, state.highlighted_site, style_.scale);
  FrameView3d(input, orbit_);
  orbit_.Advance(dt_s);
  const Result<View3dLabels> labels = view3d_->Render(
      input, orbit_, static_cast<int>(scene->rect.w), static_cast<int>(scene->rect.h));
  if (!labels) {
    return;
  }
  ids_.scene_3d = Id(view3d_->texture());
  fly_.view.ticks.clear();
  for (const View3dLabel& label : labels->height_ticks) {
    fly_.view.ticks.push_back({{label.pixel.x(), label.pixel.y()}, label.text});
  }
}

Intents View::Draw(const EngineSnapshot* snapshot, const FlightRecord* record, UiState& state,
                   const Fonts& fonts, const ViewFrame& frame) {
  TakeFonts(fonts, style_);
  style_.scale = static_cast<float>(FittingScale(frame.width_px, frame.height_px, state.scale));
  const FrameLayout layout = ComputeFrameLayout(frame.width_px, frame.height_px, style_.scale);
  items_.Clear();
  Intents intents;
  UiFrame ui{style_,          ids_,           items_,          intents,
             frame.ui_time_s, state.key_help, layout.wave_off, Explain};
  frame_state_.workspace = state.workspace;
  frame_state_.preset_name = PresetName(state);
  frame_state_.frame_ms = frame.frame_ms;
  BeginCanvas(style_);
  if (snapshot == nullptr) {
    DrawWaiting(layout, ui);
  } else {
    DrawFrameBar(*snapshot, layout, frame_state_, ui);
    DrawWorkspace(*snapshot, record, layout, frame, state, ui);
    DrawFrameOverlay(*snapshot, layout, frame_state_, ui);
  }
  DrawMessage(layout, state, ui);
  if (state.key_help) {
    ui.blocked_by_popup = false;
    DrawKeyHelp(layout.body, ui);
  }
  EndCanvas();
  return intents;
}

void View::DrawWorkspace(const EngineSnapshot& snapshot, const FlightRecord* record,
                         const FrameLayout& layout, const ViewFrame& frame, UiState& state,
                         UiFrame& ui) {
  switch (state.workspace) {
    case Workspace::kFly:
      DrawFlyWorkspace(
          snapshot,
          ComputeFlyLayout(frame.width_px, frame.height_px, style_.scale, ShowsDescent(snapshot)),
          fly_, ui);
      break;
    case Workspace::kTune:
      tune_.elevation_low_m = fly_.maps.elevation_low_m;
      tune_.elevation_high_m = fly_.maps.elevation_high_m;
      tune_.preset_path = state.preset_path;
      tune_.can_undo = !state.undo.empty();
      tune_.can_redo = !state.redo.empty();
      DrawTuneWorkspace(snapshot, layout.body, tune_, ui);
      break;
    case Workspace::kReview:
      DrawReviewWorkspace(snapshot, record, layout.body, review_, ui);
      break;
    case Workspace::kDiagnose:
      DrawDiagnoseWorkspace(snapshot, layout.body, diagnose_, ui);
      break;
  }
}

void View::DrawWaiting(const FrameLayout& layout, UiFrame& ui) {
  ImDrawList* dl = Canvas();
  FillRect(dl, layout.window, style_.palette.window);
  DrawText(ui, style_.section, style_.palette.text1, layout.window.centre().x,
           layout.window.centre().y, "Waiting for the first pictures", Align::kCentre);
}

void View::DrawMessage(const FrameLayout& layout, const UiState& state, UiFrame& ui) {
  if (state.message.empty() || ui.ui_time_s > state.message_until_s) {
    return;
  }
  const Style& s = style_;
  const float width =
      std::min(TextWidth(s.body, state.message) + s.Px(32), layout.body.w - s.Px(32));
  // Beside the right column, where approve and apply are.
  const float right = layout.body.right() - s.Px(layout.narrow ? 360 : 432);
  const Rect toast{std::max(layout.body.x, right - width - s.Px(16)),
                   layout.body.bottom() - s.Px(60), width, s.Px(44)};
  ImDrawList* dl = Canvas();
  FillRect(dl, toast, s.palette.control, s.Fine(4));
  StrokeRect(dl, toast, s.palette.line, 1, s.Fine(4));
  DrawText(ui, s.body, s.palette.text1, toast.x + s.Px(16), toast.centre().y,
           FitWords(s.body, state.message, toast.w - s.Px(32)));
  ui.items.Add("toast", toast, true, state.message);
}

}  // namespace palace
