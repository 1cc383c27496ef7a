#include "gui/panels/fly_panels.h"
#include "gui/widgets/button.h"

namespace palace {

namespace {

void ReadMouse(const Rect& scene, View3dState& state, UiFrame& ui) {
  const ImGuiIO& io = ImGui::GetIO();
  if (HeldFrom(ui, scene) && !io.MouseClicked[0]) {
    (io.KeyShift ? state.pan_x : state.drag_x) += io.MouseDelta.x;
    (io.KeyShift ? state.pan_y : state.drag_y) += io.MouseDelta.y;
  }
  if (Hovered(ui, scene)) {
    state.wheel += io.MouseWheel;
  }
}

void DrawTicks(const Rect& scene, const View3dState& state, UiFrame& ui) {
  const Style& s = ui.style;
  for (const View3dTick& tick : state.ticks) {
    const float x = scene.x + tick.pixel.x;
    const float y = scene.y + tick.pixel.y;
    const float width = TextWidth(s.caption, tick.text);
    if (x - width - s.Px(10) < scene.x || y < scene.y + s.Px(10) || y > scene.bottom() - s.Px(10)) {
      continue;
    }
    DrawText(ui, s.caption, picture::kPlateText, x - s.Px(10), y, tick.text, Align::kRight);
  }
}

}  // namespace

void DrawView3dPanel(const EngineSnapshot& snap, const Rect& rect, View3dState& state,
                     UiFrame& ui) {
  const Style& s = ui.style;
  const Rect scene = DrawPanelFrame(ui, rect, "3-D view",
                                    {{rect.w < s.Px(300) ? ""
                                      : snap.applied     ? "Safe distance over picture"
                                                         : "No map yet"}});
  state.scene = scene;
  ImDrawList* dl = Canvas();
  if (ui.textures.scene_3d != nullptr) {
    dl->AddImageRounded(ui.textures.scene_3d, scene.min(), scene.max(), {0, 0}, {1, 1},
                        picture::kWhite, s.Fine(4), ImDrawFlags_RoundCornersBottom);
  } else {
    dl->AddRectFilledMultiColor(scene.min(), scene.max(), Rgb(0x0E1319), Rgb(0x0E1319),
                                Rgb(0x181F27), Rgb(0x181F27));
  }
  ui.items.Add("view_3d", scene, true, "");
  DrawTicks(scene, state, ui);
  // The presets appear with the pointer, so that the picture stays free.
  const bool near = Hovered(ui, scene);
  constexpr const char* kNames[] = {"Orbit", "Above", "Behind"};
  bool on_button = false;
  float x = scene.x + s.Px(8);
  for (int i = 0; i < 3; ++i) {
    const Rect button{x, scene.y + s.Px(8), TextWidth(s.body, kNames[i]) + s.Px(20), s.Px(24)};
    const std::string name = std::string("view/") + kNames[i];
    on_button = on_button || Hovered(ui, button);
    if (!near) {
      ui.items.Add(name, button, true, kNames[i]);
    } else {
      ButtonLook look;
      look.active = static_cast<int>(state.preset) == i;
      if (DrawButton(ui, name, button, kNames[i], look)) {
        state.wanted_preset = static_cast<ViewPreset>(i);
        state.preset = static_cast<ViewPreset>(i);
      }
    }
    x += button.w + s.Px(6);
  }
  if (!on_button) {
    ReadMouse(scene, state, ui);
  }
}

}  // namespace palace
