#include "engine/tracking/site_tracker.h"

#include "engine/tracking/site_view.h"
#include "engine/tracking/tracker_set.h"

namespace palace {

SiteTracker::SiteTracker() = default;
SiteTracker::~SiteTracker() = default;
SiteTracker::SiteTracker(SiteTracker&&) noexcept = default;
SiteTracker& SiteTracker::operator=(SiteTracker&&) noexcept = default;

void SiteTracker::Reset() { set_.reset(); }

bool SiteTracker::anchored() const { return set_ && set_->anchored(); }

bool SiteTracker::locked() const { return set_ && set_->locked(); }

void SiteTracker::Lock(const ImageU8& left, const PinholeCamera& camera, const RigidTransform& X_WC,
                       const RangeMap* range, const LandingSite& site,
                       const TrackingSettings& settings, Timestamp time) {
  PALACE_CHECK(left.width() == camera.width && left.height() == camera.height, left.width(),
               left.height(), camera.width, camera.height);
  set_ = std::make_unique<TrackerSet>(SiteView{left, camera, X_WC, range, settings, time}, site);
}

TrackResult SiteTracker::Track(const ImageU8& left, const PinholeCamera& camera,
                               const RigidTransform& X_WC_predicted, const RangeMap* range,
                               const TrackingSettings& settings, Timestamp time) {
  PALACE_CHECK(left.width() == camera.width && left.height() == camera.height, left.width(),
               left.height(), camera.width, camera.height);
  if (set_) {
    return set_->Track({left, camera, X_WC_predicted, range, settings, time});
  }
  TrackResult result;
  result.time = time;
  result.status.time = time;
  result.status.mode = settings.mode == TrackerMode::kPlane ? "Plane" : "Template";
  return result;
}

TrackerSetStatus SiteTracker::Coast(const PinholeCamera& camera,
                                    const RigidTransform& X_WC_predicted,
                                    const TrackingSettings& settings, const std::string& why,
                                    Timestamp time) {
  return set_ ? set_->Coast(camera, X_WC_predicted, settings, why, time) : TrackerSetStatus{};
}

}  // namespace palace
