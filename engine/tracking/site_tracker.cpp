#include "engine/tracking/site_tracker.h"

#include "engine/tracking/plane_tracker.h"
#include "engine/tracking/template_tracker.h"

namespace palace {

SiteTracker::SiteTracker() = default;
SiteTracker::~SiteTracker() = default;
SiteTracker::SiteTracker(SiteTracker&&) noexcept = default;
SiteTracker& SiteTracker::operator=(SiteTracker&&) noexcept = default;

void SiteTracker::Reset() {
  plane_.reset();
  template_.reset();
}

bool SiteTracker::anchored() const {
  return (plane_ && plane_->anchored()) || (template_ && template_->anchored());
}

bool SiteTracker::locked() const {
  return (plane_ && plane_->locked()) || (template_ && template_->locked());
}

void SiteTracker::Lock(const ImageU8& left, const PinholeCamera& camera, const RigidTransform& X_WC,
                       const RangeMap* range, const LandingSite& site,
                       const TrackingSettings& settings, Timestamp) {
  Reset();
  PALACE_CHECK(left.width() == camera.width && left.height() == camera.height, left.width(),
               left.height(), camera.width, camera.height);
  if (settings.mode == TrackerMode::kTemplate) {
    template_ = std::make_unique<TemplateTracker>();
    template_->Lock(left, camera, X_WC, site, settings);
  } else {
    plane_ = std::make_unique<PlaneTracker>();
    plane_->Lock(left, camera, X_WC, range, site, settings);
  }
}

TrackResult SiteTracker::Track(const ImageU8& left, const PinholeCamera& camera,
                               const RigidTransform& X_WC_predicted, const RangeMap* range,
                               const TrackingSettings& settings, Timestamp time) {
  PALACE_CHECK(left.width() == camera.width && left.height() == camera.height, left.width(),
               left.height(), camera.width, camera.height);
  if (plane_) {
    return plane_->Track(left, camera, X_WC_predicted, range, settings, time);
  }
  if (template_) {
    return template_->Track(left, camera, X_WC_predicted, settings, time);
  }
  TrackResult result;
  result.time = time;
  result.status.time = time;
  result.status.mode = settings.mode == TrackerMode::kPlane ? "Plane" : "Template";
  return result;
}

}  // namespace palace
