#include "engine/slad/pictures/cell_texture.h"

#include <algorithm>
#include <cstddef>

namespace palace {
namespace {

constexpr int kMaps = 10;

/// Moves each figure by a share of its difference to the other's.
void MoveTowards(const TextureSeen& other, float share, TextureSeen& seen) {
  seen.alike += share * (other.alike - seen.alike);
  seen.alike_halved += share * (other.alike_halved - seen.alike_halved);
  seen.known_share += share * (other.known_share - seen.known_share);
  seen.contrast += share * (other.contrast - seen.contrast);
}

}  // namespace

void CellTexture::Reset() {
  geometry_ = {};
  means_ = {};
}

void CellTexture::MoveTo(const GridGeometry& geometry) {
  if (!(geometry == geometry_)) {
    means_ = MovedTo(geometry, geometry_, means_);
    geometry_ = geometry;
  }
}

void CellTexture::Add(const std::vector<int>& cell_of_block, BlockTexture& texture) {
  std::vector<TextureSeen>& blocks = texture.seen.pixels();
  PALACE_CHECK(cell_of_block.size() == blocks.size(), cell_of_block.size(), blocks.size());
  struct OfMap {
    TextureSeen mean;
    int blocks = 0;
  };
  std::vector<OfMap> of_map(means_.cells().size());
  const auto cell_of = [&](std::size_t block) {
    const bool counts = texture.judged.pixels()[block] != 0 && cell_of_block[block] >= 0;
    return counts ? static_cast<std::ptrdiff_t>(cell_of_block[block]) : -1;
  };
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    if (const std::ptrdiff_t cell = cell_of(block); cell >= 0) {
      OfMap& now = of_map[static_cast<std::size_t>(cell)];
      ++now.blocks;
      MoveTowards(blocks[block], 1.0F / static_cast<float>(now.blocks), now.mean);
    }
  }
  for (std::size_t cell = 0; cell < of_map.size(); ++cell) {
    Mean& mean = means_.cells()[cell];
    if (of_map[cell].blocks > 0) {
      mean.maps = std::min(kMaps, mean.maps + 1);
      MoveTowards(of_map[cell].mean, 1.0F / static_cast<float>(mean.maps), mean.seen);
    }
  }
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    if (const std::ptrdiff_t cell = cell_of(block); cell >= 0) {
      blocks[block] = means_.cells()[static_cast<std::size_t>(cell)].seen;
    }
  }
}

}  // namespace palace
