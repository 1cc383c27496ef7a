#include "engine/tracking/coherence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"
#include "engine/tracking/picture_part.h"
#include "engine/tracking/template_match.h"

namespace palace {
namespace {

constexpr double kMinVariance = 1.0;  // grey levels squared; flatter patches say nothing

ImageU8 Halved(const ImageU8& picture) {
  ImageU8 small((picture.width() + 1) / 2, (picture.height() + 1) / 2);
  cv::Mat out = GreyView(small);
  cv::pyrDown(GreyView(picture), out);
  return small;
}

struct Correlation {
  double rho = 0;
  double gain = 1;  // current ~ gain * (anchor - mean_anchor) + mean_current
  double mean_anchor = 0;
  double mean_current = 0;
};

Correlation Correlate(const cv::Mat& anchor, const cv::Mat& current) {
  double sum_a = 0, sum_c = 0, sum_aa = 0, sum_cc = 0, sum_ac = 0;
  for (int y = 0; y < anchor.rows; ++y) {
    const unsigned char* a = anchor.ptr(y);
    const unsigned char* c = current.ptr(y);
    int row_a = 0, row_c = 0, row_aa = 0, row_cc = 0, row_ac = 0;  // of at most 2^15 pixels: exact
    for (int x = 0; x < anchor.cols; ++x) {
      const int av = a[x], cv = c[x];
      row_a += av;
      row_c += cv;
      row_aa += av * av;
      row_cc += cv * cv;
      row_ac += av * cv;
    }
    sum_a += row_a;
    sum_c += row_c;
    sum_aa += row_aa;
    sum_cc += row_cc;
    sum_ac += row_ac;
  }
  const double n = static_cast<double>(anchor.total());
  const double var_a = sum_aa / n - sum_a * sum_a / (n * n);
  const double var_c = sum_cc / n - sum_c * sum_c / (n * n);
  const double cov = sum_ac / n - sum_a * sum_c / (n * n);
  Correlation result;
  result.mean_anchor = sum_a / n;
  result.mean_current = sum_c / n;
  if (var_a > kMinVariance && var_c > kMinVariance) {
    result.rho = cov / std::sqrt(var_a * var_c);
    result.gain = std::sqrt(var_c / var_a);
  }
  return result;
}

}  // namespace

PatchComparison ComparePatches(ImageU8 anchor_patch, ImageU8 current_patch) {
  PALACE_CHECK(anchor_patch.width() == current_patch.width() &&
               anchor_patch.height() == current_patch.height());
  cv::Mat smooth_anchor;
  cv::Mat smooth_current;
  cv::GaussianBlur(GreyView(anchor_patch), smooth_anchor, cv::Size(5, 5), 1.1);
  cv::GaussianBlur(GreyView(current_patch), smooth_current, cv::Size(5, 5), 1.1);
  const Correlation match = Correlate(smooth_anchor, smooth_current);
  ImageU8 difference(anchor_patch.width(), anchor_patch.height());
  std::array<double, 256> expected{};
  for (int grey = 0; grey < 256; ++grey) {
    expected[static_cast<std::size_t>(grey)] =
        match.gain * (grey - match.mean_anchor) + match.mean_current;
  }
  for (std::size_t i = 0; i < difference.pixels().size(); ++i) {
    const double value =
        128.5 + (current_patch.pixels()[i] - expected[anchor_patch.pixels()[i]]) / 2;
    difference.pixels()[i] = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
  }
  PatchComparison comparison;
  comparison.coherence = std::clamp(match.rho, 0.0, 1.0);
  comparison.anchor = std::make_shared<const ImageU8>(std::move(anchor_patch));
  comparison.current = std::make_shared<const ImageU8>(std::move(current_patch));
  comparison.difference = std::make_shared<const ImageU8>(std::move(difference));
  return comparison;
}

PatchComparison ComparePatches(const ImageU8& anchor, const ImageU8& current,
                               const Eigen::Matrix3d& anchor_from_current,
                               const Eigen::Vector2d& centre) {
  return ComparePatches(WarpedSquare(anchor, anchor_from_current, centre, kPatchSide_px),
                        WarpedSquare(current, Eigen::Matrix3d::Identity(), centre, kPatchSide_px));
}

PatchSearch SearchPatch(const ImageU8& anchor, const ImageU8& current,
                        const Eigen::Matrix3d& anchor_from_current, const Eigen::Vector2d& centre,
                        int radius_px) {
  // At half resolution: a quarter of the places and of the pixels; flow refines the answer.
  const ImageU8 wanted = WarpedSquare(anchor, anchor_from_current, centre, kPatchSide_px);
  const ImageU8 window =
      WarpedSquare(current, Eigen::Matrix3d::Identity(), centre, kPatchSide_px + 2 * radius_px);
  const TemplateMatch match = MatchTemplate(Halved(window), Halved(wanted));
  return {2.0 * match.corner.cast<double>() - Eigen::Vector2d::Constant(radius_px), match.score,
          match.second_score};
}

}  // namespace palace
