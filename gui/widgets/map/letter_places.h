// Where the letters of sites stand on a map, so that none covers another.
//
// The best has the first choice: at its own place where that is free, else beside it, on the first
// free step round it and outwards. A letter that stands beside its place is to be joined to it by a
// line. It stays where it stood, so that no letter jumps under a pointer, until its own place is
// free by half a step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gui/widgets/ui_frame.h"

namespace palace {

struct LetterPlace {
  std::uint64_t site = 0;
  ImVec2 anchor;   ///< the place itself, on the screen
  ImVec2 half;     ///< half the size of the letter's mark
  ImVec2 shift{};  ///< of the mark from its place
  bool moved = false;

  ImVec2 centre() const { return {anchor.x + shift.x, anchor.y + shift.y}; }
};

/// Sets the shifts of `letters`, best first. `last`: those of the frame before. Marks are kept in
/// `within`; where no step is free they stay at their places.
void SpreadLetters(std::vector<LetterPlace>& letters, const std::vector<LetterPlace>& last,
                   const Rect& within);

/// Where a letter stands that belongs to a ring: beside its cross, `beside` away to a side and up or
/// down, on the first of its four corners, upper right first, where it covers none of `others`;
/// upper right where each does. `letter` has its anchor in the cross. Kept in `within`.
ImVec2 CornerOfRing(const LetterPlace& letter, ImVec2 beside, std::span<const LetterPlace> others,
                    const Rect& within);

}  // namespace palace
