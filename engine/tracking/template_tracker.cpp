#include "engine/tracking/template_tracker.h"

#include <utility>

#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"
#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/tracking/coherence.h"
#include "engine/tracking/landmark_placement.h"
#include "engine/tracking/picture_part.h"
#include "engine/tracking/template_match.h"
#include "engine/tracking/view_geometry.h"

namespace palace {
namespace {

constexpr int kMaxMissed = 10;
constexpr double kSigma_px = 0.5;

ImageU8 Resized(const ImageU8& picture) {
  ImageU8 patch(kPatchSide_px, kPatchSide_px);
  cv::Mat out = GreyView(patch);
  cv::resize(GreyView(picture), out, out.size(), 0, 0, cv::INTER_LINEAR);
  return patch;
}

}  // namespace

void TemplateTracker::Lock(const ImageU8& left, const PinholeCamera& camera,
                           const RigidTransform& X_WC, const LandingSite& site,
                           const TrackingSettings& settings) {
  const auto pixel = PixelFromWorldPoint(camera, X_WC, site.p_WS);
  if (pixel) {
    LockAt(*pixel, left, camera, X_WC, site, settings);
  } else {
    *this = TemplateTracker();
  }
}

void TemplateTracker::LockAt(const Eigen::Vector2d& pixel, const ImageU8& left,
                             const PinholeCamera& camera, const RigidTransform& X_WC,
                             const LandingSite& site, const TrackingSettings& settings) {
  *this = TemplateTracker();
  p_WS_ = site.p_WS;
  if (!InPicture(camera, pixel, settings.template_size_px / 2.0)) {
    return;
  }
  pixel_ = pixel;
  predicted_pixel_ = PixelFromWorldPoint(camera, X_WC, p_WS_).value_or(pixel);
  template_ = CutSquare(left, pixel_, settings.template_size_px);
  anchor_height_m_ = HeightFromDown(X_WC.p.z() - p_WS_.z());
  place_sigma_m_ = kPlaceSigmaPerDepth * (X_WC.p - p_WS_).norm();
  locked_ = true;
}

TrackResult TemplateTracker::Track(const ImageU8& left, const PinholeCamera& camera,
                                   const RigidTransform& X_WC_predicted,
                                   const TrackingSettings& settings, Timestamp time) {
  TrackResult result;
  result.time = time;
  result.status.time = time;
  result.status.mode = "Template";
  if (!locked_) {
    result.status.why_not_locked =
        anchored() ? why_lost_ : "the site is too near to the picture's rim for a template";
    return result;
  }
  const Eigen::Vector2d predicted =
      PixelFromWorldPoint(camera, X_WC_predicted, p_WS_).value_or(predicted_pixel_);
  const Eigen::Vector2d centre = pixel_ + predicted - predicted_pixel_;
  const int side = template_.width();
  const int window_side = side + 2 * settings.search_radius_px;
  const ImageU8 window = CutSquare(left, centre, window_side);
  const TemplateMatch match = MatchTemplate(window, template_);
  const Eigen::Vector2d found =
      centre + match.between - Eigen::Vector2d::Constant(settings.search_radius_px);
  const bool good = match.score >= settings.min_coherence && InPicture(camera, found, 1);
  // Not seen: coast on the predicted motion.
  pixel_ = good ? found : centre;
  predicted_pixel_ = predicted;
  frames_missed_ = good ? 0 : frames_missed_ + 1;
  locked_ = frames_missed_ <= kMaxMissed && InPicture(camera, pixel_, 0);

  ImageU8 current = CutSquare(left, pixel_, side);
  const PatchComparison patches = ComparePatches(Resized(template_), Resized(current));
  result.status.locked = locked_ && good;
  if (!result.status.locked) {
    why_lost_ = match.score < settings.min_coherence
                    ? WithNumbers("match %.2f, min %.2f",
                                  ShownBeyond(match.score, settings.min_coherence, 2),
                                  settings.min_coherence)
                    : "the site has left the picture";
    result.status.why_not_locked = why_lost_;
  }
  result.status.coherence = match.score;
  result.status.site_pixel = pixel_;
  result.status.site_in_picture = InPicture(camera, pixel_, 0);
  result.status.features = {{pixel_, good}};
  result.status.window_centre = centre;
  result.status.window_side_px = window_side;
  result.status.inliers = good ? 1 : 0;
  result.status.keyframes = 1;
  result.status.anchor_patch = patches.anchor;
  result.status.current_patch = patches.current;
  result.status.difference_patch = patches.difference;
  result.status.anchor_height_m = anchor_height_m_;
  if (good) {
    result.landmarks.push_back({p_WS_, pixel_, kSigma_px, place_sigma_m_});
    template_ = std::move(current);
    anchor_height_m_ = HeightFromDown(X_WC_predicted.p.z() - p_WS_.z());
  }
  return result;
}

}  // namespace palace
