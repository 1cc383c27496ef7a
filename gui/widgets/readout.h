// Readout: label, value and unit, with the age of the value when it matters. The digits stay text 1
// in every state; the state goes into a shape and a word below.
#pragma once

#include <string>

#include "gui/widgets/draw.h"

namespace palace {

struct Readout {
  std::string label;
  std::string value;
  std::string unit;
  enum class State { kFresh, kLate, kStale, kNever } state = State::kFresh;
  double age_s = 0;
  std::string over_limit;  ///< "max 2.0 m" when the value is over it, else empty
};

/// Expected period to state: late above 2 periods, stale above 5 periods or 1 s, whichever is
/// larger.
Readout::State AgeState(double age_s, double period_s);
/// Draws into a cell whose top left corner is the label's.
void DrawReadout(UiFrame& ui, const Rect& cell, const Readout& readout);

}  // namespace palace
