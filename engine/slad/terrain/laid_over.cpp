#include "engine/slad/terrain/laid_over.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/core/check.h"
#include "engine/model/grid.h"

namespace palace {
namespace {

constexpr int kPatch = LaidOver::kPatch_px;
constexpr int kReach_patches = 3;     // half width of the windows: 28 px
constexpr double kLeastKnown = 0.15;  // of a window's pixels
constexpr float kOffPlane_px = 0.5F;  // what stereo measured counts beyond
constexpr float kEdge_px = 1;         // between patches: a linear step reaches no farther
constexpr double kLeastNoise2 = 0.5;  // grey^2: rounding of both pictures
constexpr double kMostGain = 2;
constexpr double kWindow_px2 =
    (2 * kReach_patches + 1) * (2 * kReach_patches + 1) * kPatch * kPatch;

/// One figure a patch, and its sums over windows.
class Patches {
 public:
  Patches(int cols, int rows)
      : cols_(cols),
        rows_(rows),
        values_(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows)) {}
  double& at(int i, int j) { return values_[Index(i, j)]; }
  double at(int i, int j) const { return values_[Index(i, j)]; }

  /// Over windows, cut at the rim.
  void SumWindows() {
    std::vector<double> line(static_cast<std::size_t>(std::max(cols_, rows_)));
    for (int j = 0; j < rows_; ++j) {
      SumAlong(&values_[Index(0, j)], 1, cols_, line);
    }
    for (int i = 0; i < cols_; ++i) {
      SumAlong(&values_[Index(i, 0)], cols_, rows_, line);
    }
  }

 private:
  std::size_t Index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(cols_) +
           static_cast<std::size_t>(i);
  }
  static void SumAlong(double* values, std::ptrdiff_t stride, int count,
                       std::vector<double>& line) {
    for (int k = 0; k < count; ++k) {
      line[static_cast<std::size_t>(k)] = values[stride * k];
    }
    double sum = 0;
    for (int k = -kReach_patches; k < count; ++k) {
      sum += k + kReach_patches < count ? line[static_cast<std::size_t>(k + kReach_patches)] : 0.0;
      sum -= k > kReach_patches ? line[static_cast<std::size_t>(k - kReach_patches - 1)] : 0.0;
      if (k >= 0) {
        values[stride * k] = sum;
      }
    }
  }

  int cols_, rows_;
  std::vector<double> values_;
};

/// Calls work(i, sum of of_column over the patch's pixels) for the patches of a row, where
/// of_column(x) is the sum of its four pixels.
void SumColumns(const std::vector<float>& of_column, int cols, const auto& work) {
  for (int i = 0; i < cols; ++i) {
    const float* c = of_column.data() + kPatch * i;
    work(i, static_cast<double>(c[0] + c[1] + c[2] + c[3]));
  }
}

/// d0 in the middles of patches, NaN where too little is known.
ImageF GroundDisparity(const ImageF& disparity_px) {
  const int cols = disparity_px.width() / kPatch, rows = disparity_px.height() / kPatch;
  enum Sum { kN, kD, kX, kY, kXX, kXY, kYY, kXD, kYD, kSums };
  std::vector<Patches> sums(kSums, Patches(cols, rows));
  ImageF own(cols, rows, kUnknownValue);
  std::vector<float> count(static_cast<std::size_t>(disparity_px.width())), total(count.size());
  for (int j = 0; j < rows; ++j) {
    std::fill(count.begin(), count.end(), 0.0F);
    std::fill(total.begin(), total.end(), 0.0F);
    for (int y = kPatch * j; y < kPatch * (j + 1); ++y) {
      const float* d = disparity_px.row(y);
      for (std::size_t x = 0; x < count.size(); ++x) {
        const bool known = d[x] > 0;
        count[x] += known ? 1.0F : 0.0F;
        total[x] += known ? d[x] : 0.0F;
      }
    }
    SumColumns(count, cols, [&](int i, double n) { sums[kN].at(i, j) = n; });
    SumColumns(total, cols, [&](int i, double d) {
      const double n = sums[kN].at(i, j);
      sums[kD].at(i, j) = d;
      sums[kX].at(i, j) = n * i;
      sums[kY].at(i, j) = n * j;
      sums[kXX].at(i, j) = n * i * i;
      sums[kXY].at(i, j) = n * i * j;
      sums[kYY].at(i, j) = n * j * j;
      sums[kXD].at(i, j) = d * i;
      sums[kYD].at(i, j) = d * j;
      own.at(i, j) = 2 * n >= kPatch * kPatch ? static_cast<float>(d / n) : kUnknownValue;
    });
  }
  cv::parallel_for_(cv::Range(0, kSums), [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k) {
      sums[static_cast<std::size_t>(k)].SumWindows();
    }
  });
  ImageF ground(cols, rows, kUnknownValue);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < cols; ++i) {
      const double n = sums[kN].at(i, j);
      if (n < kLeastKnown * kWindow_px2) {
        continue;
      }
      const double x = sums[kX].at(i, j) / n, y = sums[kY].at(i, j) / n, d = sums[kD].at(i, j) / n;
      constexpr double kLevel = 1e-3;  // where all that is known lies in one row or column
      const double xx = sums[kXX].at(i, j) / n - x * x + kLevel;
      const double yy = sums[kYY].at(i, j) / n - y * y + kLevel;
      const double xy = sums[kXY].at(i, j) / n - x * y;
      const double xd = sums[kXD].at(i, j) / n - x * d, yd = sums[kYD].at(i, j) / n - y * d;
      const double determinant = xx * yy - xy * xy;
      const double along = (yy * xd - xy * yd) / determinant,
                   down = (xx * yd - xy * xd) / determinant;
      const auto plane = static_cast<float>(d + along * (i - x) + down * (j - y));
      const float measured = own.at(i, j);
      ground.at(i, j) = std::abs(measured - plane) > kOffPlane_px ? measured : plane;
    }
  }
  return ground;
}

