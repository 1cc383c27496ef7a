// palacectl evaluate trackers: one point followed down a whole glide slope, ours beside OpenCV's.
#pragma once

#include <span>

#include "engine/experiments/experiment.h"
#include "engine/experiments/film_ground.h"

namespace palace {

/// Beyond it a track is lost, as reference vision.md 4 counts.
inline constexpr double kLostTrack_px = 15;
/// What a track may be wrong by at the end: 4 cm on the ground, from 4 m.
inline constexpr double kFinalTrack_px = 5;

/// Every picture of one film, as one method followed it.
struct FollowedFilm {
  std::vector<double> error_px;  ///< of the told place
  std::vector<bool> followed;    ///< told as good
  double coherence_end = NAN;
};
/// The first picture whose error is beyond kLostTrack_px; -1: none.
int FirstLost(const FollowedFilm& film);
/// Pictures beyond it that were told as good: the loss is not seen.
int UnseenLosses(const FollowedFilm& film);

/// Descents of point_film.h over the grounds of film_ground.h, followed by all of point_methods.h.
/// Trial i: one film; rows: one a method. Only ours is judged: never lost, at most 5 px at the end.
Experiment TrackersExperiment(const FilmGroundOptions& defaults = {});

/// `evaluate tracker-cost`: milliseconds of the processor a picture of each, on one thread. They
/// depend on the machine, so they are no part of the table above. Judged are the plane tracker
/// alone and the set of all that a SiteTracker runs on every picture, each against its budget.
Experiment TrackerCostExperiment(const FilmGroundOptions& defaults = {});

}  // namespace palace
