#include "engine/tracking/landmark_placement.h"

#include <algorithm>
#include <cmath>

#include "engine/core/median.h"

namespace palace {
namespace {

constexpr int kMinRanges = 10;
constexpr double kPlaneSigma_m = 0.10;   // real ground about its fitted plane
constexpr double kMaxOffPlane_m = 0.30;  // a rock is no landmark of the plane

struct Measured {
  double depth_m = 0;
  double sigma_m = 0;
};

std::optional<Measured> RangeAt(const RangeMap* range, const Eigen::Vector2d& pixel) {
  if (range == nullptr || range->depth_m.empty()) {
    return std::nullopt;
  }
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  if (!range->depth_m.Contains(x, y)) {
    return std::nullopt;
  }
  const double depth_m = range->depth_m.at(x, y);
  const double sigma_m =
      range->depth_sigma_m.Contains(x, y) ? double{range->depth_sigma_m.at(x, y)} : 0.0;
  if (!std::isfinite(depth_m) || depth_m <= 0 || !std::isfinite(sigma_m)) {
    return std::nullopt;
  }
  return Measured{depth_m, std::max(sigma_m, 1e-3)};
}

/// Horizontal and vertical distance from the site within the radius.
bool NearSite(const GroundPlane& plane, const Eigen::Vector3d& p_W, double radius_m) {
  return (p_W - plane.p_WS).norm() <= radius_m;
}

}  // namespace

std::optional<double> MedianHeightAbovePlane(const PinholeCamera& camera,
                                             const RigidTransform& X_WC, const GroundPlane& plane,
                                             const RangeMap* range,
                                             const std::vector<Eigen::Vector2d>& pixels,
                                             double radius_m) {
  std::vector<double> heights_m;
  for (const Eigen::Vector2d& pixel : pixels) {
    const auto measured = RangeAt(range, pixel);
    if (!measured) {
      continue;
    }
    const Eigen::Vector3d p_W = X_WC * (measured->depth_m * RayFromPixel(camera, pixel));
    if (NearSite(plane, p_W, radius_m)) {
      heights_m.push_back(plane.HeightOf(p_W));
    }
  }
  if (heights_m.size() < static_cast<std::size_t>(kMinRanges)) {
    return std::nullopt;
  }
  return UpperMedian(heights_m);
}

std::optional<PlacedLandmark> PlaceLandmark(const PinholeCamera& camera, const RigidTransform& X_WC,
                                            const GroundPlane& plane, const RangeMap* range,
                                            const Eigen::Vector2d& pixel, double radius_m,
                                            double common_height_m) {
  const std::optional<double> plane_depth_m = PlaneDepth(camera, X_WC, plane, pixel);
  if (!plane_depth_m) {
    return std::nullopt;
  }
  const Eigen::Vector3d ray_C = RayFromPixel(camera, pixel);
  double depth_m = *plane_depth_m;
  if (const auto measured = RangeAt(range, pixel)) {
    const double fall = std::abs(plane.normal_W.dot(X_WC.R * ray_C));  // height per depth
    const double off_plane_m = plane.HeightOf(X_WC * (measured->depth_m * ray_C)) - common_height_m;
    const double sigma_off_m = fall * measured->sigma_m;
    if (std::abs(off_plane_m) > std::max(kMaxOffPlane_m, 3 * sigma_off_m)) {
      return std::nullopt;
    }
    const double share =
        kPlaneSigma_m * kPlaneSigma_m / (kPlaneSigma_m * kPlaneSigma_m + sigma_off_m * sigma_off_m);
    depth_m -= share * off_plane_m / fall;
  }
  PlacedLandmark placed;
  placed.pixel = pixel;
  placed.p_WF = X_WC * (depth_m * ray_C);
  placed.sigma_w_m = kPlaceSigmaPerDepth * depth_m;
  if (!NearSite(plane, placed.p_WF, radius_m)) {
    return std::nullopt;
  }
  return placed;
}

}  // namespace palace
