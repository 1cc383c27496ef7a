#include "engine/calibration/target_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace palace {
namespace {

constexpr double kLeastPage_mm = 40;
constexpr double kMostPage_mm = 5000;
constexpr double kPaperWidth_mm = 297;  // A4 landscape, used when the target fits on it
constexpr double kPaperHeight_mm = 210;
constexpr double kPaperEdge_mm = 6;  // printers leave this much white
constexpr double kFooter_mm = 16;    // scale bar and text under the target
constexpr double kBar_mm = 100;
constexpr double kSmallBar_mm = 20;

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4f", value);
  std::string trimmed = text;
  trimmed.erase(trimmed.find_last_not_of('0') + 1);
  if (trimmed.back() == '.') {
    trimmed.pop_back();
  }
  return trimmed;
}

std::string Rect(double x, double y, double width, double height) {
  return "<rect x=\"" + Number(x) + "\" y=\"" + Number(y) + "\" width=\"" + Number(width) +
         "\" height=\"" + Number(height) + "\"/>\n";
}

std::string Dots(const CalibrationTarget& target, double x0_mm, double y0_mm) {
  std::string svg;
  for (int k = 0; k < target.point_count(); ++k) {
    const Eigen::Vector3d at = 1000 * target.p_TQ(k);
    svg += "<circle cx=\"" + Number(x0_mm + at.x()) + "\" cy=\"" + Number(y0_mm + at.y()) +
           "\" r=\"" + Number(500 * target.DotDiameter_m(k)) + "\"/>\n";
  }
  return svg;
}

/// Columns x rows inner corners have one square more each way; (x0, y0) is the first corner.
std::string Squares(const CalibrationTarget& target, double x0_mm, double y0_mm) {
  const double side = 1000 * target.pitch_m;
  std::string svg;
  for (int row = -1; row < target.rows; ++row) {
    for (int column = -1; column < target.columns; ++column) {
      if ((row + column) % 2 == 0) {
        svg += Rect(x0_mm + column * side, y0_mm + row * side, side, side);
      }
    }
  }
  return svg;
}

/// A bar with end ticks, and its length beside it.
std::string ScaleBar(double x, double y, double length_mm) {
  return Rect(x, y, length_mm, 0.6) + Rect(x, y - 2, 0.25, 4.6) +
         Rect(x + length_mm - 0.25, y - 2, 0.25, 4.6) + "<text x=\"" + Number(x + length_mm + 3) +
         "\" y=\"" + Number(y + 1.6) + "\">" + Number(length_mm) + " mm: measure me</text>\n";
}

std::string Text(double x, double y, const std::string& text) {
  return "<text x=\"" + Number(x) + "\" y=\"" + Number(y) + "\">" + text + "</text>\n";
}

std::string Description(const CalibrationTarget& target) {
  const std::string size = std::to_string(target.columns) + " x " + std::to_string(target.rows);
  const std::string pitch = Number(1000 * target.pitch_m) + " mm";
  return target.kind == TargetKind::kDots
             ? size + " dots, pitch " + pitch + ", diameter " +
                   Number(1000 * target.dot_diameter_m) + " mm" +
                   (target.marks.empty()
                        ? ""
                        : ", marks " + Number(1000 * target.mark_diameter_m) + " mm")
             : size + " inner corners, squares of " + pitch;
}

}  // namespace

Result<std::string> TargetSheetSvg(const CalibrationTarget& target) {
  const bool dots = target.kind == TargetKind::kDots;
  const double pitch = 1000 * target.pitch_m;
  // White all round: a dot needs its bright ring, a chessboard a rim.
  const double rim = dots ? std::max(0.75 * pitch, 800 * target.mark_diameter_m) : 1.5 * pitch;
  const double grid_width = (target.columns - 1) * pitch + 2 * rim;
  const double grid_height = (target.rows - 1) * pitch + 2 * rim;
  double width = grid_width + 2 * kPaperEdge_mm;
  double height = grid_height + kFooter_mm + 2 * kPaperEdge_mm;
  if (width <= kPaperWidth_mm && height <= kPaperHeight_mm) {
    width = kPaperWidth_mm;
    height = kPaperHeight_mm;
  }
  if (!(std::min(width, height) >= kLeastPage_mm && std::max(width, height) <= kMostPage_mm)) {
    return InvalidError(
        "the sheet would be " + Number(width) + " x " + Number(height) +
        " mm; 40 to 5000 mm a side can be printed, change pitch_m, columns or rows");
  }
  const double x0 = (width - grid_width) / 2 + rim;
  const double y0 = std::max(kPaperEdge_mm, (height - kFooter_mm - grid_height) / 2) + rim;
  const double footer = height - kPaperEdge_mm - kFooter_mm + 4;
  const double bar = width > 220 ? kBar_mm : kSmallBar_mm;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + Number(width) +
                    "mm\" height=\"" + Number(height) + "mm\" viewBox=\"0 0 " + Number(width) +
                    " " + Number(height) +
                    "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>" +
                    "\n<g fill=\"#000\" font-family=\"sans-serif\" font-size=\"3.4\">\n";
  svg += dots ? Dots(target, x0, y0) : Squares(target, x0, y0);
  svg += ScaleBar(kPaperEdge_mm + 4, footer, bar);
  svg += Text(kPaperEdge_mm + 4, footer + 6, "PALACE calibration target: " + Description(target));
  svg += Text(kPaperEdge_mm + 4, footer + 11,
              "Print at 100 %, glue flat to a stiff board, measure the grid from end to end and "
              "correct pitch_m in TARGET.toml.");
  return svg + "</g>\n</svg>\n";
}

CalibrationTarget DefaultTarget() {
  CalibrationTarget target;
  target.columns = 11;
  target.rows = 7;
  target.pitch_m = 0.024;
  target.dot_diameter_m = 0.012;
  target.mark_diameter_m = 0.0168;
  target.marks = {{5, 2}, {8, 2}, {5, 4}};  // unequal arms: a mirrored picture does not fit
  return target;
}

}  // namespace palace
