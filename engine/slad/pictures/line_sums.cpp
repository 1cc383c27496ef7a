#include "engine/slad/pictures/line_sums.h"

#include <algorithm>
#include <utility>

#include "engine/core/check.h"

namespace palace {
namespace {

void AddRows(const std::uint8_t* a, const std::uint8_t* b, int count, std::uint8_t* out) {
  for (int i = 0; i < count; ++i) {
    out[i] = static_cast<std::uint8_t>(a[i] + b[i]);
  }
}

void KeepBetter(const std::uint8_t* sums, std::int8_t aside, int count, std::uint8_t* best,
                std::int8_t* best_aside) {
  for (int i = 0; i < count; ++i) {
    best_aside[i] = sums[i] > best[i] ? aside : best_aside[i];
    best[i] = sums[i] > best[i] ? sums[i] : best[i];
  }
}

}  // namespace

template <int kSign>
void LineSums::Transform(const ImageU8& marks, int first_row) {
  const auto stride = static_cast<std::size_t>(stride_);
  std::uint8_t* from = levels_[0].data();
  std::uint8_t* to = levels_[1].data();
  for (int y = 0; y < kStrip_px; ++y) {
    std::uint8_t* row = from + static_cast<std::size_t>(y) * stride;
    std::fill_n(row, kStrip_px, std::uint8_t{0});
    std::copy_n(marks.row(first_row + y), marks.width(), row + kStrip_px);
    std::fill_n(row + kStrip_px + marks.width(), kStrip_px, std::uint8_t{0});
  }
  // Level by level: line s of a group of `height` rows is stored at row group * height + s.
  for (int height = 2; height <= kStrip_px; height *= 2) {
    for (int group = 0; group < kStrip_px / height; ++group) {
      for (int s = 0; s < height; ++s) {
        const int upper = group * height + s / 2;
        const int lower = upper + height / 2;
        const int shift = (s + 1) / 2;
        const std::uint8_t* a = from + static_cast<std::size_t>(upper) * stride;
        const std::uint8_t* b = from + static_cast<std::size_t>(lower) * stride;
        std::uint8_t* out = to + static_cast<std::size_t>(group * height + s) * stride;
        if (kSign > 0) {
          AddRows(a, b + shift, stride_ - shift, out);
          std::copy_n(a + stride_ - shift, shift, out + stride_ - shift);
        } else {
          AddRows(a + shift, b, stride_ - shift, out + shift);
          std::copy_n(a, shift, out);
        }
      }
    }
    std::swap(from, to);
  }
  for (int s = kSign > 0 ? 0 : 1; s < kStrip_px; ++s) {
    KeepBetter(from + static_cast<std::size_t>(s) * stride, static_cast<std::int8_t>(kSign * s),
               stride_, best_.data(), aside_.data());
  }
}

void LineSums::Add(const ImageU8& marks, int first_row) {
  PALACE_CHECK(first_row >= 0 && first_row + kStrip_px <= marks.height(), first_row,
               marks.height());
  stride_ = marks.width() + 2 * kStrip_px;
  const auto stride = static_cast<std::size_t>(stride_);
  for (auto& level : levels_) {
    level.resize(stride * kStrip_px);
  }
  best_.assign(stride, 0);
  aside_.assign(stride, 0);
  Transform<1>(marks, first_row);
  Transform<-1>(marks, first_row);
}

}  // namespace palace
