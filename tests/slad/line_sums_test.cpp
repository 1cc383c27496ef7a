// The fast sums along lines against the plain recursion, and a drawn line that must be found.
#include "engine/slad/pictures/line_sums.h"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

int MarkAt(const ImageU8& marks, int x, int y) {
  return x >= 0 && x < marks.width() ? marks.at(x, y) : 0;
}

/// The recursion of line_sums.h as it is written there, for one line; sign mirrors it.
int PlainSum(const ImageU8& marks, int first_row, int height, int aside, int x, int sign) {
  if (height == 1) {
    return MarkAt(marks, x, first_row);
  }
  const int half = height / 2;
  return PlainSum(marks, first_row, half, aside / 2, x, sign) +
         PlainSum(marks, first_row + half, half, aside / 2, x + sign * ((aside + 1) / 2), sign);
}

TEST(LineSums, EqualThePlainRecursionEverywhere) {
  constexpr int kWidth = 90, kFirstRow = 5;
  RandomStream random(3, "marks");
  std::printf("seed 3\n");
  ImageU8 marks(kWidth, kStrip_px + kFirstRow + 2);
  for (auto& mark : marks.pixels()) {
    mark = static_cast<std::uint8_t>(random.NextBits() % (kLargestMark + 1));
  }
  LineSums lines;
  lines.Add(marks, kFirstRow);
  for (int x = 0; x < kWidth; ++x) {
    int best = 0;
    for (const int sign : {1, -1}) {
      for (int aside = 0; aside < kStrip_px; ++aside) {
        best = std::max(best, PlainSum(marks, kFirstRow, kStrip_px, aside, x, sign));
      }
    }
    EXPECT_EQ(lines.sum(x), best) << x;
    const int aside = lines.aside_px(x);
    EXPECT_EQ(PlainSum(marks, kFirstRow, kStrip_px, std::abs(aside), x, aside < 0 ? -1 : 1), best)
        << x;
  }
}

TEST(LineSums, ALineOfAnySlopeIsFoundWithinAPixel) {
  for (int aside = -kStrip_px + 1; aside < kStrip_px; ++aside) {
    constexpr int kStart = 60;
    ImageU8 marks(130, kStrip_px, 0);
    for (int y = 0; y < kStrip_px; ++y) {
      const double x = kStart + aside * y / double(kStrip_px - 1);
      marks.at(static_cast<int>(std::lround(x)), y) = kLargestMark;
      marks.at(static_cast<int>(std::lround(x)) + 1, y) = kLargestMark;
    }
    LineSums lines;
    lines.Add(marks, 0);
    int best = 0;
    for (int x = 0; x < marks.width(); ++x) {
      best = lines.sum(x) > lines.sum(best) ? x : best;
    }
    EXPECT_NEAR(best, kStart, 1) << aside;
    EXPECT_NEAR(best + lines.aside_px(best), kStart + aside, 1) << aside;
    EXPECT_GE(lines.sum(best), 200) << aside;
  }
}

}  // namespace
}  // namespace palace
