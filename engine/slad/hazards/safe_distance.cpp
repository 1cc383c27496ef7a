#include "engine/slad/hazards/safe_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/slad/hazards/loops/slad_loops.h"

namespace palace {
namespace {

constexpr int kColumnsTogether = 256;

constexpr float kFar = 1e9F;

/// Cells along the column to the nearest hazard, ring included, for columns first .. end-1. Gaps
/// are whole numbers far below 2^24, which floats hold exactly; they come in as kFar.
void ColumnPass(const Grid<std::uint8_t>& hazard, int first, int end, GridF& gap) {
  const SladLoops& loops = FastestSladLoops();
  const std::vector<float> ring(static_cast<std::size_t>(end - first), 0.0F);
  const auto step = [&](int r, const float* near) {
    loops.column_gaps(hazard.row(r) + first, near, end - first, gap.row(r) + first);
  };
  const int last = hazard.rows() - 1;
  for (int r = 0; r <= last; ++r) {
    step(r, r == 0 ? ring.data() : gap.row(r - 1) + first);
  }
  for (int r = last; r >= 0; --r) {
    step(r, r == last ? ring.data() : gap.row(r + 1) + first);
  }
}

/// Half the width of what a distance runs to, cells.
double Inset(DistanceTo to) { return to == DistanceTo::kSquare ? 0.5 : 0.0; }

double SquaredGap(float gap, double inset) {
  const double along = gap == 0 ? 0.0 : static_cast<double>(gap) - inset;
  return along * along;
}

/// Lower envelope of the parabolas (x - i)^2 + f[i], for one row after another. The ring stands at
/// both ends, with f = 0.
class Envelope {
 public:
  Envelope(int cols, DistanceTo to)
      : cols_(cols),
        inset_(Inset(to)),
        own_(Size(cols + 2)),
        f_(Size(cols + 2)),
        vertex_(Size(cols + 2)),
        border_(Size(cols + 3)),
        reciprocal_(Size(cols + 2)) {
    for (int d = 1; d < cols + 2; ++d) {
      reciprocal_[Size(d)] = 0.5 / d;
    }
  }

  /// Distances of one row, in metres.
  void Transform(const float* gap, double cell_m, float* distance_m) {
    own_[0] = own_[Size(cols_ + 1)] = 0;
    for (int c = 0; c < cols_; ++c) {
      own_[Size(c + 1)] = SquaredGap(gap[c], inset_);
    }
    // Parabolas on the middles, or on the sides, which two cells share: side i is half a cell
    // after middle i.
    const int n = inset_ > 0 ? cols_ + 1 : cols_ + 2;
    for (int i = 0; i < n; ++i) {
      f_[Size(i)] = inset_ > 0 ? std::min(own_[Size(i)], own_[Size(i + 1)]) : own_[Size(i)];
    }
    int k = 0;
    vertex_[0] = 0;
    border_[0] = -HUGE_VAL;
    for (int q = 1; q < n; ++q) {
      double s = Crossing(q, vertex_[Size(k)]);
      while (s <= border_[Size(k)]) {
        s = Crossing(q, vertex_[Size(--k)]);
      }
      vertex_[Size(++k)] = q;
      border_[Size(k)] = s;
    }
    border_[Size(k) + 1] = HUGE_VAL;
    k = 0;
    for (int c = 0; c < cols_; ++c) {
      const double q = c + 1 - inset_;
      while (border_[Size(k) + 1] < q) {
        ++k;
      }
      const double d = q - vertex_[Size(k)];
      const double aside = d * d + f_[Size(vertex_[Size(k)])];
      distance_m[c] = static_cast<float>(cell_m * std::sqrt(std::min(aside, own_[Size(c + 1)])));
    }
  }

 private:
  static std::size_t Size(int i) { return static_cast<std::size_t>(i); }
  /// Where the later parabola comes below the earlier. Numerators are whole quarters, and a
  /// crossing is compared with halves of columns only: the rounded reciprocal cannot change a
  /// distance.
  double Crossing(int q, int v) const {
    const double qq = q, vv = v;
    return ((f_[Size(q)] - f_[Size(v)]) + (qq - vv) * (qq + vv)) * reciprocal_[Size(q - v)];
  }
  int cols_;
  double inset_;
  std::vector<double> own_, f_;
  std::vector<int> vertex_;
  std::vector<double> border_, reciprocal_;
};

/// One row after the column pass. Where a hazard is near every cell of it, looking at all distances
/// that come into question is quicker than the envelope; the results are the same.
class RowPass {
 public:
  RowPass(int cols, double cell_m, DistanceTo to)
      : cols_(cols),
        cell_m_(cell_m),
        inset_(Inset(to)),
        envelope_(cols, to),
        gap_(static_cast<std::size_t>(cols)),
        square_(static_cast<std::size_t>(cols + 2 * kMargin), kFar) {
    square_[kMargin - 1] = square_[static_cast<std::size_t>(cols + kMargin)] = 0;  // the ring
  }

  /// Distances in metres in place of the row's gaps.
  void Run(float* gap_then_distance_m) {
    const float inset = static_cast<float>(inset_);
    float* square = square_.data() + kMargin;
    std::copy_n(gap_then_distance_m, gap_.size(), gap_.data());
    loops_.square_gaps(gap_.data(), inset, cols_, square);
    if (!loops_.nearest_in_row(square, inset, cols_, cell_m_, gap_then_distance_m)) {
      envelope_.Transform(gap_.data(), cell_m_, gap_then_distance_m);
    }
  }

 private:
  static constexpr int kMargin = kNearestReach + kLaneSlack;

  int cols_;
  double cell_m_, inset_;
  Envelope envelope_;
  std::vector<float> gap_, square_;
  const SladLoops& loops_ = FastestSladLoops();
};

}  // namespace

GridF SafeDistance(const Grid<std::uint8_t>& hazard, double cell_m, DistanceTo to) {
  const int rows = hazard.rows(), cols = hazard.cols();
  GridF distance_m(rows, cols, kFar);  // of the gaps first
  if (hazard.empty()) {
    return distance_m;
  }
  const int stripes = (cols + kColumnsTogether - 1) / kColumnsTogether;
  cv::parallel_for_(cv::Range(0, stripes), [&](const cv::Range& range) {
    for (int s = range.start; s < range.end; ++s) {
      ColumnPass(hazard, s * kColumnsTogether, std::min(cols, (s + 1) * kColumnsTogether),
                 distance_m);
    }
  });
  cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
    RowPass pass(cols, cell_m, to);
    for (int r = range.start; r < range.end; ++r) {
      pass.Run(distance_m.row(r));
    }
  });
  return distance_m;
}

}  // namespace palace
