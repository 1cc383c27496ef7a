// Evidence rows: one figure each as the share of its limit used. All bars end at one wall, the
// limit.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gui/widgets/draw.h"

namespace palace {

struct EvidenceRow {
  std::string name;       ///< "Slope"
  std::string value;      ///< "2.1"; "––" when unknown
  std::string spread;     ///< "± 0.3°"; with the unit. Empty when the figure has none
  std::string unit;       ///< of the value where no spread is shown
  std::string limit;      ///< "max 10°"
  double share = NAN;     ///< of the limit used: 1 is at the wall. NaN: unknown
  double share_3s = NAN;  ///< three sigma of the share; NaN: no whisker
};

/// Share of a "max" limit used.
inline double ShareOfMax(double value, double limit) { return value / limit; }
/// Share of a "min" limit used: limit / value.
inline double ShareOfMin(double value, double limit) {
  return value > 0 ? limit / value : (std::isfinite(value) ? 10.0 : NAN);
}
/// Share of a probability limit used: (1 - p) / (1 - limit).
inline double ShareOfProbability(double p, double limit) {
  return (1 - p) / std::max(1 - limit, 1e-9);
}

/// Draws rows from the top of `rect` (full panel width); items "evidence/<name>".
void DrawEvidenceRows(UiFrame& ui, const Rect& rect, const std::vector<EvidenceRow>& rows,
                      bool narrow);
inline float EvidenceRowHeight(const Style& s, bool narrow) { return s.Px(narrow ? 26 : 28); }

}  // namespace palace
