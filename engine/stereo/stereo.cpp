#include "engine/stereo/stereo.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <opencv2/core.hpp>

#include "engine/core/text.h"
#include "engine/model/half_size.h"
#include "engine/stereo/disparity.h"
#include "engine/stereo/faint_ground.h"
#include "engine/stereo/hidden.h"
#include "engine/stereo/prefilter.h"
#include "engine/stereo/stereo_quality.h"
#include "engine/stereo/subpixel.h"

namespace palace {
namespace {

constexpr int kLeastOverlap_px = 32;  // columns both pictures must share
constexpr int kWidestWindow_px = 4096;
constexpr double kSwapTestCoverage = 0.1;
constexpr float kLeastDisparity_px = 0.1F;  // beyond it depth is not bounded by the picture

Status CheckInput(const ImageU8& left, const ImageU8& right, const PinholeCamera& camera,
                  double baseline_m, const DisparityWindow& window) {
  for (const ImageU8* image : {&left, &right}) {
    if (image->width() != camera.width || image->height() != camera.height) {
      return InvalidError("stereo: picture is " + SizeText(image->width(), image->height()) +
                          ", the rectified camera is " + SizeText(camera.width, camera.height) +
                          "; rectify the pair first");
    }
  }
  if (!(baseline_m > 0) || !std::isfinite(baseline_m) || !(camera.fx_px > 0)) {
    return InvalidError("stereo: baseline " + std::to_string(baseline_m) + " m and focal length " +
                        std::to_string(camera.fx_px) + " px must be positive; check RIG.toml");
  }
  if (window.min_px < 0 || window.count < 16 || window.count > kWidestWindow_px ||
      window.count % 16 != 0) {
    return InvalidError("stereo: disparity window from " + std::to_string(window.min_px) + " px, " +
                        std::to_string(window.count) +
                        " wide; the start must be 0 or more, the width a multiple of 16 up to " +
                        std::to_string(kWidestWindow_px));
  }
  if (camera.width - window.min_px < kLeastOverlap_px) {
    return InvalidError("stereo: disparities from " + std::to_string(window.min_px) +
                        " px leave no overlap in a picture " + std::to_string(camera.width) +
                        " px wide; the ground is too near for stereo");
  }
  return Ok();
}

/// Z = f b / d and sigma_Z = Z^2 sigma_d / (f b).
RangeMap RangeMapFromDisparity(SubpixelDisparity refined, const PinholeCamera& camera,
                               double baseline_m, Timestamp time) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  RangeMap range;
  range.time = time;
  range.camera = camera;
  range.baseline_m = baseline_m;
  range.disparity_px = std::move(refined.disparity_px);
  range.disparity_sigma_px = std::move(refined.sigma_px);
  range.depth_m = ImageF(camera.width, camera.height, kNaN);
  range.depth_sigma_m = ImageF(camera.width, camera.height, kNaN);
  const auto fb = static_cast<float>(range.FocalTimesBaseline());
  cv::parallel_for_(cv::Range(0, camera.height), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      float* disparity = range.disparity_px.row(y);
      float* sigma = range.disparity_sigma_px.row(y);
      float* depth = range.depth_m.row(y);
      float* depth_sigma = range.depth_sigma_m.row(y);
      for (int x = 0; x < camera.width; ++x) {
        if (disparity[x] > kLeastDisparity_px) {
          depth[x] = fb / disparity[x];
          depth_sigma[x] = depth[x] * sigma[x] / disparity[x];
        } else {
          disparity[x] = kNaN;
          sigma[x] = kNaN;
        }
      }
    }
  });
  return range;
}

ImageF FindWholePixels(const ImageU8& left, const ImageU8& right, const RectifiedPair* filtered,
                       const DisparityWindow& window, const StereoSettings& settings) {
  if (filtered) {
    return MatchWholePixels(*filtered->left, *filtered->right, window, settings);
  }
  if (settings.prefilter == StereoPrefilter::kNone) {
    return MatchWholePixels(left, right, window, settings);
  }
  return MatchWholePixels(Prefilter(left, settings.prefilter), Prefilter(right, settings.prefilter),
                          window, settings);
}

SubpixelDisparity MeasurePixels(const ImageU8& left, const ImageU8& right, const ImageF& whole,
                                const StereoSettings& settings) {
  SubpixelOptions options;
  options.window_px = settings.refine_window_px | 1;
  options.max_sigma_px = settings.max_sigma_px;
  SubpixelDisparity refined = RefineDisparity(left, right, whole, options);
  RefuseHidden(settings.max_refined_left_right_px, refined.disparity_px, refined.sigma_px);
  return refined;
}

void MeasureFaintGround(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                        const StereoSettings& settings, SubpixelDisparity& refined) {
  if (left.width() / 2 - window.min_px / 2 < kLeastOverlap_px || left.height() < 2) {
    return;
  }
  const ImageU8 faint = FindFaintGround(left, right, refined.disparity_px);
  if (faint.empty()) {
    return;
  }
  const ImageU8 half_left = HalfSize(left), half_right = HalfSize(right);
  const ImageF whole =
      FindWholePixels(half_left, half_right, nullptr, HalfWindow(window), settings);
  FillFaintGround(faint, MeasurePixels(half_left, half_right, whole, settings),
                  settings.max_sigma_px, refined);
}

}  // namespace

Result<StereoResult> StereoMatcher::Match(const ImageU8& left, const ImageU8& right,
                                          const PinholeCamera& camera, double baseline_m,
                                          const DisparityWindow& window,
                                          const StereoSettings& settings, Timestamp time,
                                          const RectifiedPair* filtered) {
  if (Status status = CheckInput(left, right, camera, baseline_m, window); !status) {
    return status.error();
  }
  for (const ImageU8* image :
       {filtered ? filtered->left.get() : &left, filtered ? filtered->right.get() : &right}) {
    if (image->width() != left.width() || image->height() != left.height()) {
      return InvalidError("stereo: the filtered picture is " +
                          SizeText(image->width(), image->height()) + ", the pair is " +
                          SizeText(left.width(), left.height()));
    }
  }
  SubpixelDisparity refined = MeasurePixels(
      left, right, FindWholePixels(left, right, filtered, window, settings), settings);
  if (settings.method == StereoMethod::kCensus) {
    MeasureFaintGround(left, right, window, settings, refined);
  }
  StereoResult result;
  result.range = RangeMapFromDisparity(std::move(refined), camera, baseline_m, time);
  StereoQuality& quality = result.quality;
  SummariseRange(result.range, quality);
  MeasureRowError(left, right, result.range.disparity_px, quality);
  SuspectPictures(left, right, quality);
  quality.suspect_swapped =
      quality.coverage < kSwapTestCoverage && LooksSwapped(left, right, window, settings);
  return result;
}

}  // namespace palace
