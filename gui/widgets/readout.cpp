#include "gui/widgets/readout.h"

#include <algorithm>
#include <cmath>

#include "gui/widgets/button.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

/// Its age where that matters; of what is fresh the note that it has.
std::string NoteOf(const Readout& r) {
  switch (r.state) {
    case Readout::State::kFresh:
      return r.note;
    case Readout::State::kNever:
      return "never";
    case Readout::State::kStale:
      return Fixed(r.age_s, 1) + " s old";
    default:
      return Fixed(r.age_s, r.age_s < 1 ? 2 : 1) + " s";
  }
}

/// What fits of "m/s, 240°", whole clauses of it: half of one misleads. The unit itself stays.
std::string_view WholeClauses(const ImFont* font, std::string_view unit, float width) {
  while (TextWidth(font, unit) > width && unit.rfind(',') != std::string_view::npos) {
    unit = unit.substr(0, unit.rfind(','));
  }
  return unit;
}

}  // namespace

void DrawReadout(UiFrame& ui, const Rect& cell, const Readout& r) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  if (!r.why.empty() && Interact(ui, "readout_why", cell, kPassive).hovered) {
    DrawTooltip(ui, r.why, &cell);
  }
  const bool never = r.state == Readout::State::kNever;
  const bool stale = r.state == Readout::State::kStale;
  const bool fresh = r.state == Readout::State::kFresh;
  const std::string note = NoteOf(r);
  const bool tight = cell.h < s.Px(60) && !note.empty();  // the note takes a line of its own
  const std::string value = never ? "––" : r.value;
  const float value_y = cell.y + s.Px(tight ? 21 : 31);
  const std::string_view unit =
      WholeClauses(s.caption, r.unit, cell.w - TextWidth(s.readout, value) - s.Px(10));
  const std::string carried = r.carries_unit ? r.unit.substr(unit.size()) : std::string();
  const std::string label =
      carried.empty() ? r.label : r.label.substr(0, r.label.find(',')) + carried;
  DrawText(ui, s.caption, p.text2, cell.x, cell.y + s.Px(tight ? 4 : 8),
           FitWords(s.caption, label, cell.w));
  if (unit == "°") {  // stands directly after its digit
    DrawText(ui, s.readout, p.text1, cell.x, value_y, never ? value : value + "°");
  } else {
    DrawValueUnit(ui, s.readout, cell.x, value_y, value, unit);
  }
  if (note.empty()) {
    return;
  }
  if (stale) {
    // Over the value alone: what it is a value of stays readable.
    const float half = s.Px(tight ? 11 : 13);
    const Rect veil{cell.x, value_y - half, cell.w - s.Px(4), 2 * half};
    FillRect(Canvas(), veil, WithAlpha(p.panel, 0.22f));
    Hatch(Canvas(), veil, WithAlpha(p.text3, 0.5f), s.Fine(1), s.Px(10));
  }
  const float note_y = cell.y + s.Px(tight ? 40 : 52);
  const bool aged = !never && !fresh;
  DrawIcon(Canvas(), aged ? Icon::kStale : Icon::kOff, {cell.x + s.Px(6), note_y}, s.Px(12),
           aged ? p.caution : p.text2);
  DrawText(ui, s.caption, p.text1, cell.x + s.Px(18), note_y, note);
}

}  // namespace palace
