#include "engine/experiments/film_experiment.h"

#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

namespace palace {

Experiment FilmExperiment(Experiment experiment, const FilmGroundOptions& defaults,
                          int fewest_pictures, const FilmTrial& run) {
  auto options = std::make_shared<FilmGroundOptions>(defaults);
  experiment.add_options = [options, fewest_pictures](CLI::App& verb) {
    AddFilmGroundOptions(verb, *options, fewest_pictures);
  };
  experiment.setup = [options] { return SetupOf(*options); };
  experiment.run = [options, run](int trial, std::uint64_t seed) -> Result<std::vector<TrialRow>> {
    const Result<FilmGround> ground = GroundOfTrial(*options, trial, seed);
    if (!ground) {
      return ground.error();
    }
    return run(*ground, seed);
  };
  return experiment;
}

}  // namespace palace
