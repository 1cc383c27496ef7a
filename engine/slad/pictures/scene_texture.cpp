#include "engine/slad/pictures/scene_texture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/median.h"
#include "engine/model/elevation_map.h"
#include "engine/model/half_size.h"

namespace palace {
namespace {

constexpr int kReach_blocks = kRim_blocks;  // of the window
constexpr int kReachOfHalved_blocks = 1;    // … of pictures at half the size
// From the middle of the wider window to its rim.
constexpr int kGrow_blocks = 2 * kReachOfHalved_blocks + 1;
constexpr float kLeastCorrelation = 0.25F;  // chance alone: 0.05
constexpr float kMostKnown = 0.35F;         // share of the window stereo measured
constexpr float kMostNoise_grey = 5;        // contrast that may be noise
constexpr float kLeastUsable = 8;           // blocks of the window
constexpr float kShadow = 0.5F;             // of the median brightness
constexpr double kLeastSize_m = 0.3;

/// Sums over one block after its mean is taken out; sums over a window after BoxSum.
struct BlockSums {
  ImageF left;    ///< of squares
  ImageF right;   ///< of squares
  ImageF both;    ///< of products
  ImageF usable;  ///< 1 or 0
  ImageF bright;  ///< mean of the left picture; not smeared
};

/// `usable`: a value a block.
BlockSums SumBlocks(const ImageU8& left, const ImageU8& right, const ImageU8& usable) {
  constexpr float kCount = kBlock_px * kBlock_px;
  const int cols = usable.width(), rows = usable.height();
  const ImageF none(cols, rows, 0.0F);
  BlockSums sums{none, none, none, none, none};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < cols; ++i) {
      int l = 0, r = 0, ll = 0, rr = 0, lr = 0;
      for (int y = kBlock_px * j; y < kBlock_px * (j + 1); ++y) {
        const std::uint8_t* a = left.row(y) + kBlock_px * i;
        const std::uint8_t* b = right.row(y) + kBlock_px * i;
        for (int x = 0; x < kBlock_px; ++x) {
          l += a[x];
          r += b[x];
          ll += a[x] * a[x];
          rr += b[x] * b[x];
          lr += a[x] * b[x];
        }
      }
      const float fl = static_cast<float>(l), fr = static_cast<float>(r);
      const float use = usable.at(i, j) != 0 ? 1.0F : 0.0F;
      sums.bright.at(i, j) = fl / kCount;
      sums.left.at(i, j) = use * (static_cast<float>(ll) - fl * fl / kCount);
      sums.right.at(i, j) = use * (static_cast<float>(rr) - fr * fr / kCount);
      sums.both.at(i, j) = use * (static_cast<float>(lr) - fl * fr / kCount);
      sums.usable.at(i, j) = use;
    }
  }
  return sums;
}

/// Replaces each value by the sum over its window; beyond the border nothing is added.
void BoxSum(int reach, ImageF& values) {
  const int cols = values.width(), rows = values.height();
  ImageF along(cols, rows, 0.0F);
  for (int j = 0; j < rows; ++j) {
    for (int d = -reach; d <= reach; ++d) {
      const float* in = values.row(j);
      float* out = along.row(j);
      for (int i = std::max(0, -d); i < std::min(cols, cols - d); ++i) {
        out[i] += in[i + d];
      }
    }
  }
  for (int j = 0; j < rows; ++j) {
    float* out = values.row(j);
    std::fill_n(out, cols, 0.0F);
    for (int k = std::max(0, j - reach); k <= std::min(rows - 1, j + reach); ++k) {
      const float* in = along.row(k);
      for (int i = 0; i < cols; ++i) {
        out[i] += in[i];
      }
    }
  }
}

void SumOverWindows(int reach, BlockSums& sums) {
  for (ImageF* layer : {&sums.left, &sums.right, &sums.both, &sums.usable}) {
    BoxSum(reach, *layer);
  }
}

/// How much alike the cameras see the window; nothing is alike where one sees nothing.
float Alike(const BlockSums& sums, int i, int j) {
  const float square = sums.left.at(i, j) * sums.right.at(i, j);
  return square > 0 ? sums.both.at(i, j) / std::sqrt(square) : 0.0F;
}

/// No more alike than chance gives, no more contrast than noise, over the whole window.
bool IsBare(const TextureSeen& seen) {
  return seen.alike <= kLeastCorrelation && seen.contrast < 1 &&
         (seen.alike_halved <= kLeastCorrelation || seen.known_share < kMostKnown);
}

/// The same over pictures at half the size, in blocks that cover four each.
BlockSums SumHalvedBlocks(const ImageU8& left, const SceneGround& ground) {
  ImageU8 usable(ground.cols() / 2, ground.rows() / 2, 0);
  for (int j = 0; j < usable.height(); ++j) {
    for (int i = 0; i < usable.width(); ++i) {
      usable.at(i, j) =
          std::max({ground.usable.at(2 * i, 2 * j), ground.usable.at(2 * i + 1, 2 * j),
                    ground.usable.at(2 * i, 2 * j + 1), ground.usable.at(2 * i + 1, 2 * j + 1)});
    }
  }
  BlockSums sums = SumBlocks(HalfSize(left), HalfSize(ground.right), usable);
  SumOverWindows(kReachOfHalved_blocks, sums);
  return sums;
}

