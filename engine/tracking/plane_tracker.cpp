#include "engine/tracking/plane_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/text.h"
#include "engine/tracking/anchor_zoom.h"
#include "engine/tracking/camera_resection.h"
#include "engine/tracking/coherence.h"
#include "engine/tracking/feature_selection.h"
#include "engine/tracking/keyframe_flow.h"
#include "engine/tracking/landmark_placement.h"

namespace palace {
namespace {

constexpr int kMinInliers = 6;
constexpr int kFewInliers = 12;
constexpr double kMinInlierShare = 0.35;  // of the landmarks that should be visible
constexpr double kSigma_px = 0.3;
constexpr int kMaxOutlierFrames = 5;
constexpr double kMaxHeightCorrection_m = 2.0;
constexpr double kSearchCoherence = 0.6;
constexpr int kMaxSearchRadius_px = 128;
constexpr std::size_t kEarlierKeyframes = 4;

/// Ground that counts as around the site: what the picture shows of it, from far and from near.
double LandmarkRadius(const GroundPlane& plane, const Eigen::Vector3d& p_WC) {
  return std::max(5.0, 0.5 * (p_WC - plane.p_WS).norm());
}

/// Room enough for max_count features in the picture.
double Spacing(const PinholeCamera& camera, int max_count) {
  const double area = static_cast<double>(camera.width) * camera.height;
  return std::clamp(0.6 * std::sqrt(area / std::max(max_count, 1)), 8.0, 40.0);
}

}  // namespace

void PlaneTracker::Lock(const ImageU8& left, const PinholeCamera& camera,
                        const RigidTransform& X_WC, const RangeMap* range, const LandingSite& site,
                        const TrackingSettings& settings) {
  *this = PlaneTracker();
  plane_ = {site.p_WS, site.normal_W.normalized()};
  RigidTransform X_WK = X_WC;
  const std::vector<Eigen::Vector2d> candidates = SelectFeatures(left, {}, {400, 16, 14});
  const auto above_m = MedianHeightAbovePlane(camera, X_WC, plane_, range, candidates,
                                              LandmarkRadius(plane_, X_WC.p));
  if (above_m && std::abs(*above_m) <= kMaxHeightCorrection_m) {
    // The ranges are measured now, the site's place was estimated then: what differs is the drift
    // of the estimate in between, and the site's place is what W means from here on.
    X_WK.p -= *above_m * plane_.normal_W;
  }
  correction_p_W_ = X_WK.p - X_WC.p;
  CutKeyframe(left, camera, X_WK, range, settings, {});
  locked_ = anchored();
}

bool PlaneTracker::anchored() const {
  return key_.landmarks.size() >= static_cast<std::size_t>(kMinInliers);
}

void PlaneTracker::CutKeyframe(const ImageU8& left, const PinholeCamera& camera,
                               const RigidTransform& X_WC, const RangeMap* range,
                               const TrackingSettings& settings, std::vector<Landmark> kept) {
  if (keyframes_ > 0) {
    earlier_.push_back(std::move(key_));
  }
  if (earlier_.size() > kEarlierKeyframes) {
    earlier_.pop_front();
  }
  key_ = {left, X_WC, std::move(kept)};
  AddLandmarks(camera, range, settings);
  key_.landmarks_when_cut = key_.landmarks.size();
  ++keyframes_;
}

void PlaneTracker::AddLandmarks(const PinholeCamera& camera, const RangeMap* range,
                                const TrackingSettings& settings) {
  const int wanted = settings.max_features - static_cast<int>(key_.landmarks.size());
  if (wanted <= 0) {
    return;
  }
  std::vector<Eigen::Vector2d> taken;
  for (const Landmark& landmark : key_.landmarks) {
    taken.push_back(landmark.key_pixel);
  }
  FeatureSelectionOptions options;
  options.max_count = 3 * wanted;  // many lie off the plane or away from the site
  options.spacing_px = Spacing(camera, settings.max_features);
  const double radius_m = LandmarkRadius(plane_, key_.X_WC.p);
  const std::vector<Eigen::Vector2d> pixels = SelectFeatures(key_.picture, taken, options);
  const double common_m =
      MedianHeightAbovePlane(camera, key_.X_WC, plane_, range, pixels, radius_m).value_or(0.0);
  for (const Eigen::Vector2d& pixel : pixels) {
    if (static_cast<int>(key_.landmarks.size()) >= settings.max_features) {
      break;
    }
    if (const auto placed =
            PlaceLandmark(camera, key_.X_WC, plane_, range, pixel, radius_m, common_m)) {
      key_.landmarks.push_back({placed->p_WF, placed->pixel, placed->sigma_w_m, 0});
    }
  }
}

PlaneTracker::Attempt PlaneTracker::Try(const ImageU8& left, const PinholeCamera& camera,
                                        const RigidTransform& X_WC, const Eigen::Matrix3d& R_prior,
                                        const Eigen::Vector2d& shift_px) const {
  Attempt attempt;
  attempt.X_WC = X_WC;
  attempt.visible.assign(key_.landmarks.size(), false);
  attempt.inlier.assign(key_.landmarks.size(), false);
  attempt.pixels.assign(key_.landmarks.size(), Eigen::Vector2d::Zero());
  const auto current_from_key = PlaneHomography(camera, key_.X_WC, X_WC, plane_);
  if (!current_from_key || plane_.HeightOf(X_WC.p) <= 0.1) {
    return attempt;
  }
  std::vector<Eigen::Vector2d> key_pixels;
  for (const Landmark& landmark : key_.landmarks) {
    key_pixels.push_back(landmark.key_pixel);
  }
  KeyframeFlowOptions options;
  options.shift_px = shift_px;
  const std::vector<FlowPoint> points =
      FollowFromKeyframe(key_.picture, left, *current_from_key, key_pixels, options);
  for (std::size_t i = 0; i < points.size(); ++i) {
    attempt.pixels[i] = points[i].pixel;
    attempt.visible[i] = points[i].visible;
    attempt.inlier[i] = points[i].agrees;
    attempt.visible_count += points[i].visible ? 1 : 0;
    attempt.inliers += points[i].agrees ? 1 : 0;
  }
  if (attempt.inliers >= kMinInliers) {
    Resect(camera, R_prior, attempt);
  }
  return attempt;
}

void PlaneTracker::Resect(const PinholeCamera& camera, const Eigen::Matrix3d& R_prior,
                          Attempt& attempt) const {
  std::vector<GroundLandmark> seen;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < key_.landmarks.size(); ++i) {
    if (attempt.inlier[i]) {
      // What their places err by is common to them, no scatter: as such it would leave the attitude
      // to the told one, the more the nearer, and its noise would turn each new keyframe's ground.
      seen.push_back({key_.landmarks[i].p_WF, attempt.pixels[i], kSigma_px, 0});
      index.push_back(i);
    }
  }
  const Result<Resection> resection = ResectCamera(seen, camera, R_prior);
  if (!resection || plane_.HeightOf(resection->X_WC.p) <= 0.1) {
    return;
  }
  for (std::size_t i = 0; i < index.size(); ++i) {
    attempt.inlier[index[i]] = resection->inlier[i];
  }
  attempt.inliers = resection->inliers;
  attempt.rms_px = resection->rms_px;
  attempt.ok =
      attempt.inliers >= kMinInliers && attempt.inliers >= kMinInlierShare * attempt.visible_count;
  if (attempt.ok) {
    attempt.X_WC = resection->X_WC;
  }
}

