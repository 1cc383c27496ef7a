#include "engine/slad/pictures/thin_piece.h"

#include <algorithm>

namespace palace {

void AddPieces(const SceneView& view, const SceneGround& ground, const MarkStrips& strips,
               const std::vector<LinePiece>& pieces, ThinHeight height,
               std::vector<ThinPiece>& found) {
  for (const LinePiece& piece : pieces) {
    const auto end = [&](double share) {
      const Eigen::Vector2d p = strips.Pixel(piece, share);
      const int i = std::clamp(static_cast<int>(p.x()) / kBlock_px, 0, ground.cols() - 1);
      const int j = std::clamp(static_cast<int>(p.y()) / kBlock_px, 0, ground.rows() - 1);
      return PointAt(view, p.x(), p.y(),
                     static_cast<double>(ground.disparity_px.at(i, j)) + piece.above_px);
    };
    found.push_back({end(0), end(1), height});
  }
}

}  // namespace palace
