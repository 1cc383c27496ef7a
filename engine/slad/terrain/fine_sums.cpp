#include "engine/slad/terrain/fine_sums.h"

#include <algorithm>
#include <cmath>

#include "engine/slad/side_by_side.h"

namespace palace {
namespace {

constexpr float kMostNet = 1e4F;  // 1/m^2: to a centimetre, as ground of that size is rough

}  // namespace

FineSum& FineSum::operator+=(const FineSum& other) {
  for (std::size_t k = 0; k < of.size(); ++k) {
    of[k] += other.of[k];
  }
  return *this;
}

FineSum operator-(FineSum a, const FineSum& b) {
  for (std::size_t k = 0; k < a.of.size(); ++k) {
    a.of[k] -= b.of[k];
  }
  return a;
}

double FinePlane::Aside(double at_x, double at_y) const {
  const double dx = at_x - x, dy = at_y - y;
  return (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / (xx * yy - xy * xy);
}

FinePlane PlaneThrough(const FineSum& sum) {
  FinePlane plane;
  if (!sum.known()) {
    return plane;
  }
  using S = FineSum;
  const double a = sum.of[S::kA];
  plane.x = sum.x();
  plane.y = sum.y();
  plane.height_m = sum.height_m();
  plane.variance_m2 = sum.variance_m2();
  plane.xx = sum.of[S::kAxx] / a - plane.x * plane.x;
  plane.yy = sum.of[S::kAyy] / a - plane.y * plane.y;
  plane.xy = sum.of[S::kAxy] / a - plane.x * plane.y;
  const double xh = sum.of[S::kJx] / a - plane.x * plane.height_m,
               yh = sum.of[S::kJy] / a - plane.y * plane.height_m;
  const double determinant = plane.xx * plane.yy - plane.xy * plane.xy;
  plane.told = plane.xx > 0 && determinant > 1;  // neither places of a line nor noise alone
  if (plane.told) {
    plane.per_x_m = (plane.yy * xh - plane.xy * yh) / determinant;
    plane.per_y_m = (plane.xx * yh - plane.xy * xh) / determinant;
  }
  return plane;
}

FineSums::FineSums(const Grid<FineKnown>& known, const GridGeometry& places, double reference_m)
    : places_(places), reference_m_(reference_m), corners_(places.rows + 1, places.cols + 1) {
  // Along rows, then down columns: both are shared among threads.
  ForEach(places.rows, [&](int r) {
    FineSum row;
    for (int c = 0; c < places.cols; ++c) {
      const FineKnown& place = known.at(r, c);
      const double part = place.net > kMostNet ? static_cast<double>(kMostNet / place.net) : 1;
      const double a = part * static_cast<double>(place.net),
                   j = part * static_cast<double>(place.height),
                   g = part * static_cast<double>(place.gross),
                   off = part * static_cast<double>(place.off);
      const double x = c - places.cols / 2.0, y = r - places.rows / 2.0;
      row += FineSum{{a, a * x, a * y, a * x * x, a * x * y, a * y * y, j, j * x, j * y, g, off}};
      corners_.at(r + 1, c + 1) = row;
    }
  });
  constexpr int kStrip = 16;  // columns
  ForEach((places.cols + kStrip - 1) / kStrip, [&](int strip) {
    const int end = std::min((strip + 1) * kStrip, places.cols);
    for (int r = 1; r < places.rows; ++r) {
      for (int c = strip * kStrip; c < end; ++c) {
        corners_.at(r + 1, c + 1) += corners_.at(r, c + 1);
      }
    }
  });
}

int FineSums::side() const {
  return std::max(1, static_cast<int>(std::lround(kFineSquare_m / places_.cell_m)));
}

FineSum FineSums::Over(int row, int col, int side, int reach) const {
  const int top = row - side / 2, left = col - side / 2;
  return Within(top - reach, top + side + reach, left - reach, left + side + reach);
}

FineSum FineSums::Within(int row, int row_end, int col, int col_end) const {
  const int r0 = std::clamp(row, 0, places_.rows), r1 = std::clamp(row_end, 0, places_.rows),
            c0 = std::clamp(col, 0, places_.cols), c1 = std::clamp(col_end, 0, places_.cols);
  const auto &a = corners_.at(r1, c1).of, &b = corners_.at(r0, c1).of, &c = corners_.at(r1, c0).of,
             &d = corners_.at(r0, c0).of;
  FineSum sum;
  for (std::size_t k = 0; k < sum.of.size(); ++k) {
    sum.of[k] = (a[k] - b[k]) - (c[k] - d[k]);
  }
  return sum;
}

}  // namespace palace
