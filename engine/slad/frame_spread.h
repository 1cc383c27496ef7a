// Spread of the frames about a cell's fused height: relief that a mean would lose.
//
// Pose noise puts what is narrower than a cell on its top in one frame and beside it in the next,
// and a tall thing at the rim leans out of most pictures. The published height is
//
//   m + sqrt(max(0, S - q R)),
//
// S the frames' mean square about m, R their mean variance, q what S / R of that many frames
// exceeds by noise alone in one cell of ten thousand: the upper side counts, as it does for the
// spread of points inside a cell. Means run over the frames remembered; what is gone fades with
// them. Frames outside fusion's gate count here.
#pragma once

#include <cstdint>

#include "engine/model/elevation_map.h"

namespace palace {

struct FrameSpread {
  float seen_m2 = 0;   ///< S
  float noise_m2 = 0;  ///< R
  std::uint16_t frames = 0;

  /// One more frame, off the mean of those before by the root of `square_m2`.
  void Add(double square_m2, double frame_noise_m2, int memory);
  double Relief_m() const;
};

/// `spread` has the map's size. Only measured cells rise; none is lowered.
void AddReliefBetweenFrames(const Grid<FrameSpread>& spread, ElevationMap& map);

}  // namespace palace
