#include "engine/report/svg_axes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "engine/core/text.h"
#include "engine/report/html_page.h"

namespace palace {
namespace {

// The page's own colours where there is a page, the dark ones where the SVG stands alone.
constexpr const char* kSvgStyle =
    "<style>.t{fill:var(--text,#e8ecf1)}.d{fill:var(--dim,#aeb8c4)}"
    ".g{stroke:var(--rule,#2b3541);stroke-width:1}"
    ".f{fill:none;stroke:var(--dim,#aeb8c4);stroke-width:1}</style>";

std::string Open(const PlotFrame& frame, const std::string& title) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + Number(frame.full_width) +
         " " + Number(frame.full_height) +
         "\" font-family=\"Roboto,sans-serif\" font-size=\"13\" role=\"img\">" + kSvgStyle +
         "\n<text class=\"t\" x=\"" + Number(frame.left) +
         "\" y=\"24\" font-size=\"15\" font-weight=\"500\">" + EscapeHtml(title) + "</text>\n";
}

}  // namespace

double PlotScale::Pixel(double value) const {
  if (!std::isfinite(value) || (log && !(value > 0))) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double share = log ? (std::log10(value) - std::log10(min)) / (std::log10(max / min))
                           : (value - min) / (max - min);
  return from + share * (to - from);
}

std::vector<double> RoundTicks(double min, double max, bool log, int about, bool whole) {
  std::vector<double> ticks;
  if (!(max > min) || !std::isfinite(max - min) || (log && !(min > 0))) {
    return ticks;
  }
  if (log) {
    const bool wide = max / min > 1000;
    for (int decade = static_cast<int>(std::floor(std::log10(min)));
         decade <= static_cast<int>(std::ceil(std::log10(max))); ++decade) {
      for (const double step : {1.0, 2.0, 5.0}) {
        const double tick = step * std::pow(10.0, decade);
        if (tick >= min * 0.999999 && tick <= max * 1.000001 && (step == 1 || !wide)) {
          ticks.push_back(tick);
        }
      }
    }
    return ticks;
  }
  const double raw = (max - min) / std::max(about, 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double ratio = raw / power;
  const double fine = power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
  const double step = whole ? std::max(1.0, fine) : fine;
  for (double k = std::ceil(min / step - 1e-9); k <= max / step + 1e-9; k += 1) {
    ticks.push_back(k == 0 ? 0.0 : k * step);
  }
  return ticks;
}

void PadRange(double& min, double& max, bool log) {
  if (log) {
    min /= 1.15;
    max *= 1.15;
    return;
  }
  if (!(max - min > 1e-12 * std::max(std::abs(min), std::abs(max)))) {
    const double half = max == 0 ? 1 : 0.1 * std::abs(max);
    min -= half;
    max += half;
    return;
  }
  const double margin = 0.05 * (max - min);
  // An axis that starts at nothing keeps its zero.
  min = min >= 0 && min < margin ? 0 : min - margin;
  max += margin;
}

std::string TickText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string Number(double pixel) { return WithNumbers("%.1f", pixel); }

std::string DrawText(double x, double y, const std::string& anchor, const std::string& text,
                     const char* colour_class) {
  return "<text class=\"" + std::string(colour_class) + "\" x=\"" + Number(x) + "\" y=\"" +
         Number(y) + "\" text-anchor=\"" + anchor + "\">" + EscapeHtml(text) + "</text>\n";
}

std::string DrawFrame(const PlotFrame& frame, const PlotScale& x, const PlotScale& y,
                      const std::string& title, const std::string& x_label,
                      const std::string& y_label) {
  std::string svg = Open(frame, title);
  const double bottom = frame.top + frame.height;
  const double right = frame.left + frame.width;
  for (const double tick : RoundTicks(x.min, x.max, x.log, 8, x.whole)) {
    const std::string at = Number(x.Pixel(tick));
    svg += "<line class=\"g\" x1=\"" + at + "\" x2=\"" + at + "\" y1=\"" + Number(frame.top) +
           "\" y2=\"" + Number(bottom) + "\"/>\n";
    svg += DrawText(x.Pixel(tick), bottom + 18, "middle", TickText(tick), "d");
  }
  const auto rows = RoundTicks(std::min(y.min, y.max), std::max(y.min, y.max), y.log, 6);
  for (const double tick : rows) {
    const std::string at = Number(y.Pixel(tick));
    svg += "<line class=\"g\" x1=\"" + Number(frame.left) + "\" x2=\"" + Number(right) +
           "\" y1=\"" + at + "\" y2=\"" + at + "\"/>\n";
    svg += DrawText(frame.left - 8, y.Pixel(tick) + 4.5, "end", TickText(tick), "d");
  }
  svg += "<rect class=\"f\" x=\"" + Number(frame.left) + "\" y=\"" + Number(frame.top) +
         "\" width=\"" + Number(frame.width) + "\" height=\"" + Number(frame.height) + "\"/>\n";
  svg += DrawText(frame.left + frame.width / 2, bottom + 40, "middle", x_label);
  const std::string centre = Number(frame.top + frame.height / 2);
  svg += "<text class=\"t\" x=\"18\" y=\"" + centre +
         "\" text-anchor=\"middle\" transform=\"rotate(-90 18 " + centre + ")\">" +
         EscapeHtml(y_label) + "</text>\n";
  return svg;
}

std::string DrawNothing(const PlotFrame& frame, const std::string& title) {
  return Open(frame, title) +
         DrawText(frame.left + frame.width / 2, frame.top + frame.height / 2, "middle",
                  "no data to draw", "d") +
         "</svg>\n";
}

}  // namespace palace
