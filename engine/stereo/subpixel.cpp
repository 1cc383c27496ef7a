#include "engine/stereo/subpixel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/core/check.h"
#include "engine/stereo/window_sums.h"

namespace palace {
namespace {

// Inside this file unknown is a far-away number: unlike NaN it keeps comparisons branch-free, and
// |unknown - known| <= 1 is false as it must be.
constexpr float kFar = -1e6F;
constexpr float kSmoothLimit_px = 1.0F;
// Camera noise adds to the gradient's energy. The five-point derivative passes 0.90 of a pixel's
// noise variance, and half of the residual's variance comes from the left picture.
constexpr float kGradientNoiseShare = 0.45F;
constexpr float kLeastResidualVariance = 0.2F;  // of rounding to whole grey levels, both pictures
constexpr float kLeastCorrelation = 0.5F;       // below it noise outweighs the texture
constexpr int kRowsPerStripe = 48;              // fixed: results do not depend on the threads

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
  double sum = 0;
  for (const std::uint8_t value : image.pixels()) {
    sum += value;
  }
  return static_cast<float>(sum / static_cast<double>(image.pixels().size()));
}

struct Fields {
  int width = 0;
  int height = 0;
  ImageF left;      // grey minus the picture's mean; 0 where unknown
  ImageF gradient;  // five-point horizontal derivative of left; 0 where unknown
  ImageF known;     // 1 where the coarse disparity is known and safely inside the right picture
  ImageF right;     // grey minus the picture's mean
  ImageF start;     // coarse disparity, kFar where unknown
};

void PrepareRow(const ImageU8& left, const ImageU8& right, const ImageF& coarse, float left_mean,
                float right_mean, float max_shift, int y, Fields& f) {
  const std::uint8_t* grey = left.row(y);
  const std::uint8_t* other = right.row(y);
  const float* d = coarse.row(y);
  const int width = f.width;
  for (int x = 0; x < width; ++x) {
    f.right.at(x, y) = static_cast<float>(other[x]) - right_mean;
    const float match = static_cast<float>(x) - d[x];
    const bool known = x >= 2 && x < width - 2 && match >= 2.0F + max_shift &&
                       match <= static_cast<float>(width - 4) - max_shift;
    f.start.at(x, y) = known ? d[x] : kFar;
    f.known.at(x, y) = known ? 1.0F : 0.0F;
    f.left.at(x, y) = known ? static_cast<float>(grey[x]) - left_mean : 0.0F;
    f.gradient.at(x, y) = known ? (static_cast<float>(grey[x - 2] - grey[x + 2]) +
                                   8.0F * static_cast<float>(grey[x + 1] - grey[x - 1])) /
                                      12.0F
                                : 0.0F;
  }
}

Fields Prepare(const ImageU8& left, const ImageU8& right, const ImageF& coarse, float max_shift) {
  Fields f;
  f.width = left.width();
  f.height = left.height();
  for (ImageF* image : {&f.left, &f.gradient, &f.known, &f.right, &f.start}) {
    *image = ImageF(f.width, f.height);
  }
  const float left_mean = MeanGrey(left);
  const float right_mean = MeanGrey(right);
  ForStripes(f.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      PrepareRow(left, right, coarse, left_mean, right_mean, max_shift, y, f);
    }
  });
  return f;
}

/// Adds to (sum, count) what `values` holds within the limit of `centre`, relative to the centre.
void AddNear(const float* values, const float* centre, int count, float* sum, float* near) {
  for (int x = 0; x < count; ++x) {
    const float difference = values[x] - centre[x];
    const float weight = std::abs(difference) <= kSmoothLimit_px ? 1.0F : 0.0F;
    sum[x] += weight * difference;
    near[x] += weight;
  }
}

/// Mean along rows over the window's pixels within 1 px of the centre.
void SmoothAlongRows(const ImageF& in, int half, int first, int end, ImageF& out) {
  const int width = in.width();
  std::vector<float> padded(static_cast<std::size_t>(width + 2 * half), kFar);
  std::vector<float> sum(static_cast<std::size_t>(width));
  std::vector<float> near(static_cast<std::size_t>(width));
  for (int y = first; y < end; ++y) {
    std::copy_n(in.row(y), width, padded.begin() + half);
    std::fill(sum.begin(), sum.end(), 0.0F);
    std::fill(near.begin(), near.end(), 0.0F);
    for (int k = 0; k <= 2 * half; ++k) {
      AddNear(padded.data() + k, in.row(y), width, sum.data(), near.data());
    }
    for (int x = 0; x < width; ++x) {
      out.at(x, y) =
          in.at(x, y) + sum[static_cast<std::size_t>(x)] / near[static_cast<std::size_t>(x)];
    }
  }
}

