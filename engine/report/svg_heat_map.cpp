#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "engine/report/svg_axes.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

/// Viridis (van der Walt & Smith 2015) at nine stops, linear between them.
std::string Colour(double share) {
  static constexpr std::array<std::array<double, 3>, 9> kStops = {{{68, 1, 84},
                                                                   {71, 44, 122},
                                                                   {59, 81, 139},
                                                                   {44, 113, 142},
                                                                   {33, 144, 141},
                                                                   {39, 173, 129},
                                                                   {92, 200, 99},
                                                                   {170, 220, 50},
                                                                   {253, 231, 37}}};
  const double place = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  const double t = place - static_cast<double>(below);
  std::array<int, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    rgb[i] = static_cast<int>(
        std::lround(kStops[below][i] + t * (kStops[below + 1][i] - kStops[below][i])));
  }
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
  return text;
}

std::string Rectangle(double x, double y, double width, double height, const std::string& fill) {
  return "<rect x=\"" + Number(x) + "\" y=\"" + Number(y) + "\" width=\"" + Number(width) +
         "\" height=\"" + Number(height) + "\" fill=\"" + fill + "\"/>\n";
}

std::string ColourBar(const PlotFrame& frame, double low, double high, const std::string& label) {
  const double x = frame.left + frame.width + 20;
  constexpr int kSteps = 40;
  std::string svg;
  for (int i = 0; i < kSteps; ++i) {
    const double height = frame.height / kSteps;
    svg += Rectangle(x, frame.top + frame.height - (i + 1) * height, 16, height + 0.5,
                     Colour((i + 0.5) / kSteps));
  }
  const PlotScale scale{low, high, frame.top + frame.height, frame.top};
  for (const double tick : RoundTicks(low, high, false, 6)) {
    svg += DrawText(x + 22, scale.Pixel(tick) + 4.5, "start", TickText(tick), "d");
  }
  return svg + DrawText(x, frame.top - 10, "start", label);
}

}  // namespace

std::string HeatMapSvg(const HeatMap& map) {
  PlotFrame frame;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const float cell : map.cells.cells()) {
    if (std::isfinite(cell)) {
      low = std::min<double>(low, cell);
      high = std::max<double>(high, cell);
    }
  }
  if (!(high >= low)) {
    return DrawNothing(frame, map.title);
  }
  low = map.low.value_or(low);
  high = map.high.value_or(high);
  if (!(high > low)) {
    high = low + std::max(1e-9, 0.01 * std::abs(low));
  }
  const PlotScale x{map.x_min, map.x_max, frame.left, frame.left + frame.width};
  const PlotScale y{map.y_bottom, map.y_top, frame.top + frame.height, frame.top};
  const double cell_width = frame.width / map.cells.cols();
  const double cell_height = frame.height / map.cells.rows();
  std::string cells;
  for (int row = 0; row < map.cells.rows(); ++row) {
    for (int col = 0; col < map.cells.cols(); ++col) {
      const double value = map.cells.at(row, col);
      const double left = frame.left + col * cell_width;
      const double top = frame.top + row * cell_height;
      if (!std::isfinite(value)) {
        cells += "<path class=\"g\" d=\"M" + Number(left) + " " + Number(top + cell_height) + "L" +
                 Number(left + cell_width) + " " + Number(top) + "\"/>\n";
        continue;
      }
      const double share = (value - low) / (high - low);
      cells += Rectangle(left, top, cell_width + 0.3, cell_height + 0.3, Colour(share));
      if (map.decimals >= 0 && cell_width > 34 && cell_height > 14) {
        char text[32];
        std::snprintf(text, sizeof text, "%.*f", map.decimals, value);
        cells += "<text text-anchor=\"middle\" font-size=\"11\" x=\"" +
                 Number(left + cell_width / 2) + "\" y=\"" + Number(top + cell_height / 2 + 4) +
                 "\" fill=\"" + (share > 0.6 ? "#101418" : "#f4f6f8") + "\">" + text + "</text>\n";
      }
    }
  }
  return DrawFrame(frame, x, y, map.title, map.x_label, map.y_label) + cells +
         ColourBar(frame, low, high, map.value_label) + "</svg>\n";
}

}  // namespace palace
