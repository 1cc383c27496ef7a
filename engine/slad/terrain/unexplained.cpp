#include "engine/slad/terrain/unexplained.h"

#include <cmath>
#include <cstddef>

#include "engine/core/check.h"
#include "engine/core/frames.h"

namespace palace {
namespace {

constexpr float kLeastPixels = 8;
constexpr float kRepeated2 = 0.01F;         // of U, squared: what frames repeat of it
constexpr double kMark = 12;                // v0
constexpr double kSurelyNone = kMark - 10;  // from there down a chance of one in twenty thousand
constexpr double kMoved_px = 2;

}  // namespace

GridF Unexplained(const Grid<FinePlace>& places) {
  using P = FinePlace;
  GridF unexplained(places.rows(), places.cols(), kUnknownValue);
  for (std::size_t i = 0; i < unexplained.cells().size(); ++i) {
    const auto& of = places.cells()[i].of;
    if (of[P::kPixels] >= kLeastPixels) {
      const float gross = of[P::kGross], off = of[P::kOff], pixels = of[P::kPixels];
      const float by_height = gross > 0 ? off * off / gross : 0.0F;
      const float left_over = (of[P::kEnergy] - by_height) / pixels;  // U
      const float sampled = of[P::kSampled] / pixels;                 // S
      unexplained.cells()[i] =
          (left_over - 1) / std::sqrt(1 / pixels + kRepeated2 + sampled * sampled);
    }
  }
  return unexplained;
}

void TakeMarks(const GridF& unexplained, const Viewpoint& view, double focal_times_baseline,
               ElevationMap& map) {
  constexpr int kPerCell = NarrowFigures::kPerCell;
  const GridGeometry& g = map.geometry;
  PALACE_CHECK(unexplained.rows() == kPerCell * g.rows && unexplained.cols() == kPerCell * g.cols,
               unexplained.rows(), g.rows);
  map.narrow.mark = GridF(unexplained.rows(), unexplained.cols(), 0.0F);
  map.narrow.mark_from_m = map.narrow.mark;
  for (int r = 0; r < unexplained.rows(); ++r) {
    for (int c = 0; c < unexplained.cols(); ++c) {
      const auto v = static_cast<double>(unexplained.at(r, c));
      const Cell cell{r / kPerCell, c / kPerCell};
      if (!(v > kSurelyNone) || map.state.at(cell) != CellState::kMeasured) {
        continue;
      }
      const Eigen::Vector3d p_WQ(g.NorthOfRow(cell.row), g.EastOfCol(cell.col),
                                 -static_cast<double>(map.height_m.at(cell)));
      const Eigen::Vector3d way = p_WQ - view.p_WC;
      const double per_pixel_m = std::abs(way.z()) * way.norm() / focal_times_baseline;  // k
      map.narrow.mark.at(r, c) = static_cast<float>(1 / (1 + std::exp(kMark - v)));
      map.narrow.mark_from_m.at(r, c) = static_cast<float>(kMoved_px * per_pixel_m);
    }
  }
}

}  // namespace palace
