#include "engine/slad/pictures/line_marks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/slad/pictures/line_sums.h"

namespace palace {
namespace {

constexpr int kTile_px = 32;
constexpr float kMarksPerMean = 2.0F;    // marks of a difference as large as the tile's mean
constexpr float kLeastMean_grey = 2.5F;  // sensor noise

struct Tiles {
  ImageF mean;       ///< of left minus right over left
  ImageF deviation;  ///< mean |difference - mean|
};

/// Of usable blocks only.
Tiles MeasureTiles(const ImageU8& left, const SceneGround& ground) {
  const int cols = (left.width() + kTile_px - 1) / kTile_px;
  const int rows = (left.height() + kTile_px - 1) / kTile_px;
  ImageF sum(cols, rows), spread(cols, rows), count(cols, rows);
  for (int pass = 0; pass < 2; ++pass) {
    for (int y = 0; y < ground.rows() * kBlock_px; y += 2) {
      const std::uint8_t* l = left.row(y);
      const std::uint8_t* r = ground.right.row(y);
      for (int i = 0; i < ground.cols(); ++i) {
        if (ground.usable.at(i, y / kBlock_px) == 0) {
          continue;
        }
        const int tile_col = i * kBlock_px / kTile_px, tile_row = y / kTile_px;
        const float mean = pass == 0 ? 0 : sum.at(tile_col, tile_row);
        float total = 0;
        for (int x = kBlock_px * i; x < kBlock_px * (i + 1); ++x) {
          const float difference = static_cast<float>(l[x] - r[x]) - mean;
          total += pass == 0 ? difference : std::abs(difference);
        }
        (pass == 0 ? sum : spread).at(tile_col, tile_row) += total;
        count.at(tile_col, tile_row) += pass == 0 ? kBlock_px : 0;
      }
    }
    for (std::size_t k = 0; k < sum.pixels().size(); ++k) {
      float& value = (pass == 0 ? sum : spread).pixels()[k];
      value /= std::max(1.0F, count.pixels()[k]);
    }
  }
  return {std::move(sum), std::move(spread)};
}

}  // namespace

ImageU8 MarkDifferences(const ImageU8& left, const SceneGround& ground) {
  const Tiles tiles = MeasureTiles(left, ground);
  ImageU8 marks(left.width(), left.height(), 0);
  for (int y = 0; y < ground.rows() * kBlock_px; ++y) {
    const std::uint8_t* l = left.row(y);
    const std::uint8_t* r = ground.right.row(y);
    std::uint8_t* out = marks.row(y);
    for (int i = 0; i < ground.cols(); ++i) {
      if (ground.usable.at(i, y / kBlock_px) == 0) {
        continue;
      }
      const int tile_col = i * kBlock_px / kTile_px, tile_row = y / kTile_px;
      const float mean = tiles.mean.at(tile_col, tile_row);
      const float gain =
          kMarksPerMean / std::max(kLeastMean_grey, tiles.deviation.at(tile_col, tile_row));
      for (int x = kBlock_px * i; x < kBlock_px * (i + 1); ++x) {
        const float mark = std::abs(static_cast<float>(l[x] - r[x]) - mean) * gain;
        out[x] = static_cast<std::uint8_t>(std::min(mark, static_cast<float>(kLargestMark)));
      }
    }
  }
  return marks;
}

ImageU8 MarkRidges(const ImageU8& left) {
  const int width = left.width(), picture_rows = left.height();
  ImageU8 marks(width, picture_rows, 0);
  std::vector<int> ridge(static_cast<std::size_t>(width));
  // The usual height of ridges, tile by tile along a band of rows.
  for (int band = kRidge_px; band < picture_rows - kRidge_px; band += kTile_px) {
    const int end = std::min(band + kTile_px, picture_rows - kRidge_px);
    std::vector<float> sum(static_cast<std::size_t>(width / kTile_px + 1), 0.0F);
    for (const bool marking : {false, true}) {
      for (int y = band; y < end; y += marking ? 1 : 4) {
        const std::uint8_t *up = left.row(y - kRidge_px), *here = left.row(y),
                           *down = left.row(y + kRidge_px);
        int* height = ridge.data();
        for (int x = 0; x < width; ++x) {
          const int dark = std::min<int>(up[x], down[x]) - here[x];
          const int bright = here[x] - std::max<int>(up[x], down[x]);
          height[x] = std::max(0, std::max(dark, bright));
        }
        for (int x0 = 0; x0 < width; x0 += kTile_px) {
          const int x1 = std::min(x0 + kTile_px, width);
          float& total = sum[static_cast<std::size_t>(x0 / kTile_px)];
          const float rows = static_cast<float>((end - band + 3) / 4);
          const float mean = total / (rows * static_cast<float>(x1 - x0));
          const float gain = kMarksPerMean / std::max(kLeastMean_grey, mean);
          const int* r = ridge.data();
          if (!marking) {
            total += static_cast<float>(std::accumulate(r + x0, r + x1, 0));
            continue;
          }
          std::uint8_t* out = marks.row(y);
          for (int x = x0; x < x1; ++x) {
            out[x] = static_cast<std::uint8_t>(
                std::min(static_cast<float>(r[x]) * gain, static_cast<float>(kLargestMark)));
          }
        }
      }
    }
  }
  return marks;
}

ImageU8 Transposed(const ImageU8& picture) {
  constexpr int kTile = 16;
  ImageU8 turned(picture.height(), picture.width());
  for (int y0 = 0; y0 < picture.height(); y0 += kTile) {
    for (int x0 = 0; x0 < picture.width(); x0 += kTile) {
      for (int x = x0; x < std::min(x0 + kTile, picture.width()); ++x) {
        std::uint8_t* out = turned.row(x);
        for (int y = y0; y < std::min(y0 + kTile, picture.height()); ++y) {
          out[y] = picture.at(x, y);
        }
      }
    }
  }
  return turned;
}

}  // namespace palace