/// The same along columns; `reference` receives the smoothed field, kept near the start.
void SmoothAlongColumns(const ImageF& in, const Fields& f, int half, float max_shift, int first,
                        int end, ImageF& reference) {
  const auto width = static_cast<std::size_t>(f.width);
  std::vector<float> sum(width);
  std::vector<float> near(width);
  for (int y = first; y < end; ++y) {
    std::fill(sum.begin(), sum.end(), 0.0F);
    std::fill(near.begin(), near.end(), 0.0F);
    for (int row = std::max(0, y - half); row <= std::min(f.height - 1, y + half); ++row) {
      AddNear(in.row(row), in.row(y), f.width, sum.data(), near.data());
    }
    for (std::size_t x = 0; x < width; ++x) {
      const float start = f.start.row(y)[x];
      const float smooth = in.row(y)[x] + sum[x] / near[x];
      reference.row(y)[x] = std::clamp(smooth, start - max_shift, start + max_shift);
    }
  }
}

/// The right picture at x - d(x): Catmull-Rom cubic through four pixels. 0 where unknown.
void WarpRow(const Fields& f, const ImageF& reference, int y, float* warped) {
  const float* right = f.right.row(y);
  const float* d = reference.row(y);
  const float* known = f.known.row(y);
  for (int x = 0; x < f.width; ++x) {
    if (known[x] == 0.0F) {
      warped[x] = 0.0F;
      continue;
    }
    const float place = static_cast<float>(x) - d[x];
    const int whole = static_cast<int>(place);
    const float t = place - static_cast<float>(whole);
    const float* p = right + whole;
    const float even = p[0] + p[0];
    const float slope = p[1] - p[-1];
    const float square = 2.0F * p[-1] - 5.0F * p[0] + 4.0F * p[1] - p[2];
    const float cube = 3.0F * (p[0] - p[1]) + p[2] - p[-1];
    warped[x] = 0.5F * (even + t * (slope + t * (square + t * cube)));
  }
}

/// What the windows of one row say; arrays of the picture's width. Where a window is not good, the
/// step and the energy are 0.
struct RowFits {
  explicit RowFits(int width)
      : step_px(static_cast<std::size_t>(width)),
        noise_energy(static_cast<std::size_t>(width)),
        gradient_energy(static_cast<std::size_t>(width)) {}
  std::vector<float> step_px;
  std::vector<float> noise_energy;     // residual variance times the whole gradient's energy
  std::vector<float> gradient_energy;  // without the share that is camera noise
};

// Written without branches, so that it is vectorised.
void FitRow(const StaticSums& s, const WarpSums& w, float least_known, int width, RowFits& fits) {
  float* step_px = fits.step_px.data();
  float* noise_energy = fits.noise_energy.data();
  float* gradient_energy = fits.gradient_energy.data();
  for (int x = 0; x < width; ++x) {
    const float n = std::max(s.n[x], 4.0F);
    const float scale = 1.0F / n;
    const float gg = s.gg[x] - s.g[x] * s.g[x] * scale;
    const float ll = s.ll[x] - s.l[x] * s.l[x] * scale;
    const float lg = s.lg[x] - s.l[x] * s.g[x] * scale;
    const float rr = w.rr[x] - w.r[x] * w.r[x] * scale;
    const float lr = w.lr[x] - s.l[x] * w.r[x] * scale;
    const float rg = w.rg[x] - w.r[x] * s.g[x] * scale;
    const bool good = (s.n[x] >= least_known) & (gg > n * kLeastResidualVariance) & (rr > 0.0F) &
                      (lr > 0.0F) & (lr * lr > kLeastCorrelation * kLeastCorrelation * ll * rr);
    const float gain = std::min(std::max(lr / rr, 0.5F), 2.0F);
    const float eg = lg - gain * rg;
    const float ee = ll - gain * (2.0F * lr - gain * rr);
    const float step = -eg / gg;
    const float residual_variance = std::max((ee + eg * step) / (n - 3.0F), kLeastResidualVariance);
    step_px[x] = good ? std::min(std::max(step, -1.0F), 1.0F) : 0.0F;
    noise_energy[x] = residual_variance * gg;
    gradient_energy[x] = good ? gg - n * kGradientNoiseShare * residual_variance : 0.0F;
  }
}

