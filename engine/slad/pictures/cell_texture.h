// The texture of the map's cells over several maps.
//
// What one pair shows of faint texture (snow, a roof) scatters about the limit, from frame to frame
// and from cell to cell; its noise is new in each. A cell's evidence is the mean over its blocks
// and the last maps that saw it, each map counting 1/n until n = 10 and 1/10 from then on, and a
// block is judged by the mean of the cell that it lies on. Cells out of view keep theirs.
// Source: ours.
#pragma once

#include <vector>

#include "engine/model/grid.h"
#include "engine/slad/pictures/scene_texture.h"

namespace palace {

class CellTexture {
 public:
  void Reset();
  /// The grid moves by whole cells; cells that leave it are forgotten. Another cell size starts
  /// afresh.
  void MoveTo(const GridGeometry& geometry);
  /// Takes the judged blocks in, and gives each the mean of its cell. `cell_of_block`: index of the
  /// cell that a block lies on, in the order of its picture; negative: none, the block keeps its
  /// own.
  void Add(const std::vector<int>& cell_of_block, BlockTexture& texture);

 private:
  struct Mean {
    TextureSeen seen;
    int maps = 0;
  };
  GridGeometry geometry_;
  Grid<Mean> means_;
};

}  // namespace palace
