// Own state of the Fly workspace: highlight, focus, drags, hover. Nothing here decides anything.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gui/panels/map_probe.h"
#include "gui/widgets/hold_button.h"
#include "gui/widgets/map/camera_overlay.h"
#include "gui/widgets/map/map_image.h"
#include "gui/widgets/plot.h"

namespace palace {

enum class FlyFocus { kNone, kSites, kApprove };

/// Presets of the 3-D view, in the order of the render room's.
enum class ViewPreset { kOrbit, kAbove, kBehind };

struct View3dTick {
  ImVec2 pixel;  ///< from the picture's top-left corner
  std::string text;
};
/// The panel writes what the operator asked for; the app feeds it to the renderer and clears it.
struct View3dState {
  Rect scene;  ///< where the picture lies; render at this size
  float drag_x = 0, drag_y = 0, pan_x = 0, pan_y = 0, wheel = 0;
  std::optional<ViewPreset> wanted_preset;
  ViewPreset preset = ViewPreset::kOrbit;
  std::vector<View3dTick> ticks;  ///< set by the app
};

struct CameraState {
  OverlayCache overlay;
  bool show_depth = false;  ///< the app then uploads the tint
};
struct MapRowState {
  LimitDrag drag;
  MapProbe probe;
  float elevation_low_m = -0.5f;  ///< fixed once per mission, set by the app
  float elevation_high_m = 1.5f;
};
struct SiteListState {
  std::uint64_t highlighted = 0;
  float scroll = 0;
};
struct ApproveState {
  HoldState hold;
  bool show_guards = false;
};

enum class PlotTab { kAuto, kDescent, kMaps };

struct FlyState {
  FlyFocus focus = FlyFocus::kNone;
  SiteListState sites;
  ApproveState approve;
  CameraState camera;
  View3dState view;
  MapRowState maps;
  PlotTab tab = PlotTab::kAuto;
  PlotHover plots;
};

}  // namespace palace
