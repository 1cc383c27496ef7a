// Spread of the frames about a cell's fused height: relief that a mean would lose.
//
// Pose noise puts what is narrower than a cell on its top in one frame and beside it in the next,
// and a tall thing at the rim leans out of most pictures. With the frames' mean height at o above
// the fused one, mean square S about it, mean cube C and mean noise variance R, the published
// height is
//
//   m + max(0, o + min(1, t + sqrt(1 + t^2)) sqrt(S - q R)),   t = C / (2 S^1.5),   where S > q R
//
// q is what S / R of that many frames exceeds by noise alone in about one cell of a million: the
// upper side counts, as it does for the spread of points inside a cell. The factor is the place of
// the upper of two levels that have this skewness, in parts of their spread: 1 for levels seen
// equally often, less where a few frames lie below all others, no more than 1 where few see the
// top. What fewer than 1.5 of n frames see is a false match and no relief: then 2 t is more than
// (1 - 2 p) / sqrt(p (1 - p)) with p = 1.5 / n. Means run over the frames remembered; what is gone
// fades with them. Frames outside fusion's
// gate count here. Their order does not matter while all are remembered.
#pragma once

#include <cstdint>

#include "engine/model/elevation_map.h"

namespace palace {

/// Heights are above the fused one of the cell.
struct FrameSpread {
  float mean_m = 0;     ///< o
  float square_m2 = 0;  ///< S
  float cube_m3 = 0;    ///< C
  float noise_m2 = 0;   ///< R
  std::uint16_t frames = 0;

  /// One more frame, `off_m` above the fused height.
  void Add(double off_m, double frame_noise_m2, int memory);
  /// The fused height has risen by `rise_m`.
  void Follow(double rise_m) { mean_m -= static_cast<float>(rise_m); }
  double Relief_m() const;
};

/// `spread` has the map's size. Only measured cells rise; none is lowered.
void AddReliefBetweenFrames(const Grid<FrameSpread>& spread, ElevationMap& map);

}  // namespace palace
