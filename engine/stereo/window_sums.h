// Sums over square windows, for the correlation refinement: columns by running sums, rows directly.
#pragma once

#include <vector>

#include "engine/model/image.h"

namespace palace {

/// One row of sums that do not change between steps; arrays of the picture's width.
/// n: known pixels, l: left grey, g: gradient, and their products.
struct StaticSums {
  const float* n = nullptr;
  const float* l = nullptr;
  const float* g = nullptr;
  const float* ll = nullptr;
  const float* lg = nullptr;
  const float* gg = nullptr;
};

struct StaticSumImages {
  StaticSumImages(int width, int height)
      : n(width, height),
        l(width, height),
        g(width, height),
        ll(width, height),
        lg(width, height),
        gg(width, height) {}
  StaticSums Row(int y) const {
    return {n.row(y), l.row(y), g.row(y), ll.row(y), lg.row(y), gg.row(y)};
  }
  ImageF n, l, g, ll, lg, gg;
};

/// One row of sums with the warped right picture r.
struct WarpSums {
  const float* r = nullptr;
  const float* rr = nullptr;
  const float* lr = nullptr;
  const float* rg = nullptr;
};

/// Fills rows first .. end-1. Inputs are 0 where unknown; outside the picture counts as unknown.
void SumStatic(const ImageF& known, const ImageF& left, const ImageF& gradient, int half, int first,
               int end, StaticSumImages& out);

/// Window sums of the warped picture, row after row from `first` on.
class WarpedWindow {
 public:
  WarpedWindow(const ImageF& warped, const ImageF& left, const ImageF& gradient, int half,
               int first);
  /// Sums of row y; rows must be asked for in order, starting with `first`.
  WarpSums Row(int y);

 private:
  void Accumulate(int y, float sign);

  const ImageF& warped_;
  const ImageF& left_;
  const ImageF& gradient_;
  const int half_;
  int next_row_;
  std::vector<float> columns_[4];  // padded by half_ zeros on both sides
  std::vector<float> sums_[4];
};

}  // namespace palace
