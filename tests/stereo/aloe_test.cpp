// Middlebury's Aloe at half size: wrong pixels at equal coverage, beside OpenCV's SGBM modes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/stereo/opencv_matchers.h"
#include "engine/stereo/stereo.h"
#include "tests/support/reference_data.h"

namespace palace {
namespace {

constexpr DisparityWindow kWindow{0, 128};

struct Aloe {
  ImageU8 left;
  ImageU8 right;
  ImageF truth_px;  ///< of the left picture at half size, NaN unknown
};

cv::Mat Read(const char* file) {
  return cv::imread((ReferenceData("opencv_aloe") / file).string(), cv::IMREAD_GRAYSCALE);
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

/// A map's known pixels may be cut down to the surer ones: its wrong share at each coverage.
struct Point {
  double coverage = 0;  ///< known share of the pixels with a truth
  double wrong = 0;     ///< share of the known ones that are off by more than 1 px
};

/// By falling coverage.
using Curve = std::vector<Point>;

/// Wrong share at exactly this coverage, between the two points around it; nothing outside them.
std::optional<double> WrongAt(const Curve& curve, double coverage) {
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const Point &a = curve[k - 1], &b = curve[k];
    if (coverage <= a.coverage && coverage >= b.coverage && a.coverage > b.coverage) {
      const double part = (coverage - b.coverage) / (a.coverage - b.coverage);
      return b.wrong + part * (a.wrong - b.wrong);
    }
  }
  return std::nullopt;
}

/// Share of the 9x9 neighbourhood that lies on the pixel's own surface: within 1 px of it, or
/// balanced by the neighbour opposite (a slope). From the map alone, so that any map can be ranked.
float SurfaceShare(const ImageF& disparity_px, int x, int y) {
  constexpr int kHalf = 4;
  const auto at = [&](int column, int row) {
    const bool inside =
        column >= 0 && row >= 0 && column < disparity_px.width() && row < disparity_px.height();
    return inside ? disparity_px.at(column, row) : NAN;
  };
  const float here = disparity_px.at(x, y);
  int on_surface = 0, inside = 0;
  for (int v = -kHalf; v <= kHalf; ++v) {
    for (int u = -kHalf; u <= kHalf; ++u) {
      const float a = at(x + u, y + v) - here, b = at(x - u, y - v) - here;
      on_surface += std::abs(a) <= 1 || std::abs(a + b) <= 1 ? 1 : 0;
      inside +=
          x + u >= 0 && y + v >= 0 && x + u < disparity_px.width() && y + v < disparity_px.height()
              ? 1
              : 0;
    }
  }
  return static_cast<float>(on_surface) / static_cast<float>(inside);
}

/// Pixels of a map that have a truth, from column `first` on.
template <typename Visit>
void ForEachKnown(const Aloe& aloe, const ImageF& disparity_px, int first, const Visit& visit) {
  for (int y = 0; y < aloe.truth_px.height(); ++y) {
    for (int x = first; x < aloe.truth_px.width(); ++x) {
      const float error = disparity_px.at(x, y) - aloe.truth_px.at(x, y);
      if (!std::isnan(error)) {
        visit(x, y, std::abs(error) > 1);
      }
    }
  }
}

double PixelsWithTruth(const Aloe& aloe, int first) {
  double seen = 0;
  ForEachKnown(aloe, aloe.truth_px, first, [&](int, int, bool) { seen += 1; });
  return seen;
}

Point Measure(const Aloe& aloe, const ImageF& disparity_px, int first) {
  double known = 0, wrong = 0;
  ForEachKnown(aloe, disparity_px, first, [&](int, int, bool is_wrong) {
    known += 1;
    wrong += is_wrong ? 1 : 0;
  });
  return {known / PixelsWithTruth(aloe, first), wrong / known};
}

/// Drops the pixels with the least surface share first, a thousandth of the picture at a time.
Curve CurveBySurfaceShare(const Aloe& aloe, const ImageF& disparity_px, int first) {
  std::vector<std::pair<float, bool>> ranked;
  ForEachKnown(aloe, disparity_px, first, [&](int x, int y, bool is_wrong) {
    ranked.emplace_back(-SurfaceShare(disparity_px, x, y), is_wrong);
  });
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const double seen = PixelsWithTruth(aloe, first);
  const auto step = static_cast<std::size_t>(seen / 1000);
  Curve rising;
  double wrong = 0;
  for (std::size_t k = 0; k < ranked.size(); ++k) {
    wrong += ranked[k].second ? 1 : 0;
    if ((k + 1) % step == 0 || k + 1 == ranked.size()) {
      const auto known = static_cast<double>(k + 1);
      rising.push_back({known / seen, wrong / known});
    }
  }
  return {rising.rbegin(), rising.rend()};
}

constexpr std::array kSgbmModes{OpenCvMatcher::kSgbm, OpenCvMatcher::kSgbm3Way,
                                OpenCvMatcher::kSgbmHh, OpenCvMatcher::kSgbmHh4};
constexpr std::array kMargins_percent{0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0};

struct Best {
  OpenCvMatcher mode{};
  double wrong = 1;
};

/// Of the SGBM modes that reach the coverage with some uniqueness margin.
Best BestSgbmAt(const std::vector<Curve>& peers, double coverage) {
  Best best;
  for (std::size_t k = 0; k < peers.size(); ++k) {
    const auto wrong = WrongAt(peers[k], coverage);
    if (wrong && *wrong < best.wrong) {
      best = {kSgbmModes[k], *wrong};
    }
  }
  return best;
}

// Wrong pixels at literally equal coverage. Ours gives up the pixels whose surroundings carry their
// surface least, each SGBM mode those below a greater and greater uniqueness margin; the best mode
// at each coverage counts. Ours has fewer up to two thirds of the picture. Above it SGBM at margins
// of 40 to 60 % is ahead, by up to a third at 0.79: printed, not hidden.
TEST(Aloe, WrongPixelsAgainstTheBestSgbmModeAtEqualCoverage) {
  if (Read("aloeL.jpg").empty()) {
    GTEST_SKIP() << NoReferenceData("opencv_aloe");
  }
  const Aloe aloe = LoadAloe();
  const PinholeCamera camera{aloe.left.width(), aloe.left.height(), 600, 600, 320, 277};
  StereoMatcher matcher;
  const auto ours = matcher.Match(aloe.left, aloe.right, camera, 0.1, kWindow, {}, {});
  ASSERT_TRUE(ours.ok()) << ours.error().message;
  const int first = kWindow.count;  // where every matcher searches every disparity
  const Curve mine = CurveBySurfaceShare(aloe, ours->range.disparity_px, first);
  std::vector<Curve> peers;
  for (const OpenCvMatcher mode : kSgbmModes) {
    Curve& curve = peers.emplace_back();
    std::printf("%-9s by margin:", NameOf(mode));
    for (const double margin : kMargins_percent) {
      StereoSettings settings;
      settings.uniqueness_percent = margin;
      const ImageF map = MatchWithOpenCv(mode, aloe.left, aloe.right, kWindow, settings);
      curve.push_back(Measure(aloe, map, first));
      std::printf(" %.3f/%.2f%%", curve.back().coverage, 100 * curve.back().wrong);
    }
    std::printf("\n");
  }
  std::printf("ours whole: %.2f %% of %.3f\n", 100 * mine.front().wrong, mine.front().coverage);
  EXPECT_GE(mine.front().coverage, 0.795);
  EXPECT_LE(mine.front().wrong, 0.026);
  for (int percent = 79; percent >= 60; --percent) {
    SCOPED_TRACE(percent);
    const double coverage = percent / 100.0;
    const auto wrong = WrongAt(mine, coverage);
    ASSERT_TRUE(wrong.has_value());
    const Best best = BestSgbmAt(peers, coverage);
    std::printf("coverage %.2f: ours %.2f %%, best %s %.2f %%\n", coverage, 100 * *wrong,
                NameOf(best.mode), 100 * best.wrong);
    if (percent <= 66) {
      EXPECT_LE(*wrong, best.wrong);
    } else {
      EXPECT_LE(*wrong, 1.4 * best.wrong);
    }
  }
}

}  // namespace
}  // namespace palace
