#include "engine/slad/safe_distance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace palace {
namespace {

/// Squared distance along one column to the nearest hazard, ring included.
void ColumnPass(const Grid<std::uint8_t>& safe, Grid<std::int64_t>& square) {
  std::vector<std::int64_t> gap(static_cast<std::size_t>(safe.cols()), 0);
  const auto step = [&](int r, bool first) {
    for (int c = 0; c < safe.cols(); ++c) {
      auto& g = gap[static_cast<std::size_t>(c)];
      g = safe.at(r, c) == 1 ? g + 1 : 0;
      square.at(r, c) = first ? g * g : std::min(square.at(r, c), g * g);
    }
  };
  for (int r = 0; r < safe.rows(); ++r) {
    step(r, true);
  }
  std::fill(gap.begin(), gap.end(), 0);
  for (int r = safe.rows() - 1; r >= 0; --r) {
    step(r, false);
  }
}

/// Lower envelope of the parabolas (x - i)^2 + f[i], i = 0 .. n-1.
class Envelope {
 public:
  explicit Envelope(int n) : vertex_(Size(n)), border_(Size(n) + 1) {}

  void Transform(const std::vector<std::int64_t>& f, std::vector<std::int64_t>& out) {
    const int n = static_cast<int>(f.size());
    int k = 0;
    vertex_[0] = 0;
    border_[0] = -HUGE_VAL;
    border_[1] = HUGE_VAL;
    for (int q = 1; q < n; ++q) {
      double s = Crossing(f, q, vertex_[Size(k)]);
      while (s <= border_[Size(k)]) {
        --k;
        s = Crossing(f, q, vertex_[Size(k)]);
      }
      ++k;
      vertex_[Size(k)] = q;
      border_[Size(k)] = s;
      border_[Size(k) + 1] = HUGE_VAL;
    }
    k = 0;
    for (int q = 0; q < n; ++q) {
      while (border_[Size(k) + 1] < q) {
        ++k;
      }
      const std::int64_t d = q - vertex_[Size(k)];
      out[Size(q)] = d * d + f[Size(vertex_[Size(k)])];
    }
  }

 private:
  static std::size_t Size(int i) { return static_cast<std::size_t>(i); }
  static double Crossing(const std::vector<std::int64_t>& f, int q, int v) {
    const std::int64_t qq = q, vv = v;
    return static_cast<double>((f[Size(q)] + qq * qq) - (f[Size(v)] + vv * vv)) /
           (2.0 * static_cast<double>(q - v));
  }
  std::vector<int> vertex_;
  std::vector<double> border_;
};

}  // namespace

GridF SafeDistance(const Grid<std::uint8_t>& safe, double cell_m) {
  GridF distance(safe.rows(), safe.cols(), 0.0F);
  if (safe.empty()) {
    return distance;
  }
  Grid<std::int64_t> square(safe.rows(), safe.cols());
  ColumnPass(safe, square);
  // The ring enters each row as a hazard at both ends.
  const int n = safe.cols() + 2;
  std::vector<std::int64_t> f(static_cast<std::size_t>(n), 0), out(f.size(), 0);
  Envelope envelope(n);
  for (int r = 0; r < safe.rows(); ++r) {
    std::copy(square.row(r), square.row(r) + safe.cols(), f.begin() + 1);
    envelope.Transform(f, out);
    for (int c = 0; c < safe.cols(); ++c) {
      distance.at(r, c) = static_cast<float>(
          cell_m * std::sqrt(static_cast<double>(out[static_cast<std::size_t>(c) + 1])));
    }
  }
  return distance;
}

}  // namespace palace
