#include "engine/stereo/faint_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"
#include "engine/core/check.h"
#include "engine/core/median.h"

namespace palace {
namespace {

// Of the noise's variance; see the header.
constexpr double kLeastVariance = 1.25, kMostVariance = 4;
constexpr int kWindow_px = 9;
constexpr int kOneIn = 50;  // fewer faint pixels are not worth a second pass
constexpr int kLeastSamples = 200;
constexpr float kNearWhole_px = 0.1F;
constexpr float kMostOff_sigmas = 1.5F;    // off the mean of its window
constexpr float kSameSurface_px = 1;       // between pixels of the half picture
constexpr double kLeastNoise_grey = 0.29;  // of rounding to whole levels alone

/// Calls work(y) for every row, on OpenCV's threads.
template <typename Work>
void ForRows(int rows, const Work& work) {
  cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
    for (int y = range.start; y < range.end; ++y) {
      work(y);
    }
  });
}

/// Standard deviation of one picture's noise, grey levels; nothing where too little is known.
std::optional<double> NoiseOf(const ImageU8& left, const ImageU8& right,
                              const ImageF& disparity_px) {
  constexpr int kRowStep = 3;
  std::array<int, 512> counts{};  // of |e(x) - e(x+1)|, whole grey levels
  int samples = 0;
  for (int y = 0; y < left.height(); y += kRowStep) {
    const std::uint8_t *l = left.row(y), *r = right.row(y);
    const float* d = disparity_px.row(y);
    for (int x = 0; x + 1 < left.width(); ++x) {
      const float whole = std::round(d[x]);
      if (!(std::abs(d[x] - whole) <= kNearWhole_px)) {  // unknown too
        continue;
      }
      const int match = x - static_cast<int>(whole);
      if (match >= 0 && match + 1 < left.width()) {
        ++counts[static_cast<std::size_t>(std::abs((l[x] - r[match]) - (l[x + 1] - r[match + 1])))];
        ++samples;
      }
    }
  }
  if (samples < kLeastSamples) {
    return std::nullopt;
  }
  // The median within its whole level.
  std::size_t level = 0;
  double below = 0;
  while (below + counts[level] < 0.5 * samples) {
    below += counts[level++];
  }
  const double median =
      static_cast<double>(level) - 0.5 + (0.5 * samples - below) / std::max(1, counts[level]);
  return std::max(kLeastNoise_grey, median * kSigmaPerMad / 2);
}

/// kFaint but in columns that show what lies beyond the right picture: those left of the row's
/// first disparity, or of one above where the row has none.
ImageU8 SeenByBoth(const ImageF& disparity_px) {
  ImageU8 seen(disparity_px.width(), disparity_px.height(), kClear);
  int beyond = 0;
  for (int y = 0; y < seen.height(); ++y) {
    const float* d = disparity_px.row(y);
    const float* end = d + seen.width();
    const float* known = std::find_if(d, end, [](float value) { return !std::isnan(value); });
    // Near infinity a disparity may be a hair below 0.
    beyond = known < end ? std::max(0, static_cast<int>(*known)) : beyond;
    std::fill(seen.row(y) + beyond, seen.row(y) + seen.width(), std::uint8_t{kFaint});
  }
  return seen;
}

/// Too few unknown faint pixels are not worth a second pass.
bool HasFewUnknown(const ImageU8& mask, const ImageF& disparity_px) {
  std::size_t unknown = 0;
  for (std::size_t k = 0; k < mask.pixels().size(); ++k) {
    unknown += mask.pixels()[k] == kFaint && std::isnan(disparity_px.pixels()[k]) ? 1 : 0;
  }
  return unknown * kOneIn < mask.pixels().size();
}

/// The pixel of the half picture that holds this one, and the one beside it on the other side.
struct Neighbours {
  int near = 0;
  int far = 0;
};

Neighbours AlongAxis(int place, int half_size) {
  const int near = std::min(place / 2, half_size - 1);
  return {near, std::clamp(place % 2 == 0 ? near - 1 : near + 1, 0, half_size - 1)};
}

