#include "engine/experiments/point_methods.h"

#include <memory>
#include <utility>

#include "engine/core/time.h"
#include "engine/model/settings/settings.h"
#include "engine/tracking/feature_follower.h"
#include "engine/tracking/site_tracker.h"

namespace palace {
namespace {

using TrackPicture = std::function<TrackResult(const ImageU8& picture, int index)>;

TrackPicture StartSiteTracker(TrackerMode mode, const PointFilm& film, const ImageU8& first) {
  TrackingSettings settings;
  settings.mode = mode;
  LandingSite site;
  site.p_WS = film.believed_point();
  auto tracker = std::make_shared<SiteTracker>();
  tracker->Lock(first, film.camera(), film.Believed(0), nullptr, site, settings, {});
  return [tracker, &film, settings](const ImageU8& picture, int index) {
    return tracker->Track(picture, film.camera(), film.Believed(index), nullptr, settings,
                          AddSeconds({}, index / kFilmRate_hz));
  };
}

FollowPoint StartInForce(TrackerMode mode, const PointFilm& film, const ImageU8& first) {
  return [track = StartSiteTracker(mode, film, first), last = film.Truth(0)](const ImageU8& picture,
                                                                             int index) mutable {
    const TrackerStatus status = track(picture, index).status;
    // One that has given up names no place any more.
    last = status.locked || status.window_side_px > 0 ? status.site_pixel : last;
    return PointReading{last, status.locked, status.coherence};
  };
}

FollowPoint StartSet(const PointFilm& film, const ImageU8& first) {
  return [track = StartSiteTracker(TrackerMode::kPlane, film, first)](const ImageU8& picture,
                                                                      int index) {
    const TrackerConsensus consensus = track(picture, index).set.consensus;
    return PointReading{consensus.site_pixel, consensus.trusted};
  };
}

FollowPoint StartFollower(const Eigen::Vector2d& pixel, const ImageU8& first) {
  Result<FeatureFollower> started = FeatureFollower::Start(first, pixel, {});
  if (!started) {
    return [pixel](const ImageU8&, int) { return PointReading{pixel, false, 0}; };
  }
  auto follower = std::make_shared<FeatureFollower>(std::move(started).value());
  return [follower](const ImageU8& picture, int) {
    const FollowedFeature told = follower->Follow(picture);
    return PointReading{told.pixel, told.state != FollowState::kLost, told.coherence};
  };
}

}  // namespace

const char* NameOf(PointMethod method) {
  switch (method) {
    case PointMethod::kPlane:
      return "plane";
    case PointMethod::kTemplate:
      return "template";
    case PointMethod::kFollower:
      return "follower";
    case PointMethod::kSet:
      return "set";
    case PointMethod::kKlt:
      return "KLT";
    case PointMethod::kKcf:
      return "KCF";
    case PointMethod::kCsrt:
      return "CSRT";
    case PointMethod::kEcc:
      return "ECC";
  }
  return "";
}

FollowPoint StartFollowing(PointMethod method, const PointFilm& film, const ImageU8& first) {
  switch (method) {
    case PointMethod::kPlane:
      return StartInForce(TrackerMode::kPlane, film, first);
    case PointMethod::kTemplate:
      return StartInForce(TrackerMode::kTemplate, film, first);
    case PointMethod::kFollower:
      return StartFollower(film.Truth(0), first);
    case PointMethod::kSet:
      return StartSet(film, first);
    default:
      return StartPeer(method, first, film.Truth(0), TrackingSettings{}.min_coherence);
  }
}

}  // namespace palace