float MedianOf(std::vector<float> values) { return values.empty() ? 0.0F : UpperMedian(values); }

/// Grows what is 1 by a block (or, `grow` false, what is 0).
void DilateOrErode(ImageU8& mask, bool grow) {
  const ImageU8 before = mask;
  const std::uint8_t wins = grow ? 1 : 0;
  for (int j = 0; j < mask.height(); ++j) {
    for (int i = 0; i < mask.width(); ++i) {
      for (const auto& [di, dj] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        if (before.Contains(i + di, j + dj) && before.at(i + di, j + dj) == wins) {
          mask.at(i, j) = wins;
        }
      }
    }
  }
}

/// Drops areas narrower than 2 steps + 1 blocks.
void OpenMask(ImageU8& mask, int steps) {
  for (int k = 0; k < steps; ++k) {
    DilateOrErode(mask, false);
  }
  for (int k = 0; k < steps; ++k) {
    DilateOrErode(mask, true);
  }
}

/// Blocks of a row between the first and the last that stereo measured. Beyond them the ground's
/// disparity is a guess, or one camera does not look there: no texture in common says nothing.
struct Enclosed {
  int first = 0;
  int end = 0;
};

Enclosed MeasuredOnBothSides(const SceneGround& ground, int row) {
  const float* known = ground.known_share.row(row);
  Enclosed blocks{0, ground.cols()};
  while (blocks.first < blocks.end && known[blocks.first] <= 0) {
    ++blocks.first;
  }
  while (blocks.end > blocks.first && known[blocks.end - 1] <= 0) {
    --blocks.end;
  }
  return blocks;
}

bool HasAny(const ImageU8& mask) {
  return std::any_of(mask.pixels().begin(), mask.pixels().end(), [](auto m) { return m != 0; });
}

void SetFlag(const ImageU8& mask, TerrainFlag flag, ImageU8& flags) {
  for (std::size_t k = 0; k < mask.pixels().size(); ++k) {
    flags.pixels()[k] |= mask.pixels()[k] != 0 ? flag : kFlagNone;
  }
}

}  // namespace

BlockTexture MeasureTexture(const SceneView& view, const SceneGround& ground) {
  BlockSums sums = SumBlocks(*view.left, ground.right, ground.usable);
  SumOverWindows(kReach_blocks, sums);
  const BlockSums halved = SumHalvedBlocks(*view.left, ground);
  ImageF known = ground.known_share;
  for (std::size_t k = 0; k < known.pixels().size(); ++k) {
    known.pixels()[k] *= ground.usable.pixels()[k] != 0 ? 1.0F : 0.0F;
  }
  BoxSum(kReach_blocks, known);
  constexpr float kFree = kBlock_px * kBlock_px - 1;  // of a block's pixels, its mean known
  const float usual_bright = MedianOf(sums.bright.pixels());
  const float usual_contrast = MedianOf(sums.left.pixels());
  BlockTexture texture{{ground.cols(), ground.rows()},
                       ImageU8(ground.cols(), ground.rows(), 0),
                       ImageU8(ground.cols(), ground.rows(), 0)};
  for (int j = kRim_blocks; j < ground.rows() - kRim_blocks; ++j) {
    const Enclosed row = MeasuredOnBothSides(ground, j);
    for (int i = row.first; i < row.end; ++i) {
      const float usable = sums.usable.at(i, j);
      if (usable < kLeastUsable) {
        continue;
      }
      const float left = sums.left.at(i, j);
      const int i2 = std::min(i / 2, halved.left.width() - 1);
      const int j2 = std::min(j / 2, halved.left.height() - 1);
      texture.judged.at(i, j) = 1;
      texture.seen.at(i, j) = {Alike(sums, i, j), Alike(halved, i2, j2), known.at(i, j) / usable,
                               left / (kMostNoise_grey * kMostNoise_grey * kFree * usable)};
      texture.dark.at(i, j) =
          sums.bright.at(i, j) < kShadow * usual_bright && left <= usual_contrast;
    }
  }
  return texture;
}

void FlagTextureAndShadow(const SceneView& view, const SceneGround& ground, BlockTexture texture,
                          ImageU8& flags) {
  const double depth_m = view.range->FocalTimesBaseline() /
                         static_cast<double>(MedianOf(ground.disparity_px.pixels()));
  const double block_m = kBlock_px * depth_m / view.range->camera.fx_px;
  const int steps = std::clamp(static_cast<int>(std::lround(kLeastSize_m / 2 / block_m)), 1, 8);
  ImageU8 bare(ground.cols(), ground.rows(), 0);
  for (std::size_t k = 0; k < bare.pixels().size(); ++k) {
    bare.pixels()[k] = texture.judged.pixels()[k] != 0 && IsBare(texture.seen.pixels()[k]);
  }
  if (HasAny(bare)) {
    // A window is bare only when the area around is: small areas are gone already, and the rim of
    // large ones is.
    OpenMask(bare, std::max(0, steps - kGrow_blocks));
    for (int k = 0; k < kGrow_blocks; ++k) {
      DilateOrErode(bare, true);
    }
    SetFlag(bare, kFlagNoTexture, flags);
  }
  if (HasAny(texture.dark)) {
    OpenMask(texture.dark, steps);
    SetFlag(texture.dark, kFlagShadow, flags);
  }
}

}  // namespace palace