/// Whether a surface goes on from one patch to the other.
bool GoesOn(float from_px, float to_px) { return std::abs(to_px - from_px) <= kEdge_px; }

/// A row of pixels between the middles of patches; NaN beside unknown ones and at depth edges.
void BetweenPatches(const ImageF& patches, int y, std::vector<float>& of_patch, float* out,
                    int width) {
  const int cols = patches.width(), rows = patches.height();
  constexpr float kMiddle = (kPatch - 1) / 2.0F;
  const float v =
      std::clamp((static_cast<float>(y) - kMiddle) / kPatch, 0.0F, static_cast<float>(rows - 1));
  const int j = std::min(static_cast<int>(v), rows - 2);
  const float t = v - static_cast<float>(j);
  const float *above = patches.row(j), *below = patches.row(j + 1);
  for (int i = 0; i < cols; ++i) {
    of_patch[static_cast<std::size_t>(i)] =
        GoesOn(above[i], below[i]) ? above[i] + t * (below[i] - above[i]) : kUnknownValue;
  }
  for (int x = 0; x < width; ++x) {
    const float u =
        std::clamp((static_cast<float>(x) - kMiddle) / kPatch, 0.0F, static_cast<float>(cols - 1));
    const int i = std::min(static_cast<int>(u), cols - 2);
    const float* p = of_patch.data() + i;
    out[x] =
        GoesOn(p[0], p[1]) ? p[0] + (u - static_cast<float>(i)) * (p[1] - p[0]) : kUnknownValue;
  }
}

/// A row without its finest detail: (1, 2, 1) / 4, the ends as they are.
void Smooth(const std::uint8_t* grey, int width, float* out) {
  out[0] = static_cast<float>(grey[0]);
  for (int x = 1; x < width - 1; ++x) {
    out[x] = static_cast<float>(grey[x - 1] + 2 * grey[x] + grey[x + 1]) / 4;
  }
  out[width - 1] = static_cast<float>(grey[width - 1]);
}

/// Coefficients of the cubic B-spline through a row, by its recursive filter.
void FindSpline(const float* grey, int width, float* c) {
  constexpr float kPole = -0.267949192F;  // sqrt(3) - 2
  c[0] = grey[0] / (1 - kPole);
  for (int x = 1; x < width; ++x) {
    c[x] = grey[x] + kPole * c[x - 1];
  }
  c[width - 1] = kPole / (kPole * kPole - 1) * (c[width - 1] + kPole * c[width - 2]);
  for (int x = width - 2; x >= 0; --x) {
    c[x] = kPole * (c[x + 1] - c[x]);
  }
  for (int x = 0; x < width; ++x) {
    c[x] *= 6;
  }
}

float SplineAt(const float* c, float x) {
  const int k = static_cast<int>(x);
  const float t = x - static_cast<float>(k), s = 1 - t;
  return (s * s * s * c[k - 1] + (4 + t * t * (3 * t - 6)) * c[k] +
          (4 + s * s * (3 * s - 6)) * c[k + 1] + t * t * t * c[k + 2]) *
         (1 / 6.0F);
}

/// Fills disparity and known, and the right picture in place of the residual.
void LayRight(const ImageU8& right, const ImageF& ground, LaidOver& laid) {
  const int width = right.width();
  cv::parallel_for_(cv::Range(0, right.height()), [&](const cv::Range& rows) {
    std::vector<float> spline(static_cast<std::size_t>(width)), of_patch(spline.size()),
        smooth(spline.size());
    for (int y = rows.start; y < rows.end; ++y) {
      Smooth(right.row(y), width, smooth.data());
      FindSpline(smooth.data(), width, spline.data());
      float *d = laid.disparity_px.row(y), *out = laid.residual.row(y), *known = laid.known.row(y);
      BetweenPatches(ground, y, of_patch, d, width);
      for (int x = 0; x < width; ++x) {
        const float from = static_cast<float>(x) - d[x];
        if (d[x] > 0 && from >= 1 && from < static_cast<float>(width - 2)) {
          out[x] = SplineAt(spline.data(), from);
          known[x] = 1;
        } else {
          d[x] = 0;
        }
      }
    }
  });
}

