#include "engine/stereo/subpixel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/core/check.h"

namespace palace {
namespace {

// Inside this file unknown is a far-away number: unlike NaN it keeps comparisons branch-free, and
// |unknown - known| <= 1 is false as it must be.
constexpr float kFar = -1e6F;
// Neighbours that differ by more do not smooth each other. The start is off by half a pixel, so the
// first step needs a wide limit; the last must keep a 6-inch step apart, 0.36 px at 50 ft and 45
// deg.
constexpr float kFirstSmoothLimit_px = 1.0F;
constexpr float kLastSmoothLimit_px = 0.3F;
// Camera noise adds to the gradient's energy. The five-point derivative passes 0.90 of a pixel's
// noise variance, and half of the residual's variance comes from the left picture.
constexpr float kGradientNoiseShare = 0.45F;
constexpr float kLeastResidualVariance = 0.2F;  // of rounding to whole grey levels, both pictures
// Below it noise outweighs the texture. Chosen on rendered asphalt with noise of 2 to 6 grey levels
// and on Aloe (a higher value loses half of the ground at 4 levels and no wrong pixels).
constexpr float kLeastCorrelation = 0.4F;
constexpr float kLeastKnownShare = 0.4F;  // of a window
constexpr float kLeastSigma_px = 0.018F;  // interpolation and texture beyond the noise
constexpr int kRowsPerStripe = 48;        // fixed: results do not depend on the threads

/// Calls work(first_row, end_row) for fixed stripes of rows, on OpenCV's threads.
template <typename Work>
void ForStripes(int rows, const Work& work) {
  const int stripes = (rows + kRowsPerStripe - 1) / kRowsPerStripe;
  cv::parallel_for_(cv::Range(0, stripes), [&](const cv::Range& range) {
    for (int stripe = range.start; stripe < range.end; ++stripe) {
      work(stripe * kRowsPerStripe, std::min(rows, (stripe + 1) * kRowsPerStripe));
    }
  });
}

float MeanGrey(const ImageU8& image) {
  std::int64_t sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* row = image.row(y);
    int of_row = 0;
    for (int x = 0; x < image.width(); ++x) {
      of_row += row[x];
    }
    sum += of_row;
  }
  return static_cast<float>(static_cast<double>(sum) / static_cast<double>(image.pixels().size()));
}

using Row = std::vector<float>;

Row RowOf(int width, float value = 0) { return Row(static_cast<std::size_t>(width), value); }

struct Fields {
  int width = 0;
  int height = 0;
  ImageF left;      // grey minus the picture's mean; 0 where unknown
  ImageF gradient;  // five-point horizontal derivative of left; 0 where unknown
  ImageF known;     // 1 where the coarse disparity is known and safely inside the right picture
  ImageF right;     // spline coefficients of grey minus the picture's mean, row by row
  ImageF start;     // coarse disparity, kFar where unknown
};

/// `padded` has room for the row and kSplineReach_px on both sides, where the row is mirrored.
void FindSpline(const std::uint8_t* grey, float mean, int width, const StereoLoops& loops,
                Row& padded, float* coefficients) {
  float* row = padded.data() + kSplineReach_px;
  for (int x = 0; x < width; ++x) {
    row[x] = static_cast<float>(grey[x]) - mean;
  }
  for (int k = 1; k <= kSplineReach_px; ++k) {
    row[-k] = row[k];
    row[width - 1 + k] = row[width - 1 - k];
  }
  loops.spline(row, width, coefficients);
}

void PrepareRow(const ImageU8& left, const ImageF& coarse, float left_mean, float max_shift, int y,
                Fields& f) {
  const std::uint8_t* grey = left.row(y);
  const float* d = coarse.row(y);
  float* start = f.start.row(y);
  float* known = f.known.row(y);
  float* level = f.left.row(y);
  float* gradient = f.gradient.row(y);
  const float least = 2.0F + max_shift;
  const float most = static_cast<float>(f.width - 4) - max_shift;
  for (int x = 2; x < f.width - 2; ++x) {
    const float match = static_cast<float>(x) - d[x];
    if (match >= least && match <= most) {  // false for NaN
      start[x] = d[x];
      known[x] = 1.0F;
      level[x] = static_cast<float>(grey[x]) - left_mean;
      gradient[x] =
          static_cast<float>(grey[x - 2] - grey[x + 2] + 8 * (grey[x + 1] - grey[x - 1])) *
          (1.0F / 12.0F);
    }
  }
}

Fields Prepare(const ImageU8& left, const ImageU8& right, const ImageF& coarse, float max_shift,
               const StereoLoops& loops) {
  Fields f;
  f.width = left.width();
  f.height = left.height();
  for (ImageF* image : {&f.left, &f.gradient, &f.known, &f.right}) {
    *image = ImageF(f.width, f.height);
  }
  f.start = ImageF(f.width, f.height, kFar);
  const float left_mean = MeanGrey(left);
  const float right_mean = MeanGrey(right);
  ForStripes(f.height, [&](int first, int end) {
    Row padded = RowOf(f.width + 2 * kSplineReach_px);
    for (int y = first; y < end; ++y) {
      FindSpline(right.row(y), right_mean, f.width, loops, padded, f.right.row(y));
      PrepareRow(left, coarse, left_mean, max_shift, y, f);
    }
  });
  return f;
}

/// Window sums of products of two fields, row after row: running sums down the columns, then along
/// the row. Outside the picture counts as 0.
class ProductWindow {
 public:
  ProductWindow(const ImageF& a, const ImageF& b, int half, int first_row, const StereoLoops& loops)
      : a_(a),
        b_(b),
        half_(half),
        loops_(loops),
        zeros_(RowOf(a.width())),
        columns_(RowOf(a.width() + 2 * half)),
        next_row_(first_row) {
    for (int y = first_row - half; y < first_row + half; ++y) {
      Slide(y, kNoRow);
    }
    leaving_ = kNoRow;
  }

