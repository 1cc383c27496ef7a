// Plots as SVG text, for report.html: lines with error bars, heat maps, arrows over a picture.
//
// Axes choose round ticks from the data. Labels carry the unit ("height error, cm"). Values that
// are not finite leave a gap; a plot without data says so instead of drawing an empty frame. Texts
// are escaped here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/model/grid.h"

namespace palace {

struct PlotSeries {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> low{};  ///< error bars, absolute values; empty or one per point
  std::vector<double> high{};
  bool line = true;
  bool points = true;
};

/// A horizontal line at a limit or a true value.
struct PlotReference {
  double y = 0;
  std::string label;
};

struct LinePlot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series{};
  std::vector<PlotReference> limits{};
  bool log_x = false;  ///< values that are not positive leave a gap
  bool log_y = false;
  bool diagonal = false;  ///< y = x drawn dashed, for reliability diagrams
  std::optional<double> x_min{}, x_max{}, y_min{}, y_max{};
};
std::string LinePlotSvg(const LinePlot& plot);

struct HeatMap {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::string value_label;  ///< of the colour bar, with unit
  GridF cells;              ///< row 0 at the top; NaN drawn as a hatch of its own
  double x_min = 0, x_max = 1;
  double y_top = 0, y_bottom = 1;
  std::optional<double> low{}, high{};  ///< of the colour bar; from the data when absent
  int decimals = 2;                     ///< of the figures in the cells; negative: none
};
std::string HeatMapSvg(const HeatMap& map);

struct PlotArrow {
  double x = 0, y = 0;    ///< foot
  double dx = 0, dy = 0;  ///< in the plot's units, before magnification
  int series = 0;         ///< colour
};

/// Arrows over a picture of width x height (x right, y down), drawn `magnification` times too long.
struct VectorPlot {
  std::string title;
  std::string unit = "px";
  double width = 640;
  double height = 480;
  double magnification = 100;
  std::vector<PlotArrow> arrows{};
  std::vector<std::string> series_names{};
};
std::string VectorPlotSvg(const VectorPlot& plot);

}  // namespace palace
