#include "engine/tracking/landing_features.h"

#include <algorithm>

#include "engine/tracking/coherence.h"
#include "engine/tracking/landmark_placement.h"
#include "engine/tracking/picture_part.h"
#include "engine/tracking/template_selection.h"

namespace palace {
namespace {

constexpr int kReach_px = 110;      // around the site
constexpr double kSpacing_px = 48;  // so that one bird does not cover two
constexpr int kSearch_px = 24;      // of the test for a second place
constexpr int kTriedForEach = 3;    // each costs some 0.2 ms
constexpr int kMaskStep_px = 4;
constexpr double kBorder_px = kPatchSide_px / 2 + 4;

}  // namespace

int FeatureSide(const TrackingSettings& settings) {
  return std::clamp(settings.template_size_px | 1, 21, 61);
}

std::vector<Eigen::Vector2d> ChooseLandingFeatures(const SiteView& view, const GroundPlane& plane,
                                                   const Eigen::Vector2d& site_pixel,
                                                   const std::vector<Eigen::Vector2d>& taken,
                                                   int count) {
  const Eigen::Vector2d last(view.camera.width - 1, view.camera.height - 1);
  const Eigen::Vector2d middle = site_pixel.cwiseMax(0).cwiseMin(last);
  const PictureWindow window = CutWindow(view.left, middle, kReach_px);
  const Eigen::Vector2d corner = window.corner.cast<double>();
  const int width = window.picture.width(), height = window.picture.height();
  std::vector<Eigen::Vector2d> grid;
  for (int y = 0; y < height; y += kMaskStep_px) {
    for (int x = 0; x < width; x += kMaskStep_px) {
      grid.push_back(corner + Eigen::Vector2d(x, y));
    }
  }
  const double radius_m = std::max(5.0, 0.5 * (view.X_WC_predicted.p - plane.p_WS).norm());
  const double common_m =
      MedianHeightAbovePlane(view.camera, view.X_WC_predicted, plane, view.range, grid, radius_m)
          .value_or(0.0);
  ImageU8 mask(width, height);
  for (const Eigen::Vector2d& pixel : grid) {
    const bool is_free = std::none_of(taken.begin(), taken.end(), [&](const auto& other) {
      return (other - pixel).norm() < kSpacing_px;
    });
    if (!is_free || !InPicture(view.camera, pixel, kBorder_px) ||
        !PlaceLandmark(view.camera, view.X_WC_predicted, plane, view.range, pixel, radius_m,
                       common_m)) {
      continue;
    }
    const int left = static_cast<int>(pixel.x() - corner.x());
    const int top = static_cast<int>(pixel.y() - corner.y());
    for (int y = top; y < std::min(top + kMaskStep_px, height); ++y) {
      std::fill(mask.row(y) + left, mask.row(y) + std::min(left + kMaskStep_px, width), 1);
    }
  }
  TemplateSelectionOptions options;
  options.template_px = FeatureSide(view.settings);
  options.search_px = kSearch_px;
  options.max_count = count;
  options.spacing_px = kSpacing_px;
  options.max_tried = kTriedForEach * count;
  std::vector<Eigen::Vector2d> pixels;
  for (const TemplateFeature& feature : SelectTemplates(window.picture, options, mask)) {
    pixels.emplace_back(corner + feature.pixel);
  }
  return pixels;
}

}  // namespace palace
