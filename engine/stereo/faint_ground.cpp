#include "engine/stereo/faint_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/core/check.h"
#include "engine/core/median.h"

namespace palace {
namespace {

constexpr double kFaintVariance = 4;  // of the noise's; see the header
constexpr int kWindow_px = 9;
constexpr int kOneIn = 50;  // fewer faint pixels are not worth a second pass
constexpr int kLeastSamples = 200;
constexpr float kNearWhole_px = 0.1F;
constexpr float kSameSurface_px = 1;       // between pixels of the half picture
constexpr double kLeastNoise_grey = 0.29;  // of rounding to whole levels alone

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

/// 1 where the disparity is unknown, but for columns that show what lies beyond the right picture:
/// those left of the row's first disparity, or of one above where the row has none.
ImageU8 UnknownInBoth(const ImageF& disparity_px) {
  ImageU8 unknown(disparity_px.width(), disparity_px.height(), 0);
  int beyond = 0;
  for (int y = 0; y < unknown.height(); ++y) {
    const float* d = disparity_px.row(y);
    const float* end = d + unknown.width();
    const float* known = std::find_if(d, end, [](float value) { return !std::isnan(value); });
    beyond = known < end ? static_cast<int>(*known) : beyond;
    for (int x = beyond; x < unknown.width(); ++x) {
      unknown.at(x, y) = std::isnan(d[x]) ? 1 : 0;
    }
  }
  return unknown;
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
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      const bool is_known = std::isfinite(values.at(x, y));
      known.at<float>(y, x) = is_known ? 1.0F : 0.0F;
      value.at<float>(y, x) = is_known ? values.at(x, y) : 0.0F;
    }
  }
  const cv::Size window{kWindow_px, kWindow_px};
  cv::boxFilter(known, known, CV_32F, window, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::boxFilter(value, value, CV_32F, window, {-1, -1}, false, cv::BORDER_CONSTANT);
  return value / known;
}

}  // namespace

ImageU8 FindFaintGround(const ImageU8& left, const ImageU8& right, const ImageF& disparity_px) {
  ImageU8 faint = UnknownInBoth(disparity_px);
  const auto too_few = [](const ImageU8& mask) {
    const auto count = std::count(mask.pixels().begin(), mask.pixels().end(), 1);
    return count * kOneIn < static_cast<std::ptrdiff_t>(mask.pixels().size());
  };
  if (too_few(faint)) {
    return {};
  }
  const std::optional<double> noise = NoiseOf(left, right, disparity_px);
  if (!noise) {
    return {};
  }
  // OpenCV has no read-only view; nothing here writes through it.
  const cv::Mat picture(left.height(), left.width(), CV_8UC1,
                        const_cast<std::uint8_t*>(left.pixels().data()));
  cv::Mat mean, square;
  cv::boxFilter(picture, mean, CV_32F, {kWindow_px, kWindow_px});
  cv::sqrBoxFilter(picture, square, CV_32F, {kWindow_px, kWindow_px});
  const auto most = static_cast<float>(kFaintVariance * *noise * *noise);
  for (int y = 0; y < left.height(); ++y) {
    const float* m = mean.ptr<float>(y);
    const float* s = square.ptr<float>(y);
    std::uint8_t* out = faint.row(y);
    for (int x = 0; x < left.width(); ++x) {
      out[x] = out[x] != 0 && s[x] - m[x] * m[x] <= most ? 1 : 0;
    }
  }
  return too_few(faint) ? ImageU8{} : faint;
}

void FillFaintGround(const ImageU8& faint, const SubpixelDisparity& half, double max_sigma_px,
                     SubpixelDisparity& filled) {
  const ImageF &d = half.disparity_px, &sigma = half.sigma_px;
  PALACE_CHECK(faint.width() == filled.disparity_px.width() && d.width() == faint.width() / 2 &&
                   d.height() == faint.height() / 2,
               faint.width(), d.width());
  const cv::Mat mean = MeanAround(d);
  for (int y = 0; y < faint.height(); ++y) {
    const Neighbours row = AlongAxis(y, d.height());
    for (int x = 0; x < faint.width(); ++x) {
      if (faint.at(x, y) == 0) {
        continue;
      }
      const Neighbours col = AlongAxis(x, d.width());
      const float nearest = d.at(col.near, row.near), known_to = sigma.at(col.near, row.near);
      // NaN fails both.
      if (!(2 * known_to <= static_cast<float>(max_sigma_px)) ||
          !(std::abs(nearest - mean.at<float>(row.near, col.near)) <= known_to)) {
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
  }
}

}  // namespace palace