  /// Sums of the next row.
  void Next(float* out) {
    Slide(next_row_ + half_, leaving_);
    leaving_ = next_row_ - half_;
    ++next_row_;
    loops_.sum_along(columns_.data(), half_, a_.width(), out);
  }

 private:
  static constexpr int kNoRow = -1000;

  const float* RowOrZeros(const ImageF& image, int y) const {
    return y >= 0 && y < image.height() ? image.row(y) : zeros_.data();
  }
  void Slide(int enter, int leave) {
    loops_.slide(RowOrZeros(a_, enter), RowOrZeros(b_, enter), RowOrZeros(a_, leave),
                 RowOrZeros(b_, leave), a_.width(), columns_.data() + half_);
  }

  const ImageF& a_;
  const ImageF& b_;
  const int half_;
  const StereoLoops& loops_;
  Row zeros_;
  Row columns_;  // padded by half_ zeros on both sides
  int next_row_;
  int leaving_;
};

/// Window sums that do not change between steps.
struct StaticSums {
  ImageF n, l, g, ll, lg, gg;
};

StaticSums SumStatic(const Fields& f, int half, const StereoLoops& loops) {
  StaticSums sums;
  ImageF* const out[] = {&sums.n, &sums.l, &sums.g, &sums.ll, &sums.lg, &sums.gg};
  for (ImageF* image : out) {
    *image = ImageF(f.width, f.height);
  }
  const ImageF* const a[] = {&f.known, &f.left, &f.gradient, &f.left, &f.left, &f.gradient};
  const ImageF* const b[] = {&f.known, &f.known, &f.known, &f.left, &f.gradient, &f.gradient};
  ForStripes(f.height, [&](int first, int end) {
    for (int k = 0; k < 6; ++k) {
      ProductWindow window(*a[k], *b[k], half, first, loops);
      for (int y = first; y < end; ++y) {
        window.Next(out[k]->row(y));
      }
    }
  });
  return sums;
}

class Refinement {
 public:
  Refinement(const Fields& fields, const SubpixelOptions& options, const StereoLoops& loops)
      : f_(fields),
        options_(options),
        loops_(loops),
        half_(options.window_px / 2),
        max_shift_(static_cast<float>(options.max_shift_px)),
        limits_{kLeastKnownShare * static_cast<float>(options.window_px * options.window_px),
                kLeastCorrelation, kLeastResidualVariance, kGradientNoiseShare},
        disparity_(fields.start),
        reference_(fields.width, fields.height),
        warped_(fields.width, fields.height),
        sums_(SumStatic(fields, half_, loops)) {}

  void Step() {
    Warp(kFirstSmoothLimit_px);
    ForFits([&](int y, const RowFit& fit) {
      float* disparity = disparity_.row(y);
      const float* reference = reference_.row(y);
      for (int x = 0; x < f_.width; ++x) {
        disparity[x] = reference[x] + fit.step_px[x];
      }
    });
  }