class Refinement {
 public:
  Refinement(const Fields& fields, const SubpixelOptions& options)
      : f_(fields),
        half_(options.window_px / 2),
        max_shift_(static_cast<float>(options.max_shift_px)),
        max_sigma_(static_cast<float>(options.max_sigma_px)),
        least_known_(0.4F * static_cast<float>(options.window_px * options.window_px)),
        disparity_(fields.start),
        reference_(fields.width, fields.height),
        warped_(fields.width, fields.height),
        static_sums_(fields.width, fields.height) {
    ForStripes(f_.height, [&](int first, int end) {
      SumStatic(f_.known, f_.left, f_.gradient, half_, first, end, static_sums_);
    });
  }

  void Step() {
    Warp();
    ForStripes(f_.height, [&](int first, int end) {
      WarpedWindow window(warped_, f_.left, f_.gradient, half_, first);
      RowFits fits(f_.width);
      for (int y = first; y < end; ++y) {
        FitRow(static_sums_.Row(y), window.Row(y), least_known_, f_.width, fits);
        float* disparity = disparity_.row(y);
        const float* reference = reference_.row(y);
        for (int x = 0; x < f_.width; ++x) {
          disparity[x] = reference[x] + fits.step_px[static_cast<std::size_t>(x)];
        }
      }
    });
  }

  SubpixelDisparity Finish() {
    Warp();
    SubpixelDisparity out{ImageF(f_.width, f_.height, kUnknown),
                          ImageF(f_.width, f_.height, kUnknown)};
    ForStripes(f_.height, [&](int first, int end) {
      WarpedWindow window(warped_, f_.left, f_.gradient, half_, first);
      RowFits fits(f_.width);
      for (int y = first; y < end; ++y) {
        FitRow(static_sums_.Row(y), window.Row(y), least_known_, f_.width, fits);
        FinishRow(y, fits, out);
      }
    });
    return out;
  }

 private:
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

  void Warp() {
    ImageF& along_rows = warped_;  // free until the warp itself
    ForStripes(f_.height, [&](int first, int end) {
      SmoothAlongRows(disparity_, half_, first, end, along_rows);
    });
    ForStripes(f_.height, [&](int first, int end) {
      SmoothAlongColumns(along_rows, f_, half_, max_shift_, first, end, reference_);
    });
    ForStripes(f_.height, [&](int first, int end) {
      for (int y = first; y < end; ++y) {
        WarpRow(f_, reference_, y, warped_.row(y));
      }
    });
  }

  void FinishRow(int y, const RowFits& fits, SubpixelDisparity& out) {
    for (int x = 0; x < f_.width; ++x) {
      const auto place = static_cast<std::size_t>(x);
      if (f_.known.at(x, y) == 0.0F || !(fits.gradient_energy[place] > 0.0F)) {
        continue;
      }
      const float d = reference_.at(x, y) + fits.step_px[place];
      const float sigma = std::sqrt(fits.noise_energy[place]) / fits.gradient_energy[place];
      if (sigma <= max_sigma_ && std::abs(d - f_.start.at(x, y)) <= max_shift_) {
        out.disparity_px.at(x, y) = d;
        out.sigma_px.at(x, y) = sigma;
      }
    }
  }

  const Fields& f_;
  const int half_;
  const float max_shift_;
  const float max_sigma_;
  const float least_known_;
  ImageF disparity_;
  ImageF reference_;
  ImageF warped_;
  StaticSumImages static_sums_;
};

}  // namespace

SubpixelDisparity RefineDisparity(const ImageU8& left, const ImageU8& right, const ImageF& coarse,
                                  const SubpixelOptions& options) {
  PALACE_CHECK(left.width() == right.width() && left.height() == right.height(), left.width(),
               right.width(), left.height(), right.height());
  PALACE_CHECK(left.width() == coarse.width() && left.height() == coarse.height());
  PALACE_CHECK(options.window_px >= 3 && options.window_px % 2 == 1, options.window_px);
  PALACE_CHECK(options.iterations >= 1 && left.width() >= 16, options.iterations, left.width());
  const Fields fields = Prepare(left, right, coarse, static_cast<float>(options.max_shift_px));
  Refinement refinement(fields, options);
  for (int i = 1; i < options.iterations; ++i) {
    refinement.Step();
  }
  return refinement.Finish();
}

}  // namespace palace
