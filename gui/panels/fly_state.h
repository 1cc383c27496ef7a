// Own state of the Fly workspace: scrolling, holds, drags, hover. Nothing here decides anything.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/mission/mission_status.h"
#include "gui/panels/map_probe.h"
#include "gui/panels/search_map.h"
#include "gui/widgets/evidence_row.h"
#include "gui/widgets/hold_button.h"
#include "gui/widgets/map/camera_overlay.h"
#include "gui/widgets/map/map_image.h"
#include "gui/widgets/plot.h"

namespace palace {

struct CameraState {
  OverlayCache overlay;
  bool show_depth = false;  ///< the app then uploads the tint
  bool track_view = false;  ///< every tracker on the picture, in place of the one in force
};
struct TrackerPanelState {
  bool pictures = false;  ///< in place of the rows, where there is no room for both
};
struct MapRowState {
  LimitDrag drag;
  /// On Fly a moved tick is only a question, until somebody answers it.
  std::optional<TickMove> asked;
  MapProbe probe;
};
struct SiteListState {
  float scroll = 0;      ///< pixels
  std::string followed;  ///< row with the focus that the list has scrolled to
  /// A row of the last frame.
  struct Held {
    std::uint64_t id = 0;
    std::string letter;
  };
  /// As they were drawn last. While the pointer is on the list they stay: a place does not slip
  /// away from under a press, and one that is gone leaves its room.
  std::vector<Held> drawn;
  bool order_held = false;  ///< they were not as the engine ranks them
};
struct ApproveState {
  HoldState hold;
  HoldState take_over;  ///< of command, from another station
  bool show_guards = false;
  std::uint64_t armed = 0;  ///< site that was armed in the last frame
  /// Until then (UI clock) the head's buttons take no press: they came up under the pointer, which
  /// may have been on its way to those that stood there.
  double withheld_until_s = -std::numeric_limits<double>::infinity();
  bool head_is_armed = false;  ///< the head's buttons were those of a selected site
  /// The approval asked for last, until the engine says what became of it.
  std::uint64_t asked_site = 0;
  double asked_at_s = -std::numeric_limits<double>::infinity();  ///< UI clock
  /// What broke the last hold when it was not the person.
  std::string hold_cut_by;
  double hold_cut_told_until_s = -std::numeric_limits<double>::infinity();  ///< UI clock
};

enum class PlotTab { kDescent, kMaps };

struct FlyState {
  SiteListState sites;
  ApproveState approve;
  CameraState camera;
  MapRowState maps;
  SearchMapState search_map;
  RowScroll evidence, limits;
  TrackerPanelState tracker;
  std::optional<MissionState> shown_state;  ///< of the last frame
  PlotTab tab = PlotTab::kDescent;
  PlotHover plots;
};

}  // namespace palace
