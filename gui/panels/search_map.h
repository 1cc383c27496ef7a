// Search map: the ground around from above, north up. What was looked at, where the vehicle is and
// what it sees, where it would look next, and the area that it is kept to; of a selected site how
// well each course to it suits wind, sun and what stands in the way.
//
// A click on a letter selects its site. Any other picks a place to fly to ("fly_there") or to look
// at ("look_there"). "draw_area" begins an area: every click is a corner, "area_undo" takes the
// last one back, "area_close" or a click on the first corner sends it, "area_cancel" puts it aside
// and "area_resume" goes on with it. "area_clear" takes a drawn area away, "area_restore" brings it
// back. With the focus on the map, arrows move a cross, Enter is a
// click there, Backspace takes back. The wheel and "map_closer", "map_wider" zoom;
// "search_legend_on" shows and hides the legend.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/model/snapshot.h"
#include "gui/widgets/map/letter_places.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

struct SearchMapState {
  bool shown = false;                      ///< in place of the 3-D view
  double half_m = 70;                      ///< from the middle to the nearer edge
  std::optional<Eigen::Vector2d> picked;   ///< north, east
  bool draws = false;                      ///< an area
  std::vector<Eigen::Vector2d> corners;    ///< of it, so far
  std::vector<Eigen::Vector2d> put_aside;  ///< of one that was cancelled
  double settled_s = -1;                   ///< UI clock: before, a press is a double click's second
  double ceiling_m = NAN;                  ///< of it, above the origin of W
  std::string why_not;                     ///< it could not be closed
  Eigen::Vector2d cross{NAN, NAN};         ///< of the keyboard
  std::optional<FlyArea> last_area;        ///< that was in force, also when it is cleared
  std::optional<bool> legend;              ///< asked for; empty: where there is room for it
  std::vector<LetterPlace> letters;        ///< of sites, in the last frame
};

/// What can be brought back, can be as long as its mission goes on. Once a frame, whether the map
/// is shown or not: a mission ends behind other panels.
void FollowArea(const MissionStatus& mission, SearchMapState& state);

void DrawSearchMapPanel(const EngineSnapshot& snap, const Rect& rect, SearchMapState& state,
                        UiFrame& ui);

}  // namespace palace
