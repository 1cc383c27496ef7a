#include "gui/panels/fly_panels.h"
#include "gui/panels/map_views.h"
#include "gui/widgets/button.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr float kKeyTurn_px = 8;  // one arrow key turns as far as this drag

void DrawTicks(const Rect& scene, UiFrame& ui) {
  const Style& s = ui.style;
  for (const View3dTick& tick : ui.textures.scene_3d_ticks) {
    const float x = scene.x + tick.pixel.x;
    const float y = scene.y + tick.pixel.y;
    const float width = TextWidth(s.caption, tick.text);
    if (x - width - s.Px(10) < scene.x || y < scene.y + s.Px(10) || y > scene.bottom() - s.Px(10)) {
      continue;
    }
    // Lines of the picture cross it.
    FillRect(Canvas(), {x - width - s.Px(13), y - s.Px(8), width + s.Px(6), s.Px(16)},
             picture::kPlate, s.Fine(3));
    DrawText(ui, s.caption, picture::kPlateText, x - s.Px(10), y, tick.text, Align::kRight);
  }
}

}  // namespace

/// Drags turn it, with Shift they move it, the wheel zooms; so do the arrow keys and, zooming,
/// Enter and Backspace.
void RunOrbit(UiFrame& ui, std::string_view name, const Rect& scene) {
  const Interaction in = Interact(ui, name, scene, kAllSteps | kClears);
  MoveView3d move;
  move.view_height_px = scene.h;
  (in.shift ? move.pan_x : move.turn_x) += in.drag.x;
  (in.shift ? move.pan_y : move.turn_y) += in.drag.y;
  move.turn_x += kKeyTurn_px * static_cast<float>(in.step_right);
  move.turn_y -= kKeyTurn_px * static_cast<float>(in.step_up);
  move.zoom = in.wheel + (in.key_pressed ? 1.0f : 0.0f) - (in.cleared ? 1.0f : 0.0f);
  const bool moved =
      move.turn_x != 0 || move.turn_y != 0 || move.pan_x != 0 || move.pan_y != 0 || move.zoom != 0;
  if (moved) {
    ui.intents.push_back(UiAction(move));
  }
}

Rect View3dScene(const Rect& panel, const Style& style) { return PanelContent(panel, style); }

void DrawView3dPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const bool old = snap.terrain->applied && IsMapOld(snap, ui.silent_s);
  const std::string fact = old ? "Map " + AgeText(ShownMapAge(snap, ui.silent_s)) + " old"
                           : snap.terrain->preview            ? "Preview"
                           : rect.w < s.Px(300)               ? ""
                           : snap.terrain->applied            ? "Safe distance over picture"
                           : snap.terrain->why_no_map.empty() ? "No map yet"
                                                              : "No map";
  // Near the ground none is made: an old one is no fault then.
  const bool late = old && snap.terrain->why_no_map.empty() &&
                    snap.flight->mission.state != MissionState::kLanded;
  const Rect scene =
      DrawPanelFrame(ui, rect, "3-D view", {{fact, 0, late || snap.terrain->preview, late}});
  ImDrawList* dl = Canvas();
  if (ui.textures.scene_3d != nullptr) {
    dl->AddImageRounded(ui.textures.scene_3d, scene.min(), scene.max(), {0, 0}, {1, 1},
                        picture::kWhite, s.Fine(4), ImDrawFlags_RoundCornersBottom);
  } else {
    dl->AddRectFilledMultiColor(scene.min(), scene.max(), Rgb(0x0E1319), Rgb(0x0E1319),
                                Rgb(0x181F27), Rgb(0x181F27));
  }
  DrawTicks(scene, ui);
  // The presets appear with the pointer or the focus, so that the picture stays free.
  constexpr const char* kNames[] = {"Orbit", "Above", "Behind"};
  const bool near = Interact(ui, "view_3d", scene, kPassive).hovered;
  float x = scene.x + s.Px(8);
  for (int i = 0; i < 3; ++i) {
    const auto preset = static_cast<ViewPreset>(i);
    const Rect button{x, scene.y + s.Px(8), TextWidth(s.body, kNames[i]) + s.Px(20), s.Px(24)};
    ButtonLook look;
    look.active = ui.textures.scene_3d_preset == preset;
    look.unseen = !near;
    if (DrawButton(ui, std::string("view/") + kNames[i], button, kNames[i], look)) {
      ui.intents.push_back(UiAction(ShowView3dPreset{preset}));
    }
    x += button.w + s.Px(6);
  }
  RunOrbit(ui, "view_3d", scene);
}

}  // namespace palace