  SubpixelDisparity Finish() {
    Warp(kLastSmoothLimit_px);
    SubpixelDisparity out{ImageF(f_.width, f_.height), ImageF(f_.width, f_.height)};
    ForFits([&](int y, const RowFit& fit) {
      loops_.finish(fit, f_.width,
                    {f_.known.row(y), f_.start.row(y), reference_.row(y), max_shift_,
                     static_cast<float>(options_.max_sigma_px), kLeastSigma_px,
                     out.disparity_px.row(y), out.sigma_px.row(y)});
    });
    return out;
  }

 private:
  /// The reference: the disparity smoothed along rows, then down columns. And the right picture
  /// warped by it.
  void Warp(float smooth_limit_px) {
    ForStripes(f_.height, [&](int first, int end) {
      const int from = std::max(0, first - half_);
      const int to = std::min(f_.height, end + half_);
      std::vector<Row> along(static_cast<std::size_t>(to - from), RowOf(f_.width));
      Row padded = RowOf(f_.width + 2 * half_, kFar);
      for (int y = from; y < to; ++y) {
        std::copy_n(disparity_.row(y), f_.width, padded.begin() + half_);
        loops_.smooth_along(padded.data() + half_, half_, f_.width, smooth_limit_px,
                            along[static_cast<std::size_t>(y - from)].data());
      }
      const Row outside = RowOf(f_.width, 2 * kFar);  // near to nothing
      std::vector<const float*> rows(static_cast<std::size_t>(2 * half_ + 1));
      for (int y = first; y < end; ++y) {
        for (int k = 0; k <= 2 * half_; ++k) {
          const int row = y - half_ + k;
          rows[static_cast<std::size_t>(k)] =
              row >= from && row < to ? along[static_cast<std::size_t>(row - from)].data()
                                      : outside.data();
        }
        loops_.smooth_down(rows.data(), half_, f_.width, smooth_limit_px, f_.start.row(y),
                           max_shift_, reference_.row(y));
        loops_.warp(f_.right.row(y), reference_.row(y), f_.known.row(y), f_.width, warped_.row(y));
      }
    });
  }

  /// Calls work(y, fit) for every row.
  template <typename Work>
  void ForFits(const Work& work) const {
    ForStripes(f_.height, [&](int first, int end) {
      ProductWindow r(warped_, f_.known, half_, first, loops_);
      ProductWindow rr(warped_, warped_, half_, first, loops_);
      ProductWindow lr(f_.left, warped_, half_, first, loops_);
      ProductWindow rg(warped_, f_.gradient, half_, first, loops_);
      Row sums[4] = {RowOf(f_.width), RowOf(f_.width), RowOf(f_.width), RowOf(f_.width)};
      Row step = RowOf(f_.width), noise = RowOf(f_.width), gradient = RowOf(f_.width);
      const RowFit fit{step.data(), noise.data(), gradient.data()};
      for (int y = first; y < end; ++y) {
        r.Next(sums[0].data());
        rr.Next(sums[1].data());
        lr.Next(sums[2].data());
        rg.Next(sums[3].data());
        loops_.fit(
            {sums_.n.row(y), sums_.l.row(y), sums_.g.row(y), sums_.ll.row(y), sums_.lg.row(y),
             sums_.gg.row(y), sums[0].data(), sums[1].data(), sums[2].data(), sums[3].data()},
            limits_, f_.width, fit);
        work(y, fit);
      }
    });
  }

  const Fields& f_;
  const SubpixelOptions options_;
  const StereoLoops& loops_;
  const int half_;
  const float max_shift_;
  const FitLimits limits_;
  ImageF disparity_;
  ImageF reference_;
  ImageF warped_;
  const StaticSums sums_;
};

}  // namespace

SubpixelDisparity RefineDisparity(const ImageU8& left, const ImageU8& right, const ImageF& coarse,
                                  const SubpixelOptions& options, const StereoLoops& loops) {
  PALACE_CHECK(left.width() == right.width() && left.height() == right.height(), left.width(),
               right.width(), left.height(), right.height());
  PALACE_CHECK(left.width() == coarse.width() && left.height() == coarse.height());
  PALACE_CHECK(options.window_px >= 3 && options.window_px <= 2 * kLargestHalf_px + 1 &&
                   options.window_px % 2 == 1,
               options.window_px);
  PALACE_CHECK(options.iterations >= 1 && left.width() >= 16, options.iterations, left.width());
  const Fields fields =
      Prepare(left, right, coarse, static_cast<float>(options.max_shift_px), loops);
  Refinement refinement(fields, options, loops);
  for (int i = 1; i < options.iterations; ++i) {
    refinement.Step();
  }
  return refinement.Finish();
}

}  // namespace palace
