// Line plot: series with bands, limit lines with hatch beyond them (grey and without, where a
// limit is for information), a now line, hover over all plots.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gui/widgets/panel_frame.h"

namespace palace {

struct PlotTrace {
  std::vector<ImVec2> points;  ///< x, y; a NaN breaks the line
  std::vector<float> band;     ///< half widths, 3 sigma; empty: none
  ImU32 colour = 0;
  float width = 1.5f;
  enum class Stroke { kSolid, kDotted, kDashed } stroke = Stroke::kSolid;
  bool dot_at_end = false;
};
struct PlotLimit {
  float value = 0;
  /// What is forbidden lies above the most, below the least; for information: nothing is.
  enum class Kind { kMost, kLeast, kInformation } kind = Kind::kMost;
  std::string text;
  float from_x = -std::numeric_limits<float>::infinity();  ///< the limit holds from here on
};

struct PlotView {
  std::string name;  ///< item "plot/" + name
  std::string title, unit, current;
  float x_min = 0, x_max = 1, y_min = 0, y_max = 1;
  std::vector<float> x_ticks;  ///< empty: chosen
  std::optional<float> now;    ///< beyond it the future is veiled
  std::string zero = "now";    ///< what a relative time of 0 is called
  std::vector<PlotTrace> series;
  std::vector<PlotLimit> limits;
  enum class XAxis { kRelative, kClock, kValue } x_axis = XAxis::kRelative;  ///< "−10", "1:30"
  std::string x_unit;                                                        ///< of values: "°"
  bool reads = true;  ///< the pointer reads the first series
  float foot = 0;     ///< pixels below the x axis that its owner draws in
  float side = 0;     ///< and right of the series
};

/// One cursor for a group of plots.
struct PlotHover {
  std::optional<float> x;       ///< set in the last frame by whichever plot the mouse is over
  std::optional<float> next_x;  ///< being collected
};
void BeginPlots(PlotHover& hover);

/// Round tick values, at most `count` + 1 of them, inside [low, high].
std::vector<float> RoundTicks(float low, float high, int count);
/// Times in seconds on whole seconds, half minutes or minutes, at most `count` + 1 of them.
std::vector<float> ClockTicks(float low, float high, int count);
/// Returns where the series lie: x_min and x_max are its left and right edge.
Rect DrawPlot(UiFrame& ui, const Rect& panel, const PlotView& view, PlotHover& hover);
/// Value of the series at x, by the nearest earlier point; NaN outside.
float SeriesValueAt(const PlotTrace& series, float x);

}  // namespace palace
