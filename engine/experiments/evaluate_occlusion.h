// palacectl evaluate occlusion: a bird, a hand, a shadow, half a second of black, on a descent and
// in a hover. What is told, how soon, and whether a wrong place is told as good meanwhile.
#pragma once

#include <vector>

#include "engine/experiments/evaluate_trackers.h"
#include "engine/experiments/experiment.h"

namespace palace {

/// What became of one track that was struck.
struct Occlusion {
  double error_before_px = NAN;  ///< of the picture before
  bool right_before = false;     ///< told as good, and at most kFinalTrack_px wrong
  int told_after = -1;           ///< pictures from the first one struck to LOST; -1: not told while
                                 ///< it lasted, nor within half a second after
  int wrong_as_good = 0;         ///< pictures from the first one struck to the film's end that are
                                 ///< beyond kFinalTrack_px and told as good
  double worst_as_good_px = 0;   ///< the largest error of those told as good since then
  int found_after = -1;          ///< pictures from the first clear one to one told as good and
                                 ///< right; -1: never
  double error_after_px = NAN;   ///< one second after the first clear picture
  bool good_after = false;       ///< told as good then
  double error_end_px = NAN;     ///< of the last picture
  int longest_told_lost = 0;     ///< pictures in a row, since the first one struck
};
/// `first` is the first picture that is struck, `clear` the first one after. The film goes on for a
/// second at least.
Occlusion JudgeOcclusion(const FollowedFilm& film, int first, int clear);

/// Trial i: the ground of film_ground.h, a descent and a hover over it, and each struck by all of
/// occluder.h (and by nothing, to compare with); rows: one a flight, occluder and method of ours.
Experiment OcclusionExperiment(const FilmGroundOptions& defaults = {});

}  // namespace palace