PlaneTracker::Attempt PlaneTracker::BestAttempt(const ImageU8& left, const PinholeCamera& camera,
                                                const RigidTransform& X_WC_predicted,
                                                const TrackingSettings& settings) const {
  const RigidTransform corrected = Corrected(X_WC_predicted);
  Attempt attempt = Try(left, camera, corrected, X_WC_predicted.R, Eigen::Vector2d::Zero());
  if (attempt.ok) {
    return attempt;
  }
  // The estimate in force may have stepped onto vision: then the plain prediction is right.
  const bool differs = (X_WC_predicted.p - corrected.p).norm() > 1e-3;
  if (differs) {
    Attempt plain = Try(left, camera, X_WC_predicted, X_WC_predicted.R, Eigen::Vector2d::Zero());
    if (plain.ok) {
      return plain;
    }
  }
  for (const RigidTransform& X_WC : {corrected, X_WC_predicted}) {
    const auto key_from_current = PlaneHomography(camera, X_WC, key_.X_WC, plane_);
    if (!key_from_current) {
      continue;
    }
    const int radius_px =
        std::min(settings.search_radius_px * (2 + frames_lost_), kMaxSearchRadius_px);
    Attempt where;
    where.X_WC = X_WC;
    const PatchSearch search =
        SearchPatch(key_.picture, left, *key_from_current, PatchCentre(camera, where), radius_px);
    if (search.coherence >= kSearchCoherence) {
      Attempt found = Try(left, camera, X_WC, X_WC_predicted.R, search.shift_px);
      if (found.ok) {
        return found;
      }
    }
    if (!differs) {
      break;
    }
  }
  return attempt;
}

