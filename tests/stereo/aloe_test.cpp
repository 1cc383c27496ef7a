// Middlebury's Aloe at half size: wrong pixels at equal coverage, beside OpenCV's matchers.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/stereo/opencv_matchers.h"
#include "engine/stereo/stereo.h"

namespace palace {
namespace {

constexpr DisparityWindow kWindow{0, 128};

struct Aloe {
  ImageU8 left;
  ImageU8 right;
  ImageF truth_px;  ///< of the left picture at half size, NaN unknown
};

cv::Mat Read(const char* file) {
  return cv::imread((std::filesystem::path(PALACE_SHARED_DATA_DIR) / "opencv_aloe" / file).string(),
                    cv::IMREAD_GRAYSCALE);
}

ImageU8 HalfOf(const cv::Mat& picture) {
  cv::Mat half;
  cv::resize(picture, half, {}, 0.5, 0.5, cv::INTER_AREA);
  ImageU8 image(half.cols, half.rows);
  for (int y = 0; y < half.rows; ++y) {
    std::copy_n(half.ptr<std::uint8_t>(y), half.cols, image.row(y));
  }
  return image;
}

Aloe LoadAloe() {
  const cv::Mat truth = Read("aloeGT.png");
  Aloe aloe{HalfOf(Read("aloeL.jpg")), HalfOf(Read("aloeR.jpg")), {}};
  aloe.truth_px = ImageF(aloe.left.width(), aloe.left.height());
  for (int y = 0; y < aloe.truth_px.height(); ++y) {
    for (int x = 0; x < aloe.truth_px.width(); ++x) {
      const int full = truth.at<std::uint8_t>(2 * y, 2 * x);
      aloe.truth_px.at(x, y) = full > 0 ? static_cast<float>(full) / 2 : NAN;
    }
  }
  return aloe;
}

/// The known pixels of a map, the surest first, and whether each is off by more than 1 px.
struct Ranked {
  double seen = 0;  ///< pixels with a truth
  std::vector<std::pair<float, bool>> pixels;

  double coverage() const { return static_cast<double>(pixels.size()) / seen; }
  double BadAt(double share) const {
    const auto count = std::min(pixels.size(), static_cast<std::size_t>(share * seen));
    const auto bad =
        std::count_if(pixels.begin(), pixels.begin() + static_cast<std::ptrdiff_t>(count),
                      [](const auto& pixel) { return pixel.second; });
    return static_cast<double>(bad) / static_cast<double>(count);
  }
};

/// `sigma_px` empty: all pixels alike. Only columns from `first` on.
Ranked Rank(const Aloe& aloe, const ImageF& disparity_px, const ImageF& sigma_px, int first) {
  Ranked ranked;
  for (int y = 0; y < aloe.truth_px.height(); ++y) {
    for (int x = first; x < aloe.truth_px.width(); ++x) {
      const float truth = aloe.truth_px.at(x, y);
      if (std::isnan(truth)) {
        continue;
      }
      ranked.seen += 1;
      const float found = disparity_px.at(x, y);
      if (!std::isnan(found)) {
        ranked.pixels.emplace_back(sigma_px.empty() ? 0.0F : sigma_px.at(x, y),
                                   std::abs(found - truth) > 1);
      }
    }
  }
  std::stable_sort(ranked.pixels.begin(), ranked.pixels.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  return ranked;
}

// Ours drops its least sure pixels by sigma, the peers theirs by a greater uniqueness margin. With
// the margins that OpenCV's own documentation calls usual (5 to 15 %) ours has fewer wrong pixels
// at equal coverage. At margins of 30 to 50 % SGBM is ahead: printed, not hidden.
TEST(Aloe, FewerWrongPixelsThanEverySgbmModeAtUsualMargins) {
  if (Read("aloeL.jpg").empty()) {
    GTEST_SKIP() << "no opencv_aloe in " << PALACE_SHARED_DATA_DIR;
  }
  const Aloe aloe = LoadAloe();
  const PinholeCamera camera{aloe.left.width(), aloe.left.height(), 600, 600, 320, 277};
  StereoMatcher matcher;
  const auto ours = matcher.Match(aloe.left, aloe.right, camera, 0.1, kWindow, {}, {});
  ASSERT_TRUE(ours.ok()) << ours.error().message;
  for (const int first : {0, kWindow.count}) {  // the whole picture, and where all search all
    SCOPED_TRACE(first);
    const Ranked mine = Rank(aloe, ours->range.disparity_px, ours->range.disparity_sigma_px, first);
    std::printf("columns from %d: ours %.2f %% of %.3f\n", first, 100 * mine.BadAt(1),
                mine.coverage());
    EXPECT_GT(mine.coverage(), 0.75);
    for (const OpenCvMatcher peer :
         {OpenCvMatcher::kSgbm, OpenCvMatcher::kSgbm3Way, OpenCvMatcher::kSgbmHh,
          OpenCvMatcher::kSgbmHh4, OpenCvMatcher::kBm}) {
      for (const double uniqueness : {5.0, 15.0, 30.0, 50.0}) {
        StereoSettings settings;
        settings.uniqueness_percent = uniqueness;
        const Ranked theirs =
            Rank(aloe, MatchWithOpenCv(peer, aloe.left, aloe.right, kWindow, settings), {}, first);
        const double coverage = std::min(theirs.coverage(), mine.coverage());
        std::printf("  %-9s uniqueness %2.0f: %.2f %% of %.3f; ours at %.3f: %.2f %%\n",
                    NameOf(peer), uniqueness, 100 * theirs.BadAt(1), theirs.coverage(), coverage,
                    100 * mine.BadAt(coverage));
        if (uniqueness <= 15) {
          EXPECT_LE(mine.BadAt(coverage), theirs.BadAt(1)) << NameOf(peer) << ' ' << uniqueness;
        }
      }
    }
  }
}

}  // namespace
}  // namespace palace
