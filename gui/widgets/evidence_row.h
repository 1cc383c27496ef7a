// Evidence rows: one figure each as the share of its limit used. All bars end at one wall, the
// limit. Who enforces a limit stands behind it; a figure that nobody enforces has no wall.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/model/mission/limit_row.h"
#include "gui/widgets/draw.h"

namespace palace {

struct EvidenceRow {
  std::string name;        ///< "Slope"
  std::string value;       ///< "2.1"; "––" when unknown
  std::string spread;      ///< "± 0.3°"; with the unit. Empty when the figure has none
  std::string unit;        ///< of the value where no spread is shown
  std::string limit;       ///< "max 10°"; "for information"
  std::string enforcer{};  ///< "guard"; empty when nobody enforces the limit
  double share = NAN;      ///< of the limit used: 1 is at the wall. NaN: unknown, or no limit
  double share_3s = NAN;   ///< three sigma of the share; NaN: no whisker
  bool over = false;       ///< as the engine says
};

/// The row as the screen shows it.
EvidenceRow RowOf(const LimitRow& limit);

/// Draws rows from the top of `rect` (full panel width); items "evidence/<name>".
void DrawEvidenceRows(UiFrame& ui, const Rect& rect, const std::vector<EvidenceRow>& rows,
                      bool narrow);
inline float EvidenceRowHeight(const Style& s, bool narrow) { return s.Px(narrow ? 26 : 28); }

}  // namespace palace
