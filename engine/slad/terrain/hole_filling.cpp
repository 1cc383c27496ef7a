#include "engine/slad/terrain/hole_filling.h"

#include <algorithm>
#include <vector>

namespace palace {
namespace {

bool IsMeasured(const ElevationMap& map, int r, int c) {
  return map.geometry.Contains({r, c}) && map.state.at(r, c) == CellState::kMeasured;
}

/// Marks unknown runs of at most `longest` cells that have a measured cell at both ends.
void MarkRuns(const ElevationMap& map, int longest, bool along_rows, Grid<char>& hole) {
  const int lines = along_rows ? map.geometry.rows : map.geometry.cols;
  const int length = along_rows ? map.geometry.cols : map.geometry.rows;
  for (int line = 0; line < lines; ++line) {
    int last_known = -1;
    for (int i = 0; i < length; ++i) {
      const Cell cell = along_rows ? Cell{line, i} : Cell{i, line};
      if (map.state.at(cell) != CellState::kMeasured) {
        continue;
      }
      if (last_known >= 0 && i - last_known - 1 <= longest) {
        for (int k = last_known + 1; k < i; ++k) {
          hole.at(along_rows ? Cell{line, k} : Cell{k, line}) = 1;
        }
      }
      last_known = i;
    }
  }
}

void FillCell(ElevationMap& map, int r, int c, int reach) {
  double weight = 0, height = 0, measured = 0, square = 0, variance = 0;
  for (int dr = -reach; dr <= reach; ++dr) {
    for (int dc = -reach; dc <= reach; ++dc) {
      if (!IsMeasured(map, r + dr, c + dc)) {
        continue;
      }
      const double w = 1.0 / (dr * dr + dc * dc);
      const double z = static_cast<double>(map.height_m.at(r + dr, c + dc));
      weight += w;
      height += w * z;
      measured += w * static_cast<double>(map.Measured().at(r + dr, c + dc));
      square += w * z * z;
      variance += w * static_cast<double>(map.variance_m2.at(r + dr, c + dc));
    }
  }
  const double mean = height / weight;
  map.height_m.at(r, c) = static_cast<float>(mean);
  if (!map.measured_m.empty()) {
    map.measured_m.at(r, c) = static_cast<float>(measured / weight);
  }
  map.variance_m2.at(r, c) =
      static_cast<float>(variance / weight + std::max(0.0, square / weight - mean * mean));
}

/// Unknown cells joined to the rim of the map through unknown cells.
Grid<char> OutsideRegion(const ElevationMap& map) {
  const int rows = map.geometry.rows, cols = map.geometry.cols;
  Grid<char> outside(rows, cols, 0);
  std::vector<Cell> stack;
  const auto visit = [&](int r, int c) {
    if (map.geometry.Contains({r, c}) && outside.at(r, c) == 0 &&
        map.state.at(r, c) == CellState::kUnknown) {
      outside.at(r, c) = 1;
      stack.push_back({r, c});
    }
  };
  for (int r = 0; r < rows; ++r) {
    visit(r, 0);
    visit(r, cols - 1);
  }
  for (int c = 0; c < cols; ++c) {
    visit(0, c);
    visit(rows - 1, c);
  }
  while (!stack.empty()) {
    const Cell cell = stack.back();
    stack.pop_back();
    visit(cell.row - 1, cell.col);
    visit(cell.row + 1, cell.col);
    visit(cell.row, cell.col - 1);
    visit(cell.row, cell.col + 1);
  }
  return outside;
}

struct RimCell {
  Cell cell;
  float height_m;
  float measured_m;
  float variance_m2;
};

/// One ring: unknown outside cells that touch a known one, filled together after the scan.
void FillRing(ElevationMap& map, const Grid<char>& outside) {
  std::vector<RimCell> ring;
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      if (outside.at(r, c) == 0 || map.state.at(r, c) != CellState::kUnknown) {
        continue;
      }
      double height = 0, measured = 0, variance = 0;
      int count = 0;
      for (int k = 0; k < 9; ++k) {
        const Cell near{r + k / 3 - 1, c + k % 3 - 1};
        if (map.geometry.Contains(near) && map.state.at(near) != CellState::kUnknown) {
          height += static_cast<double>(map.height_m.at(near));
          measured += static_cast<double>(map.Measured().at(near));
          variance += static_cast<double>(map.variance_m2.at(near));
          ++count;
        }
      }
      if (count > 0) {
        ring.push_back({{r, c},
                        static_cast<float>(height / count),
                        static_cast<float>(measured / count),
                        static_cast<float>(variance / count)});
      }
    }
  }
  for (const RimCell& rim : ring) {
    map.height_m.at(rim.cell) = rim.height_m;
    if (!map.measured_m.empty()) {
      map.measured_m.at(rim.cell) = rim.measured_m;
    }
    map.variance_m2.at(rim.cell) = rim.variance_m2;
    map.state.at(rim.cell) = CellState::kBorder;
  }
}

}  // namespace

void FillHoles(ElevationMap& map, int data_size_cells, int border_size_cells) {
  if (map.state.empty()) {
    return;
  }
  if (data_size_cells > 0) {
    Grid<char> hole(map.geometry.rows, map.geometry.cols, 0);
    MarkRuns(map, data_size_cells, true, hole);
    MarkRuns(map, data_size_cells, false, hole);
    std::vector<Cell> filled;
    for (int r = 0; r < map.geometry.rows; ++r) {
      for (int c = 0; c < map.geometry.cols; ++c) {
        if (hole.at(r, c) != 0) {
          FillCell(map, r, c, data_size_cells);
          filled.push_back({r, c});
        }
      }
    }
    for (const Cell& cell : filled) {
      map.state.at(cell) = CellState::kFilled;
    }
  }
  if (border_size_cells > 0) {
    const Grid<char> outside = OutsideRegion(map);
    for (int ring = 0; ring < border_size_cells; ++ring) {
      FillRing(map, outside);
    }
  }
}

}  // namespace palace
