#include "engine/slad/safe_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/slad/slad_loops.h"

namespace palace {
namespace {

constexpr int kColumnsTogether = 256;

/// Cells along the column to the nearest hazard, ring included, for columns first .. end-1.
void ColumnPass(const Grid<std::uint8_t>& hazard, int first, int end, Grid<int>& gap) {
  std::vector<int> run(static_cast<std::size_t>(end - first), 0);
  const auto down_or_up = [&](int r, bool down) {
    const std::uint8_t* is_hazard = hazard.row(r) + first;
    int* out = gap.row(r) + first;
    for (int c = 0; c < end - first; ++c) {
      int& steps = run[static_cast<std::size_t>(c)];
      steps = is_hazard[c] == 0 ? steps + 1 : 0;
      out[c] = down ? steps : std::min(out[c], steps);
    }
  };
  for (int r = 0; r < hazard.rows(); ++r) {
    down_or_up(r, true);
  }
  std::fill(run.begin(), run.end(), 0);
  for (int r = hazard.rows() - 1; r >= 0; --r) {
    down_or_up(r, false);
  }
}

/// Half the width of what a distance runs to, cells.
double Inset(DistanceTo to) { return to == DistanceTo::kSquare ? 0.5 : 0.0; }

double SquaredGap(int gap, double inset) {
  const double along = gap == 0 ? 0.0 : gap - inset;
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
  void Transform(const int* gap, double cell_m, float* distance_m) {
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
        square_(static_cast<std::size_t>(cols + 2 * kMargin), kFar) {
    square_[kMargin - 1] = square_[static_cast<std::size_t>(cols + kMargin)] = 0;  // the ring
  }

  void Run(const int* gap, float* distance_m) {
    float* square = square_.data() + kMargin;
    int widest = 0;
    for (int c = 0; c < cols_; ++c) {
      widest = std::max(widest, gap[c]);
      square[c] = static_cast<float>(SquaredGap(gap[c], inset_));
    }
    if (widest <= kNearestReach) {
      loops_.nearest_in_row(square, static_cast<float>(inset_), cols_, cell_m_, distance_m);
    } else {
      envelope_.Transform(gap, cell_m_, distance_m);
    }
  }

 private:
  static constexpr int kMargin = kNearestReach + kLaneSlack;
  static constexpr float kFar = 1e9F;

  int cols_;
  double cell_m_, inset_;
  Envelope envelope_;
  std::vector<float> square_;
  const SladLoops& loops_ = FastestSladLoops();
};

}  // namespace

GridF SafeDistance(const Grid<std::uint8_t>& hazard, double cell_m, DistanceTo to) {
  const int rows = hazard.rows(), cols = hazard.cols();
  GridF distance_m(rows, cols, 0.0F);
  if (hazard.empty()) {
    return distance_m;
  }
  Grid<int> gap(rows, cols);
  const int stripes = (cols + kColumnsTogether - 1) / kColumnsTogether;
  cv::parallel_for_(cv::Range(0, stripes), [&](const cv::Range& range) {
    for (int s = range.start; s < range.end; ++s) {
      ColumnPass(hazard, s * kColumnsTogether, std::min(cols, (s + 1) * kColumnsTogether), gap);
    }
  });
  cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
    RowPass pass(cols, cell_m, to);
    for (int r = range.start; r < range.end; ++r) {
      pass.Run(gap.row(r), distance_m.row(r));
    }
  });
  return distance_m;
}

}  // namespace palace
