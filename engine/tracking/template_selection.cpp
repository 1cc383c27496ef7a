#include "engine/tracking/template_selection.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"
#include "engine/tracking/picture_part.h"
#include "engine/tracking/template_match.h"

namespace palace {
namespace {

/// Sensor noise of two grey levels gives 0.2 at most: fainter places are followed by chance.
constexpr float kMinEigenvalue = 0.5F;

cv::Mat SmallerEigenvalue(const ImageU8& picture, int template_px) {
  cv::Mat smooth, gx, gy;
  cv::GaussianBlur(GreyView(picture), smooth, {}, 1.0);
  constexpr double kPerPixel = 1.0 / 8;  // Sobel's weights
  cv::Sobel(smooth, gx, CV_32F, 1, 0, 3, kPerPixel);
  cv::Sobel(smooth, gy, CV_32F, 0, 1, 3, kPerPixel);
  cv::Mat xx = gx.mul(gx), xy = gx.mul(gy), yy = gy.mul(gy);
  for (cv::Mat* m : {&xx, &xy, &yy}) {
    cv::GaussianBlur(*m, *m, cv::Size(template_px, template_px), template_px / 4.0);
  }
  cv::Mat difference = xx - yy, root;
  cv::sqrt(difference.mul(difference) + 4 * xy.mul(xy), root);
  return 0.5 * (xx + yy - root);
}

struct Candidate {
  float strength = 0;
  Eigen::Vector2i pixel = Eigen::Vector2i::Zero();
};

/// Local maxima at which the whole template lies in the picture, strongest first.
std::vector<Candidate> Candidates(const ImageU8& picture, int template_px, const ImageU8& mask) {
  const cv::Mat strength = SmallerEigenvalue(picture, template_px);
  cv::Mat peak;
  const int reach = template_px / 4 * 2 + 1;
  cv::dilate(strength, peak, cv::Mat::ones(reach, reach, CV_8U));
  const int half = template_px / 2;
  std::vector<Candidate> found;
  for (int y = half; y < picture.height() - half; ++y) {
    const float* row = strength.ptr<float>(y);
    const float* top = peak.ptr<float>(y);
    for (int x = half; x < picture.width() - half; ++x) {
      if (row[x] >= kMinEigenvalue && row[x] >= top[x] && (mask.empty() || mask.at(x, y) != 0)) {
        found.push_back({row[x], {x, y}});
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
  return found;
}

}  // namespace

double SelfSimilarity(const ImageU8& picture, const Eigen::Vector2i& pixel, int template_px,
                      int search_px) {
  const int half = template_px / 2;
  const int x = pixel.x(), y = pixel.y();
  PALACE_CHECK(x >= half && y >= half && x + half < picture.width() && y + half < picture.height(),
               x, y, template_px);
  const Eigen::Vector2d middle = pixel.cast<double>();
  return MatchTemplate(CutWindow(picture, middle, half + search_px).picture,
                       CutWindow(picture, middle, half).picture)
      .second_score;
}

std::vector<TemplateFeature> SelectTemplates(const ImageU8& picture,
                                             const TemplateSelectionOptions& options,
                                             const ImageU8& mask) {
  PALACE_CHECK(options.template_px > 0 && options.template_px % 2 == 1, options.template_px);
  PALACE_CHECK(options.search_px > 0, options.search_px);
  PALACE_CHECK(mask.empty() ||
               (mask.width() == picture.width() && mask.height() == picture.height()));
  std::vector<TemplateFeature> features;
  if (std::min(picture.width(), picture.height()) < options.template_px) {
    return features;
  }
  const auto is_near = [](const std::vector<Eigen::Vector2d>& places, const Eigen::Vector2d& pixel,
                          double distance_px) {
    return std::any_of(places.begin(), places.end(), [&](const Eigen::Vector2d& place) {
      return (place - pixel).norm() < distance_px;
    });
  };
  std::vector<Eigen::Vector2d> taken, refused;
  for (const Candidate& candidate : Candidates(picture, options.template_px, mask)) {
    if (static_cast<int>(taken.size()) >= options.max_count ||
        static_cast<int>(taken.size() + refused.size()) >= options.max_tried) {
      break;
    }
    const Eigen::Vector2d pixel = candidate.pixel.cast<double>();
    // A pattern goes on beside where it was found to repeat.
    if (is_near(taken, pixel, options.spacing_px) ||
        is_near(refused, pixel, options.template_px / 4.0)) {
      continue;
    }
    const double similarity =
        SelfSimilarity(picture, candidate.pixel, options.template_px, options.search_px);
    const bool alone = similarity <= options.max_self_similarity;
    (alone ? taken : refused).push_back(pixel);
    if (alone) {
      features.push_back({pixel, candidate.strength, similarity});
    }
  }
  return features;
}

}  // namespace palace
