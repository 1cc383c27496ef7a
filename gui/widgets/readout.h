// Readout: label, value and unit, with the age of the value when it matters. The digits stay text 1
// in every state; the state goes into a shape and a word below.
#pragma once

#include <string>

#include "engine/model/channel.h"
#include "gui/widgets/draw.h"

namespace palace {

struct Readout {
  std::string label;
  std::string value;
  std::string unit;
  using State = ChannelHealth::State;
  State state = State::kFresh;  ///< of the channel it came by, as the engine says
  double age_s = 0;
  std::string why{};   ///< a tooltip: why it is this figure and no other
  std::string note{};  ///< below it, in a word, while it is fresh
  /// A clause of the unit that has no room behind the value goes into the label: "Wind, 240°" of
  /// "Wind, from".
  bool carries_unit = false;
};

/// Draws into a cell whose top left corner is the label's.
void DrawReadout(UiFrame& ui, const Rect& cell, const Readout& readout);

}  // namespace palace
