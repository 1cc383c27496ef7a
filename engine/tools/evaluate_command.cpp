#include "engine/tools/evaluate_command.h"

#include <vector>

#include <CLI/CLI.hpp>

#include "engine/experiments/evaluate_calibration.h"
#include "engine/experiments/evaluate_families.h"
#include "engine/experiments/evaluate_faults.h"
#include "engine/experiments/evaluate_ground.h"
#include "engine/experiments/evaluate_heading.h"
#include "engine/experiments/evaluate_image_time.h"
#include "engine/experiments/evaluate_landing.h"
#include "engine/experiments/evaluate_occlusion.h"
#include "engine/experiments/evaluate_position_estimate.h"
#include "engine/experiments/evaluate_probability.h"
#include "engine/experiments/evaluate_search.h"
#include "engine/experiments/evaluate_site_flags.h"
#include "engine/experiments/evaluate_site_lidar.h"
#include "engine/experiments/evaluate_site_range.h"
#include "engine/experiments/evaluate_site_shapes.h"
#include "engine/experiments/evaluate_site_views.h"
#include "engine/experiments/evaluate_stereo.h"
#include "engine/experiments/evaluate_things.h"
#include "engine/experiments/evaluate_trackers.h"
#include "engine/experiments/evaluate_velocity_estimate.h"
#include "engine/experiments/experiment.h"
#include "engine/tools/evaluate_plan.h"
#include "engine/tools/evaluate_thesis.h"

namespace palace {

void AddEvaluateCommand(CLI::App& app, int& exit_code, SceneCameraFactory camera) {
  CLI::App* evaluate = app.add_subcommand(
      "evaluate",
      "Experiments with seeds and intervals. Ctrl-C, SIGTERM and SIGHUP end "
      "one and give up the trial in hand: the trials done are reported and, with --out, "
      "written; those of a shard are not, only whole ones can be merged. --resume "
      "goes on. Exit 128 + signal");
  evaluate->require_subcommand(1);
  const std::vector<Experiment> experiments = {LandingExperiment(camera),
                                               FamiliesExperiment(camera),
                                               SearchExperiment(camera),
                                               FaultsExperiment(camera),
                                               ImageTimeExperiment(camera),
                                               VelocityEstimateExperiment(camera),
                                               PositionEstimateExperiment(std::move(camera)),
                                               StereoAccuracyExperiment(),
                                               StereoCostExperiment(),
                                               CalibrationExperiment(),
                                               GroundExperiment(),
                                               ProbabilityExperiment(),
                                               ThingsExperiment(),
                                               SiteFlagsExperiment(),
                                               SiteLidarExperiment(),
                                               SiteRangeExperiment(),
                                               SiteShapesExperiment(),
                                               SiteViewsExperiment(),
                                               HeadingExperiment(),
                                               TrackersExperiment(),
                                               TrackerCostExperiment(),
                                               OcclusionExperiment()};
  AddExperiments(*evaluate, experiments, exit_code);
  AddEvaluatePlan(*evaluate, experiments, exit_code);
  AddEvaluateThesis(*evaluate, experiments, exit_code);
}

}  // namespace palace
