// Timeline strip: ruler, lanes of segments and marks, whole-flight overview with a window, cursor.
// Time is seconds from the start of the flight. Texts that would touch are dropped, never cut.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gui/widgets/draw.h"
#include "gui/widgets/icons.h"

namespace palace {

/// A stretch of one value: a state, a site letter.
struct LaneSegment {
  double from_s = 0;
  double to_s = 0;
  std::string text;
  int shade = 0;         ///< 0..2: three greys
  bool hatched = false;  ///< orange: differs
  bool dashed = false;   ///< "none"
};
struct LaneMark {
  double at_s = 0;
  Icon icon = Icon::kFlag;
  ImU32 colour = 0;
  std::string text;
  std::string hint{};  ///< under the pointer: the whole of it
  /// Of marks that would cover one another the heaviest is shown and says what all of them say.
  int weight = 0;
};
struct Lane {
  std::string name;
  std::vector<LaneSegment> segments;
  std::vector<LaneMark> marks;
};

struct TimelineView {
  double duration_s = 0;
  double position_s = 0;
  std::vector<Lane> lanes;
  std::vector<ImVec2> height;  ///< seconds, metres: silhouette of the flight; a NaN breaks it
  std::vector<double> differences_s;
  std::vector<std::pair<double, double>> gaps_s;  ///< without data: from, to
  bool can_seek = true;
};

/// Zoom of the lanes; empty: the whole flight.
struct TimelineState {
  double from_s = 0;
  double to_s = 0;
  bool zoomed = false;
  double last_seek_s = -1;
  std::optional<std::pair<double, double>> loop_s;  ///< a stretch with its ends: from, to
  bool loops = false;                               ///< it is played again and again
};

/// "03:13.4".
std::string TimeLabel(double seconds, bool tenths);

/// Overview of 32 units and below it ruler and lanes. Items "overview", "timeline", "gap/<number>",
/// "lane/<name>", which reads the lane's value under the pointer, and "mark/<lane>/<number>". Click
/// and drag append PlaybackControl kSeek; over either the wheel zooms about the pointer.
void DrawTimeline(UiFrame& ui, const Rect& rect, const TimelineView& view, TimelineState& state);

}  // namespace palace
