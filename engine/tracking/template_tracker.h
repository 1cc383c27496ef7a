// TemplateTracker: the thesis's tracker (Hintze 2004, 3.1). One square template around the site,
// found again by normalised cross-correlation in a search window, refreshed every frame.
//
// Its score compares successive pictures and cannot see a slow drift (erratum E26); that is what
// PlaneTracker is for. Where we deviate: the search window is moved on by the predicted motion, so
// that attitude motion does not carry the site out of it, the match is refined to sub-pixel by a
// parabola, and a template below min_coherence is not taken over.
#pragma once

#include <string>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/time.h"
#include "engine/model/image.h"
#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"
#include "engine/tracking/site_tracker.h"

namespace palace {

class TemplateTracker {
 public:
  void Lock(const ImageU8& left, const PinholeCamera& camera, const RigidTransform& X_WC,
            const LandingSite& site, const TrackingSettings& settings);
  /// Where the site is known to lie in this picture, whatever is predicted.
  void LockAt(const Eigen::Vector2d& pixel, const ImageU8& left, const PinholeCamera& camera,
              const RigidTransform& X_WC, const LandingSite& site,
              const TrackingSettings& settings);
  bool anchored() const { return template_.width() > 0; }
  bool locked() const { return locked_; }
  /// The result's landmarks are the site alone.
  TrackResult Track(const ImageU8& left, const PinholeCamera& camera,
                    const RigidTransform& X_WC_predicted, const TrackingSettings& settings,
                    Timestamp time);

 private:
  ImageU8 template_;
  Eigen::Vector3d p_WS_ = Eigen::Vector3d::Zero();
  Eigen::Vector2d pixel_ = Eigen::Vector2d::Zero();            ///< last match
  Eigen::Vector2d predicted_pixel_ = Eigen::Vector2d::Zero();  ///< of the same frame
  double anchor_height_m_ = 0;
  double place_sigma_m_ = 0;  ///< of the ground in its middle, beside the site
  int frames_missed_ = 0;
  std::string why_lost_;  ///< of the last picture that it was not in
  bool locked_ = false;
};

}  // namespace palace
