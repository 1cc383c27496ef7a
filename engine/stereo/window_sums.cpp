#include "engine/stereo/window_sums.h"

#include <algorithm>

#include "engine/core/check.h"

namespace palace {
namespace {

/// out[x] = sum of columns[x .. x + 2 half]; `columns` is padded by half on both sides.
void SumAlongRow(const float* columns, int half, int width, float* out) {
  std::copy_n(columns, width, out);
  for (int k = 1; k <= 2 * half; ++k) {
    const float* shifted = columns + k;
    for (int x = 0; x < width; ++x) {
      out[x] += shifted[x];
    }
  }
}

void AddStaticRow(const float* known, const float* left, const float* gradient, float sign,
                  int width, int half, std::vector<float> (&columns)[6]) {
  float* n = columns[0].data() + half;
  float* l = columns[1].data() + half;
  float* g = columns[2].data() + half;
  float* ll = columns[3].data() + half;
  float* lg = columns[4].data() + half;
  float* gg = columns[5].data() + half;
  for (int x = 0; x < width; ++x) {
    n[x] += sign * known[x];
    l[x] += sign * left[x];
    g[x] += sign * gradient[x];
    ll[x] += sign * (left[x] * left[x]);
    lg[x] += sign * (left[x] * gradient[x]);
    gg[x] += sign * (gradient[x] * gradient[x]);
  }
}

}  // namespace

void SumStatic(const ImageF& known, const ImageF& left, const ImageF& gradient, int half, int first,
               int end, StaticSumImages& out) {
  const int width = left.width();
  const int height = left.height();
  std::vector<float> columns[6];
  for (auto& column : columns) {
    column.assign(static_cast<std::size_t>(width + 2 * half), 0.0F);
  }
  const auto add = [&](int row, float sign) {
    if (row >= 0 && row < height) {
      AddStaticRow(known.row(row), left.row(row), gradient.row(row), sign, width, half, columns);
    }
  };
  for (int row = first - half; row < first + half; ++row) {
    add(row, 1.0F);
  }
  for (int y = first; y < end; ++y) {
    add(y + half, 1.0F);
    ImageF* images[6] = {&out.n, &out.l, &out.g, &out.ll, &out.lg, &out.gg};
    for (int k = 0; k < 6; ++k) {
      SumAlongRow(columns[k].data(), half, width, images[k]->row(y));
    }
    add(y - half, -1.0F);
  }
}

WarpedWindow::WarpedWindow(const ImageF& warped, const ImageF& left, const ImageF& gradient,
                           int half, int first)
    : warped_(warped), left_(left), gradient_(gradient), half_(half), next_row_(first) {
  for (int k = 0; k < 4; ++k) {
    columns_[k].assign(static_cast<std::size_t>(warped.width() + 2 * half), 0.0F);
    sums_[k].assign(static_cast<std::size_t>(warped.width()), 0.0F);
  }
  for (int row = first - half; row < first + half; ++row) {
    Accumulate(row, 1.0F);
  }
}

void WarpedWindow::Accumulate(int y, float sign) {
  if (y < 0 || y >= warped_.height()) {
    return;
  }
  const float* right = warped_.row(y);
  const float* left = left_.row(y);
  const float* gradient = gradient_.row(y);
  float* r = columns_[0].data() + half_;
  float* rr = columns_[1].data() + half_;
  float* lr = columns_[2].data() + half_;
  float* rg = columns_[3].data() + half_;
  const int width = warped_.width();
  for (int x = 0; x < width; ++x) {
    r[x] += sign * right[x];
    rr[x] += sign * (right[x] * right[x]);
    lr[x] += sign * (left[x] * right[x]);
    rg[x] += sign * (right[x] * gradient[x]);
  }
}

WarpSums WarpedWindow::Row(int y) {
  PALACE_CHECK(y == next_row_, y, next_row_);
  ++next_row_;
  Accumulate(y + half_, 1.0F);
  for (int k = 0; k < 4; ++k) {
    SumAlongRow(columns_[k].data(), half_, warped_.width(), sums_[k].data());
  }
  Accumulate(y - half_, -1.0F);
  return {sums_[0].data(), sums_[1].data(), sums_[2].data(), sums_[3].data()};
}

}  // namespace palace
