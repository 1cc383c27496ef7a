#include "engine/tools/evaluate_command.h"

#include <CLI/CLI.hpp>

#include "engine/tools/evaluate_calibration.h"
#include "engine/tools/evaluate_landing.h"
#include "engine/tools/evaluate_probability.h"
#include "engine/tools/evaluate_site_flags.h"
#include "engine/tools/evaluate_site_lidar.h"
#include "engine/tools/evaluate_site_range.h"
#include "engine/tools/evaluate_site_shapes.h"
#include "engine/tools/evaluate_site_views.h"
#include "engine/tools/evaluate_stereo.h"
#include "engine/tools/experiment.h"

namespace palace {

void AddEvaluateCommand(CLI::App& app, int& exit_code, SceneCameraFactory camera) {
  CLI::App* evaluate = app.add_subcommand("evaluate", "Experiments with seeds and intervals");
  evaluate->require_subcommand(1);
  AddExperiments(
      *evaluate,
      {LandingExperiment(std::move(camera)), StereoAccuracyExperiment(), StereoCostExperiment(),
       CalibrationExperiment(), ProbabilityExperiment(), SiteFlagsExperiment(),
       SiteLidarExperiment(), SiteRangeExperiment(), SiteShapesExperiment(), SiteViewsExperiment()},
      exit_code);
}

}  // namespace palace
