// The whole Fly window without a screen.
#pragma once

#include <functional>
#include <utility>

#include "gui/app/layout.h"
#include "gui/panels/fly_workspace.h"
#include "gui/panels/frame_bar.h"
#include "tests/support/fake_snapshot.h"
#include "tests/support/ui_harness.h"

namespace palace {

struct FlyWindow {
  FlyWindow(float width, float height, EngineSnapshot snapshot, float scale = 1)
      : ui(width, height, scale), snap(std::move(snapshot)), size{width, height}, scale_(scale) {
    for (ImTextureID* id : {&ui.textures.left_camera, &ui.textures.right_camera}) {
      *id = &ui;  // any non-null name: nothing is rendered
    }
    draw = [this](UiFrame& frame) {
      frame.silent_s = silent_s;
      const FlyLayout layout =
          ComputeFlyLayout(static_cast<double>(size.x), static_cast<double>(size.y),
                           static_cast<double>(scale_), ShowsDescent(snap));
      ui.wave_off_rect = layout.frame.wave_off;
      DrawFrameBar(snap, layout.frame, bar, frame);
      DrawFlyWorkspace(snap, layout, fly, frame);
      DrawFrameOverlay(snap, layout.frame, bar, frame);
    };
    ui.Frame(draw);
  }
  void Run(double seconds) {
    for (double t = 0; t < seconds - 1e-9; t += 1.0 / 60) {
      ui.Frame(draw);
    }
  }
  UiHarness ui;
  EngineSnapshot snap;
  ImVec2 size;
  float scale_;
  double silent_s = 0;  ///< the engine published nothing for so long
  FrameState bar;
  FlyState fly;
  std::function<void(UiFrame&)> draw;
};

}  // namespace palace