PlaneTracker::Attempt PlaneTracker::TryEarlier(const ImageU8& left, const PinholeCamera& camera,
                                               const RigidTransform& X_WC_predicted) {
  Attempt attempt;
  if (earlier_.empty()) {
    return attempt;
  }
  const auto turn = static_cast<std::size_t>(frames_lost_) % earlier_.size();
  const auto earlier = earlier_.end() - 1 - static_cast<std::ptrdiff_t>(turn);
  std::swap(key_, *earlier);
  attempt = Try(left, camera, Corrected(X_WC_predicted), X_WC_predicted.R, Eigen::Vector2d::Zero());
  if (attempt.ok) {
    earlier_.erase(earlier, earlier_.end());
  } else {
    std::swap(key_, *earlier);
  }
  return attempt;
}

Eigen::Vector2d PlaneTracker::PatchCentre(const PinholeCamera& camera,
                                          const Attempt& attempt) const {
  const double margin_px =
      std::min({kPatchSide_px / 2.0, camera.width / 2.0 - 1, camera.height / 2.0 - 1});
  const auto site = PixelFromWorldPoint(camera, attempt.X_WC, plane_.p_WS);
  const Eigen::Vector2d middle(0.5 * (camera.width - 1), 0.5 * (camera.height - 1));
  Eigen::Vector2d centre = middle;
  if (site && InPicture(camera, *site, 0)) {
    centre = *site;
  } else if (attempt.ok) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < attempt.pixels.size(); ++i) {
      sum += attempt.inlier[i] ? attempt.pixels[i] : Eigen::Vector2d::Zero();
    }
    centre = sum / attempt.inliers;
  } else {
    Eigen::Vector3d mean_W = Eigen::Vector3d::Zero();
    for (const Landmark& landmark : key_.landmarks) {
      mean_W += landmark.p_WF / static_cast<double>(key_.landmarks.size());
    }
    centre = PixelFromWorldPoint(camera, attempt.X_WC, mean_W).value_or(middle);
  }
  return {std::clamp(centre.x(), margin_px, camera.width - 1 - margin_px),
          std::clamp(centre.y(), margin_px, camera.height - 1 - margin_px)};
}

double PlaneTracker::MeanDistance(const Eigen::Vector3d& p_WC) const {
  double sum_m = 0;
  for (const Landmark& landmark : key_.landmarks) {
    sum_m += (landmark.p_WF - p_WC).norm();
  }
  return sum_m / static_cast<double>(std::max<std::size_t>(key_.landmarks.size(), 1));
}

bool PlaneTracker::NeedsKeyframe(const Attempt& attempt, double coherence,
                                 const TrackingSettings& settings) const {
  const double scale = MeanDistance(key_.X_WC.p) / std::max(MeanDistance(attempt.X_WC.p), 1e-3);
  const double zoom = std::max(scale, 1 / scale);
  const bool few = attempt.inliers < kFewInliers;
  if (coherence < settings.min_coherence) {
    // Only when waiting would lose the ground altogether, and most of what is visible agrees.
    return (zoom > kForcedAnchorZoom || few) && attempt.inliers >= 0.6 * attempt.visible_count;
  }
  return zoom > kNewAnchorZoom || few ||
         2 * static_cast<std::size_t>(attempt.inliers) < key_.landmarks_when_cut;
}

void PlaneTracker::NoteOutliers(const Attempt& attempt) {
  for (std::size_t i = 0; i < key_.landmarks.size(); ++i) {
    int& frames = key_.landmarks[i].outlier_frames;
    frames = attempt.visible[i] && !attempt.inlier[i] ? frames + 1 : 0;
  }
}

