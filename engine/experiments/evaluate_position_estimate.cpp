#include "engine/experiments/evaluate_position_estimate.h"

#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/experiments/flight_options.h"
#include "engine/experiments/position_estimators.h"
#include "engine/experiments/position_rows.h"
#include "engine/stereo/range_measurement.h"
#include "engine/tracking/view_geometry.h"

namespace palace {
namespace {

struct PositionOptions {
  FlightOptions flight;
  double cone_height_m = 0.5;
};

/// Everything that looks at pictures of one size.
struct Onlookers {
  int rows = 0;
  std::unique_ptr<FeatureFollower> follower{};
  struct Run {
    AttitudeQuality attitude;
    PositionEstimator estimator;
    std::unique_ptr<EstimatorRun> run;
  };
  std::vector<Run> runs{};
};

/// The follower starts where a person would point: at the feature itself.
Result<std::optional<FollowedFeature>> Follow(Onlookers& onlookers, const MeasuredPicture& picture,
                                              const RigidTransform& X_WC,
                                              const Eigen::Vector3d& p_W_feature) {
  if (onlookers.follower) {
    return std::optional(onlookers.follower->Follow(picture.left));
  }
  const auto pixel = PixelFromWorldPoint(picture.camera, X_WC, p_W_feature);
  if (!pixel) {
    return UnavailableError("the cone is not in the picture when the descent is approved");
  }
  Result<FeatureFollower> follower = FeatureFollower::Start(picture.left, *pixel, {});
  if (!follower) {
    return follower.error();
  }
  onlookers.follower = std::make_unique<FeatureFollower>(std::move(follower).value());
  return std::optional(onlookers.follower->first());
}

std::vector<Onlookers> MakeOnlookers(const std::vector<int>& heights,
                                     const TrackingSettings& tracking, const AhrsNoise& vehicle,
                                     const Eigen::Vector3d& p_W_feature) {
  std::vector<Onlookers> all;
  for (const int rows : heights) {
    Onlookers& each = all.emplace_back();
    each.rows = rows;
    for (const AttitudeQuality attitude : kAttitudeQualities) {
      for (const PositionEstimator estimator : kPositionEstimators) {
        each.runs.push_back(
            {attitude, estimator,
             std::make_unique<EstimatorRun>(estimator, tracking, StatedErrors(attitude, vehicle),
                                            p_W_feature)});
      }
    }
  }
  return all;
}

/// `told`: the bundle by the quality of its attitudes.
void AddSensors(const std::vector<std::shared_ptr<const FrameBundle>>& told,
                const std::vector<Onlookers>& onlookers) {
  for (const Onlookers& each : onlookers) {
    for (const Onlookers::Run& run : each.runs) {
      run.run->AddSensors(*told[static_cast<std::size_t>(run.attitude)]);
    }
  }
}

/// The left picture of a bundle with its ranges, as the station measures them.
class PictureMeasurer {
 public:
  PictureMeasurer(const StereoRig& rig, const StereoRectifier& rectifier,
                  const StereoSettings& settings)
      : rig_(rig), rectifier_(rectifier), settings_(settings) {}

  RigidTransform X_WC(const RigidTransform& X_WB) const { return X_WB * rectifier_.X_BC(rig_); }
  Result<MeasuredPicture> Measure(const StereoFrame& raw, const RigidTransform& X_WB) {
    const Result<RectifiedPair> pair = rectifier_.Rectify(raw);
    if (!pair) {
      return pair.error();
    }
    Result<StereoResult> ranges = MeasureRanges({.raw = raw,
                                                 .pair = *pair,
                                                 .rig = rig_,
                                                 .rectifier = rectifier_,
                                                 .pose = ViewPose{X_WC(X_WB)}},
                                                settings_, matcher_);
    if (!ranges) {
      return ranges.error();
    }
    return MeasuredPicture{*pair->left, rectifier_.camera(), std::move(ranges->range)};
  }

