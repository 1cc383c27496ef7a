#include "engine/slad/pictures/scene_flags.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/slad/pictures/scene_texture.h"
#include "engine/slad/pictures/thin_structures.h"
#include "engine/slad/terrain/air_seen.h"

namespace palace {
namespace {

constexpr std::array<TerrainFlag, 3> kBlockKinds = {kFlagNoTexture, kFlagShadow, kFlagMotion};
constexpr int kFlaggedOneIn = 2;  // blocks of a cell

/// How many blocks fell into a cell, and how many of them had each kind.
struct CellCount {
  int blocks = 0;
  std::array<int, kBlockKinds.size()> flagged{};
};

Grid<CellCount> CountBlocks(const std::vector<int>& cell_of_block, const ImageU8& flags,
                            const GridGeometry& geometry) {
  Grid<CellCount> counts(geometry.rows, geometry.cols);
  for (std::size_t block = 0; block < cell_of_block.size(); ++block) {
    if (cell_of_block[block] < 0) {
      continue;
    }
    CellCount& count = counts.cells()[static_cast<std::size_t>(cell_of_block[block])];
    ++count.blocks;
    for (std::size_t k = 0; k < kBlockKinds.size(); ++k) {
      count.flagged[k] += (flags.pixels()[block] & kBlockKinds[k]) != 0 ? 1 : 0;
    }
  }
  return counts;
}

/// Index of the cell that each block's middle lies on; -1 off the map and at the picture's rim.
std::vector<int> CellsOfBlocks(const SceneView& view, const SceneGround& ground,
                               const GridGeometry& geometry) {
  constexpr double kMiddle_px = (kBlock_px - 1) / 2.0;
  std::vector<int> cells(ground.disparity_px.pixels().size(), -1);
  for (int j = kRim_blocks; j < ground.rows() - kRim_blocks; ++j) {
    for (int i = kRim_blocks; i < ground.cols() - kRim_blocks; ++i) {
      const Eigen::Vector3d p_W =
          PointAt(view, kBlock_px * i + kMiddle_px, kBlock_px * j + kMiddle_px,
                  static_cast<double>(ground.disparity_px.at(i, j)));
      if (const auto cell = geometry.CellFromPoint(p_W.x(), p_W.y())) {
        cells[static_cast<std::size_t>(j * ground.cols() + i)] =
            cell->row * geometry.cols + cell->col;
      }
    }
  }
  return cells;
}

/// The cells below a piece, and their neighbours; the highest piece over a cell counts. One that
/// lies on the ground is told as a top of minus infinity.
void FlagBelow(const ThinPiece& piece, const GridGeometry& geometry, Grid<std::uint8_t>& found,
               Grid<ThinSight>& thin) {
  const Eigen::Vector2d from = piece.from_W.head<2>(), to = piece.to_W.head<2>();
  const double length_m = (to - from).norm();
  if (!(length_m < 1e4)) {
    return;
  }
  const bool lies = piece.height == ThinHeight::kOnGround;
  const double top_m =
      piece.height == ThinHeight::kKnown
          ? std::max(HeightFromDown(piece.from_W.z()), HeightFromDown(piece.to_W.z()))
          : (lies ? -1 : 1) * std::numeric_limits<double>::infinity();
  const ThinSight sight{static_cast<float>(top_m),
                        static_cast<float>(std::atan2(to.y() - from.y(), to.x() - from.x()))};
  const int steps = 1 + static_cast<int>(2 * length_m / geometry.cell_m);
  for (int k = 0; k <= steps; ++k) {
    const Eigen::Vector2d p = from + (to - from) * k / steps;
    const auto cell = geometry.CellFromPoint(p.x(), p.y());
    if (!cell) {
      continue;
    }
    for (int r = cell->row - 1; r <= cell->row + 1; ++r) {
      for (int c = cell->col - 1; c <= cell->col + 1; ++c) {
        if (geometry.Contains({r, c})) {
          found.at(r, c) |= lies ? kFlagNone : kFlagThinStructure;
          ThinSight& above = thin.at(r, c);
          above = above.top_m >= sight.top_m ? above : sight;
        }
      }
    }
  }
}

/// Whether a thin thing at that place would be found: it is in the picture, and not too near.
bool WouldShow(const SceneView& view, const Eigen::Vector3d& p_W) {
  const PinholeCamera& camera = view.range->camera;
  const Eigen::Vector3d p_C = view.X_WC().Inverse() * p_W;
  const double x = camera.fx_px * p_C.x() / p_C.z() + camera.cx_px;
  const double y = camera.fy_px * p_C.y() / p_C.z() + camera.cy_px;
  return p_C.z() >= kNearestThin_m && x >= 0 && x < camera.width && y >= 0 && y < camera.height;
}

/// What was found from farther away stands while it is too near, or out of the picture, over ground
/// that is in view: not to find it then is no look at it.
void LeaveWhatWouldNotShow(const SceneView& view, const GridF& tops_m, const GridGeometry& geometry,
                           Grid<std::uint8_t>& seen) {
  for (int r = 0; r < tops_m.rows(); ++r) {
    for (int c = 0; c < tops_m.cols(); ++c) {
      const double top_m = static_cast<double>(tops_m.at(r, c));
      if (std::isfinite(top_m) &&
          !WouldShow(view, {geometry.NorthOfRow(r), geometry.EastOfCol(c), -top_m})) {
        seen.at(r, c) &= static_cast<std::uint8_t>(~unsigned{kFlagThinStructure});
      }
    }
  }
}

}  // namespace

void SceneFlags::Reset() {
  motion_.Reset();
  older_.Reset();
  memory_.Reset();
  texture_.Reset();
}

void SceneFlags::DoubtViews() {
  motion_.Reset();
  older_.Reset();
  texture_.Reset();
  memory_.ForgetMotion();
}

Grid<std::uint8_t> SceneFlags::Add(const SceneView& view, const GridGeometry& geometry) {
  memory_.MoveTo(geometry);
  texture_.MoveTo(geometry);
  const SceneGround ground = FindSceneGround(view);
  if (ground.empty()) {
    return memory_.Flags();
  }
  ImageU8 blocks(ground.cols(), ground.rows(), kFlagNone);
  const std::vector<int> cell_of_block = CellsOfBlocks(view, ground, geometry);
  BlockTexture texture = MeasureTexture(view, ground);
  texture_.Add(cell_of_block, texture);
  FlagTextureAndShadow(view, ground, std::move(texture), blocks);
  const bool compared = motion_.Flag(view, ground, blocks);

  const unsigned looked_for =
      kFlagNoTexture | kFlagShadow |
      (CanTellThinStructures(view, ground) ? kFlagThinStructure : kFlagNone) |
      (compared ? kFlagMotion : kFlagNone);
  Grid<std::uint8_t> seen(geometry.rows, geometry.cols, kFlagNone), found = seen;
  const Grid<CellCount> counts = CountBlocks(cell_of_block, blocks, geometry);
  for (std::size_t cell = 0; cell < seen.cells().size(); ++cell) {
    const CellCount& count = counts.cells()[cell];
    seen.cells()[cell] = static_cast<std::uint8_t>(count.blocks > 0 ? looked_for : 0U);
    for (std::size_t k = 0; k < kBlockKinds.size(); ++k) {
      if (count.blocks > 0 && kFlaggedOneIn * count.flagged[k] >= count.blocks) {
        found.cells()[cell] |= kBlockKinds[k];
      }
    }
  }
  LeaveWhatWouldNotShow(view, memory_.ThinTops(), geometry, seen);
  const Eigen::Vector3d baseline_W = view.X_WC().R.col(0);
  ThinSights thin{Grid<ThinSight>(geometry.rows, geometry.cols),
                  std::atan2(baseline_W.y(), baseline_W.x())};
  // How high a line hangs follows from the way between views, to which the registration of each
  // would add its centimetres: older views stand where navigation says, and so does this one.
  SceneView by_navigation = view;
  by_navigation.registered = {};
  for (const ThinPiece& piece : FindThinStructures(by_navigation, ground, older_)) {
    FlagBelow(piece, geometry, found, thin.cells);
  }
  for (std::size_t cell = 0; cell < seen.cells().size(); ++cell) {
    seen.cells()[cell] |= found.cells()[cell] & kFlagThinStructure;  // the wire may be outside
  }
  older_.Remember(view);
  memory_.Add(seen, found, thin);
  return memory_.Flags();
}

}  // namespace palace
