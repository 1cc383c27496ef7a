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
  std::string age{};  ///< "8.8 s old": of what was, not what is, grey, in place of bar and enforcer
  std::string lasts{};  ///< LimitRow: how long it must be over; behind the enforcer where wide
};

/// The row as the screen shows it.
EvidenceRow RowOf(const LimitRow& limit);

inline float EvidenceRowHeight(const Style& s, bool narrow) { return s.Px(narrow ? 26 : 28); }

/// Which row stands at the top of rows that have more than their room.
struct RowScroll {
  int first = 0;
};
/// How many rows more than `area` holds; at least one is held.
std::size_t RowsBeyond(const Rect& area, std::size_t rows, const Style& style, bool narrow);
/// "+3 rows"; empty where all have room.
std::string RowsBeyondWords(std::size_t beyond);
/// As many rows as `area` (full panel width) holds whole, items "evidence/<name>". Where there are
/// more, the wheel over them, or Up and Down on item `name`, bring the others into sight.
void DrawScrolledRows(UiFrame& ui, std::string_view name, const Rect& area,
                      const std::vector<EvidenceRow>& rows, bool narrow, RowScroll& scroll);

}  // namespace palace