 private:
  const StereoRig& rig_;
  const StereoRectifier& rectifier_;
  const StereoSettings& settings_;
  StereoMatcher matcher_;
};

/// All estimators over one approach, until its slope ends.
Status Watch(ConeApproach& approach, std::uint64_t seed, const StereoRig& rig,
             PictureMeasurer& measurer, std::vector<Onlookers>& onlookers) {
  std::vector<AttitudeOf> attitudes;
  for (const AttitudeQuality quality : kAttitudeQualities) {
    attitudes.emplace_back(quality, seed);
  }
  while (true) {
    const Result<std::optional<ApproachPicture>> next = approach.Next();
    if (!next || !*next) {
      return next ? Ok() : Status(next.error());
    }
    const ApproachPicture& seen = **next;
    std::vector<std::shared_ptr<const FrameBundle>> told;
    for (AttitudeOf& attitude : attitudes) {
      told.push_back(attitude.Told(seen.bundle, approach));
    }
    AddSensors(told, onlookers);
    if (!seen.bundle->stereo) {
      continue;
    }
    const Result<MeasuredPicture> whole = measurer.Measure(*seen.bundle->stereo, seen.X_WB);
    if (!whole) {
      return whole.error();
    }
    for (Onlookers& each : onlookers) {
      const MeasuredPicture picture = MiddleRows(*whole, each.rows);
      std::optional<FollowedFeature> followed;
      if (seen.approved) {
        Result<std::optional<FollowedFeature>> found =
            Follow(each, picture, measurer.X_WC(seen.X_WB), approach.p_W_cone());
        if (!found) {
          return found.error();
        }
        followed = std::move(found).value();
      }
      for (const Onlookers::Run& run : each.runs) {
        run.run->AddPicture(*told[static_cast<std::size_t>(run.attitude)], rig, picture, seen.X_WB,
                            followed ? &*followed : nullptr, seen.approved);
      }
    }
  }
}

Result<std::vector<TrialRow>> RunTrial(const PositionOptions& options, int trial,
                                       std::uint64_t seed, const SceneCameraFactory& camera) {
  const Result<MissionFlight> flight = options.flight.Flight(seed);
  if (!flight) {
    return flight.error();
  }
  const StereoRig& rig = flight->vehicle.rig;
  const Result<StereoRectifier> rectifier = StereoRectifier::Make(rig);
  if (!rectifier) {
    return rectifier.error();
  }
  const PinholeCamera& whole = rectifier->camera();
  const Result<std::vector<int>> heights = PictureHeights(whole);
  if (!heights) {
    return heights.error();
  }
  Result<ConeApproach> approach = ConeApproach::Make({.vehicle = flight->vehicle,
                                                      .seed = seed,
                                                      .wind_mps = flight->wind_mps,
                                                      .cone_height_m = options.cone_height_m},
                                                     camera);
  if (!approach) {
    return approach.error();
  }
  std::vector<Onlookers> onlookers = MakeOnlookers(
      *heights, flight->settings.tracking, flight->vehicle.sensors.attitude, approach->p_W_cone());
  PictureMeasurer measurer(rig, *rectifier, flight->settings.stereo);
  if (const Status watched = Watch(*approach, seed, rig, measurer, onlookers); !watched) {
    return watched.error();
  }
  std::vector<TrialRow> rows;
  for (const Onlookers& each : onlookers) {
    for (const Onlookers::Run& run : each.runs) {
      const PositionCase of{PictureSizeText(whole.width, each.rows), each.rows == whole.height,
                            NameOf(run.attitude), NameOf(run.estimator)};
      AddPositionRows(of, run.run->samples(), /*with_track=*/trial == 0, rows);
    }
  }
  return rows;
}

}  // namespace

Experiment PositionEstimateExperiment(SceneCameraFactory camera) {
  auto options = std::make_shared<PositionOptions>();
  Experiment experiment;
  experiment.name = "position-estimate";
  experiment.purpose =
      "The thesis's approach to a road cone: seven steps beside resection, raw and filtered";
  experiment.columns = PositionColumns();
  experiment.add_options = [options](CLI::App& verb) {
    options->flight.AddVehicle(verb);
    options->flight.AddWind(verb, 15);
    options->flight.AddSet(verb);
    verb.add_option("--cone", options->cone_height_m, "Height of the road cone, m")
        ->check(FiniteRange(0.1, 1.0))
        ->capture_default_str();
  };
  experiment.setup = [options] {
    return "vehicle " + options->flight.vehicle + ", " + options->flight.WindText() + ", cone " +
           CsvNumber(options->cone_height_m) + " m" + options->flight.SetText();
  };
  experiment.run = [options, camera = std::move(camera)](int trial, std::uint64_t seed) {
    return RunTrial(*options, trial, seed, camera);
  };
  experiment.report = PositionReport;
  return experiment;
}

}  // namespace palace