/// What the pictures differ by in light about each patch.
struct Light {
  ImageF gain, offset;
};

/// And their noise2, 0 where nothing is known.
Light LightBetween(const ImageF& left, LaidOver& laid) {
  const int cols = laid.noise2.width(), rows = laid.noise2.height();
  enum Sum { kN, kL, kR, kLL, kLR, kRR, kSums };
  std::vector<Patches> sums(kSums, Patches(cols, rows));
  cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
    const auto width = static_cast<std::size_t>(left.width());
    std::array<std::vector<float>, kSums> of_column;
    for (int j = range.start; j < range.end; ++j) {
      for (auto& column : of_column) {
        column.assign(width, 0.0F);
      }
      for (int y = kPatch * j; y < kPatch * (j + 1); ++y) {
        const float* grey = left.row(y);
        const float *r = laid.residual.row(y), *known = laid.known.row(y);
        for (std::size_t x = 0; x < width; ++x) {
          const float l = grey[x] * known[x];
          of_column[kN][x] += known[x];
          of_column[kL][x] += l;
          of_column[kR][x] += r[x];
          of_column[kLL][x] += l * l;
          of_column[kLR][x] += l * r[x];
          of_column[kRR][x] += r[x] * r[x];
        }
      }
      for (int k = 0; k < kSums; ++k) {
        SumColumns(of_column[static_cast<std::size_t>(k)], cols,
                   [&](int i, double sum) { sums[static_cast<std::size_t>(k)].at(i, j) = sum; });
      }
    }
  });
  cv::parallel_for_(cv::Range(0, kSums), [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k) {
      sums[static_cast<std::size_t>(k)].SumWindows();
    }
  });
  Light light{ImageF(cols, rows), ImageF(cols, rows)};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < cols; ++i) {
      const double n = sums[kN].at(i, j);
      if (n < kLeastKnown * kWindow_px2) {
        continue;
      }
      const double l = sums[kL].at(i, j) / n, r = sums[kR].at(i, j) / n;
      const double ll = sums[kLL].at(i, j) / n - l * l, rr = sums[kRR].at(i, j) / n - r * r;
      const double lr = sums[kLR].at(i, j) / n - l * r;
      // The ratio of contrasts: noise, which is in both, does not pull it to 0 as it pulls lr / rr.
      // A picture without contrast has none to compare.
      const double gain = lr > 0 && ll > 0 && rr > 0
                              ? std::clamp(std::sqrt(ll / rr), 1 / kMostGain, kMostGain)
                              : 1.0;
      light.gain.at(i, j) = static_cast<float>(gain);
      light.offset.at(i, j) = static_cast<float>(l - gain * r);
      laid.noise2.at(i, j) =
          static_cast<float>(std::max(kLeastNoise2, ll - 2 * gain * lr + gain * gain * rr));
    }
  }
  return light;
}

}  // namespace

LaidOver LayOver(const ImageU8& left, const ImageU8& right, const ImageF& disparity_px) {
  const int width = left.width(), height = left.height();
  PALACE_CHECK(width >= kLeastPicture_px && height >= kLeastPicture_px && right.width() == width &&
                   right.height() == height && disparity_px.width() == width &&
                   disparity_px.height() == height,
               width, height, right.width(), right.height(), disparity_px.width());
  LaidOver laid{ImageF(width, height), ImageF(width, height),
                ImageF(width / kPatch, height / kPatch), ImageF(width, height),
                ImageF(width, height)};
  LayRight(right, GroundDisparity(disparity_px), laid);
  cv::parallel_for_(cv::Range(0, height), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      Smooth(left.row(y), width, laid.left.row(y));
    }
  });
  const Light light = LightBetween(laid.left, laid);
  cv::parallel_for_(cv::Range(0, height), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      const int j = std::min(y / kPatch, light.gain.height() - 1);
      const float* grey = laid.left.row(y);
      float *residual = laid.residual.row(y), *known = laid.known.row(y);
      for (int x = 0; x < width; ++x) {
        const int i = std::min(x / kPatch, light.gain.width() - 1);
        const bool told = known[x] > 0 && laid.noise2.at(i, j) > 0;
        const float e = grey[x] - light.gain.at(i, j) * residual[x] - light.offset.at(i, j);
        residual[x] = told ? e : 0.0F;
        known[x] = told ? 1.0F : 0.0F;
      }
    }
  });
  return laid;
}

}  // namespace palace
