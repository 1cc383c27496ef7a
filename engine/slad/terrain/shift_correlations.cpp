#include "engine/slad/terrain/shift_correlations.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <Eigen/Dense>

#include "engine/core/check.h"
#include "engine/slad/side_by_side.h"

namespace palace {
namespace {

/// Shifts beside each other are summed together: one after the other each sum would wait for
/// itself.
constexpr int kLanes = 8;
using Lanes = Eigen::Array<float, kLanes, 1>;
using Sum = Eigen::Array<double, kLanes, 1>;

struct Sums {
  Sum fm = Sum::Zero(), ff = Sum::Zero(), mm = Sum::Zero(), common = Sum::Zero();
};

GridF Padded(const GridF& layer, int pad) {
  GridF padded(layer.rows(), layer.cols() + 2 * pad, 0.0F);
  for (int r = 0; r < layer.rows(); ++r) {
    std::copy_n(layer.row(r), layer.cols(), padded.row(r) + pad);
  }
  return padded;
}

/// `first_col`: of the padded mosaic, under the frame's first in the first lane.
Sums SumUp(const GreyDetail& frame, const GreyDetail& mosaic, int down, int first_col) {
  const int rows = frame.off.rows(), cols = frame.off.cols();
  Sums sums;
  for (int r = std::max(0, -down); r < std::min(rows, rows - down); ++r) {
    const float *f = frame.off.row(r), *fk = frame.known.row(r);
    const float *m = mosaic.off.row(r + down) + first_col,
                *mk = mosaic.known.row(r + down) + first_col;
    Lanes fm = Lanes::Zero(), ff = fm, mm = fm, common = fm;
    for (int c = 0; c < cols; ++c) {
      if (fk[c] == 0) {
        continue;  // 0 in all
      }
      const Lanes grey = Eigen::Map<const Lanes>(m + c), known = Eigen::Map<const Lanes>(mk + c);
      fm += f[c] * grey;
      ff += f[c] * f[c] * known;
      mm += grey * grey;
      common += known;
    }
    sums.fm += fm.cast<double>();
    sums.ff += ff.cast<double>();
    sums.mm += mm.cast<double>();
    sums.common += common.cast<double>();
  }
  return sums;
}

}  // namespace

ShiftCorrelations::ShiftCorrelations(const GreyDetail& frame, const GreyDetail& mosaic,
                                     const CellShift& middle, int reach, int least_common)
    : middle_(middle), reach_(reach), of_(2 * reach + 1, 2 * reach + 1, -1) {
  PALACE_CHECK(frame.off.rows() == mosaic.off.rows() && frame.off.cols() == mosaic.off.cols(),
               frame.off.rows(), mosaic.off.rows());
  const int blocks = (of_.cols() + kLanes - 1) / kLanes;
  const int pad = std::abs(middle.cols) + reach + kLanes;
  const GreyDetail padded{Padded(mosaic.off, pad), Padded(mosaic.known, pad)};
  ForEach(of_.rows() * blocks, [&](int i) {
    const int row = i / blocks, col = i % blocks * kLanes;
    const Sums sums =
        SumUp(frame, padded, middle.rows + row - reach, pad + middle.cols + col - reach);
    for (int lane = 0; lane < std::min(kLanes, of_.cols() - col); ++lane) {
      if (sums.common[lane] >= least_common && sums.ff[lane] > 0 && sums.mm[lane] > 0) {
        of_.at(row, col + lane) = sums.fm[lane] / std::sqrt(sums.ff[lane] * sums.mm[lane]);
      }
    }
  });
}

std::optional<CellShift> ShiftCorrelations::Best(int reach) const {
  std::optional<CellShift> best;
  for (int rows = middle_.rows - reach; rows <= middle_.rows + reach; ++rows) {
    for (int cols = middle_.cols - reach; cols <= middle_.cols + reach; ++cols) {
      const CellShift shift{rows, cols};
      if (At(shift) > (best ? At(*best) : -1.0)) {
        best = shift;
      }
    }
  }
  return best;
}

}  // namespace palace
