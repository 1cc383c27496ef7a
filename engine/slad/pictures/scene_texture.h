// Where a picture shows no texture, and where deep shadow lies.
//
// Texture is what both cameras see alike: over a window of 5 blocks the left picture and the right
// one laid over it are correlated after each block's mean is taken out, and once more at half the
// size, over windows of 24 px. Sensor noise is independent in the two, so faint texture counts
// while noise does not, and no noise figure is needed. Without texture: the correlation does not
// stand out of chance; at half the size it does not either, or stereo, which measures at both, has
// next to nothing (beside the rim of a pool the wider window sees the rim); the contrast is no more
// than noise can be, and all this over some 0.3 m. Water, glass, burnt-out ground, and snow or
// roofs as far as stereo has nothing to go by. Not at the rim of the picture, where stereo measures
// little whatever is there. One pair's correlation of faint texture scatters about that limit:
// decided is on its mean over the maps that saw the cell (cell_texture.h).
//
// Deep shadow: less than half as bright as the picture's median, with no more than usual contrast.
#pragma once

#include "engine/slad/pictures/scene_ground.h"

namespace palace {

/// What one pair, or several of the same ground, tell of a block's texture.
struct TextureSeen {
  float alike = 0;         ///< correlation of the cameras over the window, -1 to 1
  float alike_halved = 0;  ///< … at half the size
  float known_share = 0;   ///< of the window's pixels that stereo measured
  float contrast = 0;      ///< variance of the window over the most that may be noise
};

/// A value a block.
struct BlockTexture {
  Image<TextureSeen> seen;
  ImageU8 judged;  ///< 1: its window is seen by both cameras and lies inside what stereo measured
  ImageU8 dark;    ///< 1: deep shadow
};
BlockTexture MeasureTexture(const SceneView& view, const SceneGround& ground);

/// Sets kFlagNoTexture and kFlagShadow in `flags`, a value a block.
void FlagTextureAndShadow(const SceneView& view, const SceneGround& ground, BlockTexture texture,
                          ImageU8& flags);

}  // namespace palace
