// Correlations of shifted maps against the plain sums.
#include "engine/slad/terrain/shift_correlations.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

/// Noise with a part of it unknown.
GreyDetail DrawDetail(int rows, int cols, double known_share, RandomStream& random) {
  GreyDetail detail{GridF(rows, cols, 0.0F), GridF(rows, cols, 0.0F)};
  for (std::size_t i = 0; i < detail.off.cells().size(); ++i) {
    const bool known = random.Uniform(0, 1) < known_share;
    detail.known.cells()[i] = known ? 1.0F : 0.0F;
    detail.off.cells()[i] = known ? static_cast<float>(20 * random.Normal()) : 0.0F;
  }
  return detail;
}

/// What `of` shows at (r, c) lies at (r + shift.rows, c + shift.cols).
GreyDetail Moved(const GreyDetail& of, const CellShift& shift) {
  GreyDetail moved{GridF(of.off.rows(), of.off.cols(), 0.0F), of.known};
  moved.known = moved.off;
  for (int r = 0; r < of.off.rows(); ++r) {
    for (int c = 0; c < of.off.cols(); ++c) {
      const Cell to{r + shift.rows, c + shift.cols};
      if (to.row >= 0 && to.col >= 0 && to.row < of.off.rows() && to.col < of.off.cols()) {
        moved.off.at(to) = of.off.at(r, c);
        moved.known.at(to) = of.known.at(r, c);
      }
    }
  }
  return moved;
}

double PlainCorrelation(const GreyDetail& frame, const GreyDetail& mosaic, const CellShift& shift,
                        int least_common) {
  double fm = 0, ff = 0, mm = 0;
  int common = 0;
  for (int r = 0; r < frame.off.rows(); ++r) {
    for (int c = 0; c < frame.off.cols(); ++c) {
      const int mr = r + shift.rows, mc = c + shift.cols;
      if (mr < 0 || mc < 0 || mr >= mosaic.off.rows() || mc >= mosaic.off.cols() ||
          frame.known.at(r, c) == 0 || mosaic.known.at(mr, mc) == 0) {
        continue;
      }
      const auto f = static_cast<double>(frame.off.at(r, c)),
                 m = static_cast<double>(mosaic.off.at(mr, mc));
      fm += f * m;
      ff += f * f;
      mm += m * m;
      ++common;
    }
  }
  return common >= least_common && ff > 0 && mm > 0 ? fm / std::sqrt(ff * mm) : -1;
}

TEST(ShiftCorrelations, AreThoseOfThePlainSums) {
  constexpr std::uint64_t kSeed = 20261129;
  RandomStream random(kSeed, "shift correlations");
  int unknown = 0;
  for (int trial = 0; trial < 12; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const int rows = 20 + random.Index(30), cols = 20 + random.Index(30);
    const GreyDetail frame = DrawDetail(rows, cols, 0.7, random);
    const CellShift true_shift{random.Index(9) - 4, random.Index(9) - 4};
    const GreyDetail mosaic = Moved(frame, true_shift);
    const CellShift middle{random.Index(5) - 2, random.Index(5) - 2};
    const int reach = 6 + random.Index(4), least_common = rows * cols / 4;
    const ShiftCorrelations fast(frame, mosaic, middle, reach, least_common);
    for (int dr = -reach; dr <= reach; ++dr) {
      for (int dc = -reach; dc <= reach; ++dc) {
        const CellShift shift{middle.rows + dr, middle.cols + dc};
        const double plain = PlainCorrelation(frame, mosaic, shift, least_common);
        EXPECT_NEAR(fast.At(shift), plain, 1e-5) << shift.rows << ' ' << shift.cols;
        unknown += plain == -1 ? 1 : 0;
      }
    }
    const auto best = fast.Best(reach);
    ASSERT_TRUE(best.has_value());
    EXPECT_EQ(best->rows, true_shift.rows);
    EXPECT_EQ(best->cols, true_shift.cols);
    EXPECT_NEAR(fast.At(*best), 1, 1e-6);
  }
  EXPECT_GT(unknown, 0) << "some far shifts leave too little in common";
}

TEST(ShiftCorrelations, WithNothingInCommonHaveNoBest) {
  RandomStream random(1, "nothing");
  const GreyDetail frame = DrawDetail(20, 20, 1, random), none = DrawDetail(20, 20, 0, random);
  EXPECT_FALSE(ShiftCorrelations(frame, none, {}, 3, 1).Best(3).has_value());
}

}  // namespace
}  // namespace palace
