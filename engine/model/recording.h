// How the record of the flight stands, as the screen tells it.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

namespace palace {

struct RecordState {
  /// Until nothing at all can be written any more, at the present rate; NaN when unknown.
  double minutes_left = NAN;
  /// Of the pairs of pictures every n-th is written, because the disk fills: 1 all, 0 none.
  int pictures_every = 1;
  std::uint64_t pairs_left_out = 0;  ///< for want of space, so far
  std::string problem{};             ///< why nothing is written; empty while it is
};

/// "every 2nd pair of pictures is recorded", "no pictures are recorded"; empty for all.
inline std::string ThinningWords(int pictures_every) {
  if (pictures_every == 1) {
    return {};
  }
  return pictures_every == 0
             ? "no pictures are recorded"
             : "every " + std::to_string(pictures_every) + (pictures_every == 2 ? "nd" : "th") +
                   " pair of pictures is recorded";
}

}  // namespace palace