/// Mean of what is known in the window around each pixel; 0 / 0 where nothing is.
cv::Mat MeanAround(const ImageF& values) {
  cv::Mat known(values.height(), values.width(), CV_32F), value = known.clone();
  ForRows(values.height(), [&](int y) {
    const float* v = values.row(y);
    float *k = known.ptr<float>(y), *z = value.ptr<float>(y);
    for (int x = 0; x < values.width(); ++x) {
      k[x] = std::isnan(v[x]) ? 0.0F : 1.0F;
      z[x] = std::isnan(v[x]) ? 0.0F : v[x];
    }
  });
  const cv::Size window{kWindow_px, kWindow_px};
  cv::boxFilter(known, known, CV_32F, window, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::boxFilter(value, value, CV_32F, window, {-1, -1}, false, cv::BORDER_CONSTANT);
  return value / known;
}

/// Makes unknown what strays from the mean of its window by more than its sigma allows, where
/// `where` is faint or everywhere.
void DropChanceMatches(const ImageU8* where, SubpixelDisparity& found) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const cv::Mat mean = MeanAround(found.disparity_px);
  ForRows(found.disparity_px.height(), [&](int y) {
    const float* m = mean.ptr<float>(y);
    float *d = found.disparity_px.row(y), *sigma = found.sigma_px.row(y);
    for (int x = 0; x < found.disparity_px.width(); ++x) {
      if ((!where || where->at(x, y) != kClear) &&
          std::abs(d[x] - m[x]) > kMostOff_sigmas * sigma[x]) {
        d[x] = sigma[x] = kNaN;
      }
    }
  });
}

}  // namespace

ImageU8 FindFaintGround(const ImageU8& left, const ImageU8& right, const ImageF& disparity_px) {
  ImageU8 faint = SeenByBoth(disparity_px);
  if (HasFewUnknown(faint, disparity_px)) {
    return {};
  }
  const std::optional<double> noise = NoiseOf(left, right, disparity_px);
  if (!noise) {
    return {};
  }
  const cv::Mat picture = GreyView(left);
  cv::Mat mean, square;
  cv::boxFilter(picture, mean, CV_32F, {kWindow_px, kWindow_px});
  cv::sqrBoxFilter(picture, square, CV_32F, {kWindow_px, kWindow_px});
  const auto least = static_cast<float>(kLeastVariance * *noise * *noise);
  const auto most = static_cast<float>(kMostVariance * *noise * *noise);
  ForRows(left.height(), [&](int y) {
    const float* m = mean.ptr<float>(y);
    const float* s = square.ptr<float>(y);
    std::uint8_t* out = faint.row(y);
    for (int x = 0; x < left.width(); ++x) {
      const float variance = s[x] - m[x] * m[x];
      const FaintPixel shows = variance < least ? kNoiseAlone : kFaint;
      out[x] = out[x] != kClear && variance <= most ? shows : kClear;
    }
  });
  return HasFewUnknown(faint, disparity_px) ? ImageU8{} : faint;
}

void FillFaintGround(const ImageU8& faint, SubpixelDisparity half, double max_sigma_px,
                     SubpixelDisparity& filled) {
  const ImageF &d = half.disparity_px, &sigma = half.sigma_px;
  PALACE_CHECK(faint.width() == filled.disparity_px.width() && d.width() == faint.width() / 2 &&
                   d.height() == faint.height() / 2,
               faint.width(), d.width());
  DropChanceMatches(nullptr, half);
  ForRows(faint.height(), [&](int y) {
    const Neighbours row = AlongAxis(y, d.height());
    for (int x = 0; x < faint.width(); ++x) {
      if (faint.at(x, y) != kFaint || !std::isnan(filled.disparity_px.at(x, y))) {
        continue;
      }
      const Neighbours col = AlongAxis(x, d.width());
      const float nearest = d.at(col.near, row.near), known_to = sigma.at(col.near, row.near);
      if (!(2 * known_to <= static_cast<float>(max_sigma_px))) {  // NaN too
        continue;
      }
      float sum = 0, weights = 0;
      const auto add = [&](int i, int j, float weight) {
        const float value = d.at(i, j);
        if (std::abs(value - nearest) <= kSameSurface_px) {
          sum += weight * value;
          weights += weight;
        }
      };
      add(col.near, row.near, 9);
      add(col.far, row.near, 3);
      add(col.near, row.far, 3);
      add(col.far, row.far, 1);
      filled.disparity_px.at(x, y) = 2 * sum / weights;
      filled.sigma_px.at(x, y) = 2 * known_to;
    }
  });
  DropChanceMatches(&faint, filled);
}

}  // namespace palace