std::string PlaneTracker::WhyNotLocked(const Attempt& attempt) {
  if (attempt.ok) {
    return {};
  }
  const double found = attempt.inliers, visible = attempt.visible_count;
  return found < kMinInliers ? WithNumbers("%.0f of %.0f features found again, min %.0f", found,
                                           visible, kMinInliers)
         : found < kMinInlierShare * visible
             ? WithNumbers("%.0f of %.0f features agree, min %.0f %%", found, visible,
                           100 * kMinInlierShare)
             : WithNumbers("%.0f features fit no pose of the camera", found);
}

TrackerStatus PlaneTracker::Describe(const ImageU8& left, const PinholeCamera& camera,
                                     const Attempt& attempt, const TrackingSettings& settings,
                                     Timestamp time) const {
  TrackerStatus status;
  status.time = time;
  status.locked = attempt.ok;
  status.why_not_locked = WhyNotLocked(attempt);
  status.mode = "Plane";
  status.keyframes = keyframes_;
  status.anchor_height_m = plane_.HeightOf(key_.X_WC.p);
  status.inliers = attempt.ok ? attempt.inliers : 0;
  const auto site = PixelFromWorldPoint(camera, attempt.X_WC, plane_.p_WS);
  status.site_pixel = site.value_or(Eigen::Vector2d(-1e4, -1e4));
  status.site_in_picture = site && InPicture(camera, *site, 0);
  for (std::size_t i = 0; i < attempt.pixels.size(); ++i) {
    if (attempt.visible[i]) {
      status.features.push_back({attempt.pixels[i], attempt.ok && attempt.inlier[i]});
    }
  }
  const Eigen::Vector2d centre = PatchCentre(camera, attempt);
  status.window_centre = centre;
  status.window_side_px = kPatchSide_px + 2.0 * settings.search_radius_px;
  if (const auto key_from_current = PlaneHomography(camera, attempt.X_WC, key_.X_WC, plane_)) {
    const PatchComparison patches = ComparePatches(key_.picture, left, *key_from_current, centre);
    status.coherence = patches.coherence;
    status.anchor_patch = patches.anchor;
    status.current_patch = patches.current;
    status.difference_patch = patches.difference;
  }
  return status;
}

TrackResult PlaneTracker::Track(const ImageU8& left, const PinholeCamera& camera,
                                const RigidTransform& X_WC_predicted, const RangeMap* range,
                                const TrackingSettings& settings, Timestamp time) {
  TrackResult result;
  result.time = time;
  const bool other_size =
      left.width() != key_.picture.width() || left.height() != key_.picture.height();
  if (other_size || !anchored()) {
    locked_ = false;
    result.status.time = time;
    result.status.why_not_locked =
        other_size ? "the picture has another size than its anchor"
                   : WithNumbers("%.0f features on the ground, min %.0f",
                                 static_cast<double>(key_.landmarks.size()), kMinInliers);
    result.status.mode = "Plane";
    return result;
  }
  Attempt attempt = BestAttempt(left, camera, X_WC_predicted, settings);
  if (!attempt.ok) {
    if (Attempt earlier = TryEarlier(left, camera, X_WC_predicted); earlier.ok) {
      attempt = std::move(earlier);
    }
  }
  result.status = Describe(left, camera, attempt, settings, time);
  locked_ = attempt.ok;
  if (!attempt.ok) {
    ++frames_lost_;
    return result;
  }
  frames_lost_ = 0;
  correction_p_W_ = attempt.X_WC.p - X_WC_predicted.p;
  correction_R_ = X_WC_predicted.R.transpose() * attempt.X_WC.R;
  NoteOutliers(attempt);
  std::vector<Landmark> inliers;
  for (std::size_t i = 0; i < key_.landmarks.size(); ++i) {
    if (attempt.inlier[i]) {
      const Landmark& mark = key_.landmarks[i];
      result.landmarks.push_back({mark.p_WF, attempt.pixels[i], kSigma_px, mark.sigma_w_m});
      inliers.push_back({mark.p_WF, attempt.pixels[i], mark.sigma_w_m, 0});
    }
  }
  if (NeedsKeyframe(attempt, result.status.coherence, settings)) {
    CutKeyframe(left, camera, attempt.X_WC, range, settings, std::move(inliers));
  } else if (result.status.coherence >= settings.min_coherence) {
    std::erase_if(key_.landmarks,
                  [](const Landmark& mark) { return mark.outlier_frames > kMaxOutlierFrames; });
  }
  return result;
}

}  // namespace palace
