#include <algorithm>
#include <cmath>

#include "engine/report/svg_axes.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

std::string Arrow(double x, double y, double dx, double dy, const std::string& colour) {
  const double length = std::hypot(dx, dy);
  std::string svg = "<path fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"1.3\" d=\"M" +
                    Number(x) + " " + Number(y) + "l" + Number(dx) + " " + Number(dy);
  if (length > 4) {  // shorter ones have no room for a head
    const double head = std::min(5.0, 0.4 * length) / length;
    const double tip_x = x + dx, tip_y = y + dy;
    for (const double side : {-0.5, 0.5}) {
      svg += "M" + Number(tip_x) + " " + Number(tip_y) + "l" + Number(head * (-dx - side * dy)) +
             " " + Number(head * (-dy + side * dx));
    }
  }
  return svg + "\"/>\n";
}

}  // namespace

std::string VectorPlotSvg(const VectorPlot& plot) {
  PlotFrame frame;
  if (!(plot.width > 0) || !(plot.height > 0) || plot.arrows.empty()) {
    return DrawNothing(frame, plot.title);
  }
  frame.height = frame.width * plot.height / plot.width;  // square pixels
  frame.full_height = frame.top + frame.height + 60;
  const PlotScale x{-0.5, plot.width - 0.5, frame.left, frame.left + frame.width};
  const PlotScale y{plot.height - 0.5, -0.5, frame.top + frame.height, frame.top};
  const double per_unit = frame.width / plot.width;
  std::string svg = DrawFrame(frame, x, y, plot.title, "column, px", "row, px");
  const double factor = plot.magnification * per_unit;
  for (const PlotArrow& arrow : plot.arrows) {
    const double px = x.Pixel(arrow.x), py = y.Pixel(arrow.y);
    if (std::isfinite(px + py + arrow.dx + arrow.dy)) {
      svg += Arrow(px, py, factor * arrow.dx, factor * arrow.dy,
                   SeriesColour(static_cast<std::size_t>(std::max(0, arrow.series))));
    }
  }
  // A scale arrow of round length, about a tenth of the picture.
  const double wanted = 0.1 * plot.width / plot.magnification;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double length = wanted / power < 2 ? power : wanted / power < 5 ? 2 * power : 5 * power;
  const double legend = frame.left + frame.width + 14;
  svg += Arrow(legend, frame.top + 10, factor * length, 0, "#aeb8c4") +
         DrawText(legend, frame.top + 30, "start", TickText(length) + " " + plot.unit);
  double row = frame.top + 60;
  for (std::size_t i = 0; i < plot.series_names.size(); ++i, row += 20) {
    svg += "<rect width=\"14\" height=\"4\" x=\"" + Number(legend) + "\" y=\"" + Number(row - 6) +
           "\" fill=\"" + SeriesColour(i) + "\"/>\n" +
           DrawText(legend + 20, row, "start", plot.series_names[i]);
  }
  return svg + "</svg>\n";
}

}  // namespace palace
