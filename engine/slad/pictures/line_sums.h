// Sums of marks along all straight lines across a strip of 32 rows (fast discrete Radon transform).
//
// f(0, y, s = 0, x) = mark(x, y);  a line over 2^k rows that ends s pixels aside is two over
// 2^(k-1) rows:  f(k, b, s, x) = f(k-1, 2b, s/2, x) + f(k-1, 2b+1, s/2, x + (s+1)/2).
// All lines of a strip cost five additions a pixel. Source: W. A. Goetz and H. J. Druckmueller,
// "A fast digital Radon transform", 1996; M. Brady, SIAM J. Computing 27, 1998.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/model/image.h"

namespace palace {

inline constexpr int kStrip_px = 32;
inline constexpr int kLargestMark = 7;  ///< 32 of them fit a byte

/// For each place on a strip's first row: the line that starts there with the largest sum, and how
/// far aside it ends on the last row, -31..31 pixels.
class LineSums {
 public:
  /// `marks`: 0..kLargestMark; rows first_row .. first_row + 31 must exist.
  void Add(const ImageU8& marks, int first_row);

  int sum(int x) const { return best_[Index(x)]; }
  int aside_px(int x) const { return aside_[Index(x)]; }

 private:
  static std::size_t Index(int x) { return static_cast<std::size_t>(x + kStrip_px); }
  template <int kSign>
  void Transform(const ImageU8& marks, int first_row);

  int stride_ = 0;  ///< the picture's width and a strip's reach on both sides
  std::array<std::vector<std::uint8_t>, 2> levels_;
  std::vector<std::uint8_t> best_;
  std::vector<std::int8_t> aside_;
};

}  // namespace palace
