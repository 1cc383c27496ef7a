#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/check.h"
#include "engine/report/svg_axes.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

/// The range of the finite (and, on a log axis, positive) values.
struct Range {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  bool log = false;
  bool whole = true;
  void Add(double value) {
    whole = whole && (!std::isfinite(value) || value == std::floor(value));
    if (std::isfinite(value) && (!log || value > 0)) {
      min = std::min(min, value);
      max = std::max(max, value);
    }
  }
  bool empty() const { return !(max >= min); }
};

std::string Polyline(const std::string& points, const char* colour) {
  if (points.empty()) {
    return {};
  }
  return "<polyline fill=\"none\" stroke-width=\"2\" stroke=\"" + std::string(colour) +
         "\" points=\"" + points + "\"/>\n";
}

std::string Segment(double x1, double y1, double x2, double y2, const std::string& style) {
  return "<line x1=\"" + Number(x1) + "\" y1=\"" + Number(y1) + "\" x2=\"" + Number(x2) +
         "\" y2=\"" + Number(y2) + "\" " + style + "/>\n";
}

std::string DrawSeries(const PlotSeries& series, const char* colour, const PlotScale& x,
                       const PlotScale& y) {
  std::string svg;
  std::string line;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double px = x.Pixel(series.x[i]);
    const double py = y.Pixel(series.y[i]);
    if (!std::isfinite(px + py)) {
      svg += Polyline(line, colour);
      line.clear();
      continue;
    }
    if (series.line) {
      line += Number(px) + "," + Number(py) + " ";
    }
    if (!series.low.empty()) {
      const double low = y.Pixel(series.low[i]);
      const double high = y.Pixel(series.high[i]);
      if (std::isfinite(low + high)) {
        const std::string style = "stroke-width=\"1.2\" stroke=\"" + std::string(colour) + "\"";
        svg += Segment(px, low, px, high, style) + Segment(px - 4, low, px + 4, low, style) +
               Segment(px - 4, high, px + 4, high, style);
      }
    }
    if (series.points) {
      svg += "<circle r=\"3\" cx=\"" + Number(px) + "\" cy=\"" + Number(py) + "\" fill=\"" +
             colour + "\"/>\n";
    }
  }
  return svg + Polyline(line, colour);
}

}  // namespace

std::string LinePlotSvg(const LinePlot& plot) {
  PlotFrame frame;
  Range xs, ys;
  xs.log = plot.log_x;
  ys.log = plot.log_y;
  for (const PlotSeries& series : plot.series) {
    PALACE_CHECK(series.x.size() == series.y.size() && series.low.size() == series.high.size() &&
                     (series.low.empty() || series.low.size() == series.x.size()),
                 series.name);
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (std::isfinite(series.y[i])) {
        xs.Add(series.x[i]);
      }
      ys.Add(series.y[i]);
      if (!series.low.empty()) {
        ys.Add(series.low[i]);
        ys.Add(series.high[i]);
      }
    }
  }
  if (xs.empty() || ys.empty()) {
    return DrawNothing(frame, plot.title);
  }
  for (const PlotReference& limit : plot.limits) {
    ys.Add(limit.y);
  }
  PadRange(xs.min, xs.max, plot.log_x);
  PadRange(ys.min, ys.max, plot.log_y);
  PlotScale x{plot.x_min.value_or(xs.min),
              plot.x_max.value_or(xs.max),
              frame.left,
              frame.left + frame.width,
              plot.log_x,
              xs.whole};
  PlotScale y{plot.y_min.value_or(ys.min), plot.y_max.value_or(ys.max), frame.top + frame.height,
              frame.top, plot.log_y};
  std::string svg = DrawFrame(frame, x, y, plot.title, plot.x_label, plot.y_label);
  // A given range may cut the data: nothing is drawn outside the frame, but for half a point's
  // disc.
  constexpr double kRim = 4;
  const std::string place = Number(frame.left - kRim) + "\" y=\"" + Number(frame.top - kRim);
  const std::string width = Number(frame.width + 2 * kRim);
  const std::string height = Number(frame.height + 2 * kRim);
  svg += "<svg x=\"" + place + "\" width=\"" + width + "\" height=\"" + height + "\" viewBox=\"" +
         Number(frame.left - kRim) + " " + Number(frame.top - kRim) + " " + width + " " + height +
         "\">\n";
  const std::string dashed = "class=\"f\" stroke-dasharray=\"6 4\"";
  if (plot.diagonal) {
    const double low = std::max(x.min, y.min), high = std::min(x.max, y.max);
    svg += Segment(x.Pixel(low), y.Pixel(low), x.Pixel(high), y.Pixel(high), dashed);
  }
  for (const PlotReference& limit : plot.limits) {
    const double at = y.Pixel(limit.y);
    svg += Segment(frame.left, at, frame.left + frame.width, at, dashed);
  }
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    svg += DrawSeries(plot.series[i], SeriesColour(i), x, y);
  }
  svg += "</svg>\n";
  const double legend = frame.left + frame.width + 14;
  double row = frame.top + 12;
  for (std::size_t i = 0; i < plot.series.size(); ++i, row += 20) {
    svg += "<rect width=\"14\" height=\"4\" x=\"" + Number(legend) + "\" y=\"" + Number(row - 6) +
           "\" fill=\"" + SeriesColour(i) + "\"/>\n" +
           DrawText(legend + 20, row, "start", plot.series[i].name);
  }
  for (const PlotReference& limit : plot.limits) {
    svg += Segment(legend, row - 4, legend + 14, row - 4, dashed) +
           DrawText(legend + 20, row, "start", limit.label, "d");
    row += 20;
  }
  return svg + "</svg>\n";
}

}  // namespace palace
