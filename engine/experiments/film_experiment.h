// What `palacectl evaluate` is told of an experiment that follows a point over the films of
// film_ground.h: one film's ground a trial, and the options of that ground.
#pragma once

#include <functional>

#include "engine/experiments/experiment.h"
#include "engine/experiments/film_ground.h"

namespace palace {

/// One trial over its ground.
using FilmTrial =
    std::function<std::vector<TrialRow>(const FilmGround& ground, std::uint64_t seed)>;

/// `experiment` with options, setup and trials. Films of fewer than `fewest_pictures` are refused
/// as a usage error.
Experiment FilmExperiment(Experiment experiment, const FilmGroundOptions& defaults,
                          int fewest_pictures, const FilmTrial& run);

}  // namespace palace
