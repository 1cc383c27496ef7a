// Rectangles of the shared frame and of the Fly workspace. Computed by gui/app/layout.
#pragma once

#include <array>

#include "gui/widgets/style.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

/// Every workspace folds in a window below one of these, in units.
inline constexpr float kWideWidth = 1600, kWideHeight = 900;
/// What the shared frame takes of a window: margins beside the body, bars above and below it.
inline constexpr float kBesideBody = 16, kAroundBody = 124;
inline bool IsNarrow(double width, double height) {
  return width < kWideWidth || height < kWideHeight;
}
/// The same, asked of the body that such a window has.
inline bool IsNarrowBody(const Rect& body, const Style& style) {
  return body.w < style.Px(kWideWidth - kBesideBody) ||
         body.h < style.Px(kWideHeight - kAroundBody);
}

/// What every workspace shares. All rectangles in whole pixels.
struct FrameLayout {
  double scale = 1;
  bool narrow = false;  ///< IsNarrow
  Rect window;
  Rect top_bar;      ///< ends where WAVE OFF begins
  Rect mode_block;   ///< at 0,0
  Rect alarm_strip;  ///< ends where WAVE OFF begins
  Rect wave_off;     ///< flush to the top right corner
  Rect body;         ///< between strip and status bar, inside the margins
  Rect status_bar;
};

struct FlyLayout {
  FrameLayout frame;
  bool narrow = false;
  bool descent = false;  ///< right column and map row hold the descent panels
  Rect left_camera, right_camera, vehicle, view_3d;
  std::array<Rect, 5> maps;
  float map_side = 0;  ///< of the square picture in each map panel
  Rect channels;       ///< empty when narrow
  int site_rows = 4;
  int site_row_units = 72;
  bool folded_evidence = false;  ///< 6 rows instead of all
  Rect sites, evidence, approve;
  // From DESCENDING:
  Rect plot_tabs;
  std::array<Rect, 6> plots;
  std::array<Rect, 5> tabbed_maps;  ///< the maps below the tabs
  float tabbed_map_side = 0;
  Rect recheck, limits, tracker, landing;  ///< tracker is empty where there is no room for it
  /// On hold: without the tracker, and Landing where Approve is.
  Rect held_recheck, held_limits;
};

}  // namespace palace
