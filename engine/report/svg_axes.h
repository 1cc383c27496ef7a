// The frame of a plot: scales, round ticks, labels. Used by the plots of this room.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace palace {

/// Pixels of the drawing area inside the SVG's view box.
struct PlotFrame {
  double left = 74;
  double top = 40;
  double width = 600;
  double height = 320;
  double full_width = 860;  ///< view box; the room at the right holds the legend or colour bar
  double full_height = 420;
};

/// Maps values to pixels along one axis.
struct PlotScale {
  double min = 0;
  double max = 1;
  double from = 0;  ///< pixel of min
  double to = 1;    ///< pixel of max
  bool log = false;
  bool whole = false;  ///< ticks at whole numbers only
  /// NaN where the value has no place.
  double Pixel(double value) const;
};

/// Round values inside [min, max]: 1, 2 or 5 times a power of ten; decades where log.
std::vector<double> RoundTicks(double min, double max, bool log, int about, bool whole = false);
/// Widens an empty range and adds a small margin.
void PadRange(double& min, double& max, bool log);
/// Six significant digits at most, no trailing zeros.
std::string TickText(double value);
std::string Number(double pixel);

/// Opening tag, title, frame, grid, ticks and labels.
std::string DrawFrame(const PlotFrame& frame, const PlotScale& x, const PlotScale& y,
                      const std::string& title, const std::string& x_label,
                      const std::string& y_label);
std::string DrawText(double x, double y, const std::string& anchor, const std::string& text,
                     const char* colour_class = "t");
/// A plot without data.
std::string DrawNothing(const PlotFrame& frame, const std::string& title);

/// Colours of series, far apart also for colour-blind readers (Okabe & Ito 2008, brightened).
inline constexpr std::array<const char*, 8> kSeriesColours = {
    "#5cb2ff", "#f0b54a", "#54c7b5", "#e08fc0", "#ff7b5e", "#b79cf5", "#d9d055", "#8e99a8"};
inline const char* SeriesColour(std::size_t index) {
  return kSeriesColours[index % kSeriesColours.size()];
}

}  // namespace palace
