#include "gui/widgets/readout.h"

#include <algorithm>
#include <cmath>

#include "gui/widgets/icons.h"
#include "gui/widgets/number_text.h"

namespace palace {

void DrawReadout(UiFrame& ui, const Rect& cell, const Readout& r) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const bool never = r.state == Readout::State::kNever;
  const bool stale = r.state == Readout::State::kStale;
  DrawText(ui, s.caption, p.text2, cell.x, cell.y + s.Px(8), FitWords(s.caption, r.label, cell.w));
  const std::string value = never ? "––" : r.value;
  const float value_y = cell.y + s.Px(31);
  std::string_view unit = r.unit;
  if (TextWidth(s.readout, value) + TextWidth(s.caption, unit) + s.Px(10) > cell.w) {
    unit = FitWords(s.caption, unit, cell.w - TextWidth(s.readout, value) - s.Px(10));
  }
  if (unit == "°") {  // stands directly after its digit
    DrawText(ui, s.readout, p.text1, cell.x, value_y, never ? value : value + "°");
  } else {
    DrawValueUnit(ui, s.readout, cell.x, value_y, value, unit);
  }
  if (r.state == Readout::State::kFresh) {
    return;
  }
  if (stale) {
    const Rect veil{cell.x, cell.y, cell.w - s.Px(4), s.Px(44)};
    FillRect(Canvas(), veil, WithAlpha(p.panel, 0.22f));
    Hatch(Canvas(), veil, WithAlpha(p.text3, 0.5f), s.Fine(1), s.Px(10));
  }
  Icon icon = Icon::kStale;
  ImU32 colour = p.caution;
  std::string note = Fixed(r.age_s, r.age_s < 1 ? 2 : 1) + " s";
  if (never) {
    icon = Icon::kOff;
    colour = p.text2;
    note = "never";
  } else if (stale) {
    note = Fixed(r.age_s, 1) + " s old";
  }
  const float note_y = cell.y + s.Px(52);
  DrawIcon(Canvas(), icon, {cell.x + s.Px(6), note_y}, s.Px(12), colour);
  DrawText(ui, s.caption, p.text1, cell.x + s.Px(18), note_y, note);
}

}  // namespace palace
