#include "engine/experiments/evaluate_position_estimate.h"

#include <algorithm>
#include <array>
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

constexpr std::array kPictureRows = {480, 240};  // the rig's, and those of the thesis

struct PositionOptions {
  FlightOptions flight;
  double cone_height_m = 0.5;
};

template <typename T>
Image<T> MiddleRows(const Image<T>& image, int rows) {
  const int first = (image.height() - rows) / 2;
  Image<T> middle(image.width(), rows);
  for (int y = 0; y < rows; ++y) {
    std::copy_n(image.row(first + y), image.width(), middle.row(y));
  }
  return middle;
}

PinholeCamera MiddleRows(const PinholeCamera& camera, int rows) {
  PinholeCamera middle = camera;
  middle.cy_px -= (camera.height - rows) / 2;
  middle.height = rows;
  return middle;
}

MeasuredPicture MiddleRows(const MeasuredPicture& picture, int rows) {
  MeasuredPicture middle;
  middle.left = MiddleRows(picture.left, rows);
  middle.camera = middle.range.camera = MiddleRows(picture.camera, rows);
  middle.range.time = picture.range.time;
  middle.range.baseline_m = picture.range.baseline_m;
  middle.range.depth_m = MiddleRows(picture.range.depth_m, rows);
  middle.range.depth_sigma_m = MiddleRows(picture.range.depth_sigma_m, rows);
  return middle;
}

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

std::vector<Onlookers> MakeOnlookers(const TrackingSettings& tracking, const AhrsNoise& vehicle,
                                     const Eigen::Vector3d& p_W_feature) {
  std::vector<Onlookers> all;
  for (const int rows : kPictureRows) {
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
  ConeApproach approach({.vehicle = flight->vehicle,
                         .seed = seed,
                         .wind_mps = flight->wind_mps,
                         .cone_height_m = options.cone_height_m},
                        camera);
  std::vector<AttitudeOf> attitudes;
  for (const AttitudeQuality quality : kAttitudeQualities) {
    attitudes.emplace_back(quality, seed);
  }
  std::vector<Onlookers> onlookers = MakeOnlookers(
      flight->settings.tracking, flight->vehicle.sensors.attitude, approach.p_W_cone());
  StereoMatcher matcher;
  while (true) {
    const Result<std::optional<ApproachPicture>> next = approach.Next();
    if (!next) {
      return next.error();
    }
    if (!*next) {
      break;
    }
    const ApproachPicture& seen = **next;
    if (!seen.bundle->stereo) {
      continue;
    }
    const RigidTransform X_WC = seen.X_WB * rectifier->X_BC(rig);
    const Result<RectifiedPair> pair = rectifier->Rectify(*seen.bundle->stereo);
    if (!pair) {
      return pair.error();
    }
    Result<StereoResult> ranges = MeasureRanges({.raw = *seen.bundle->stereo,
                                                 .pair = *pair,
                                                 .rig = rig,
                                                 .rectifier = *rectifier,
                                                 .pose = ViewPose{X_WC}},
                                                flight->settings.stereo, matcher);
    if (!ranges) {
      return ranges.error();
    }
    const MeasuredPicture whole{*pair->left, rectifier->camera(), std::move(ranges->range)};
    std::vector<std::shared_ptr<const FrameBundle>> told;
    for (AttitudeOf& attitude : attitudes) {
      told.push_back(attitude.Told(seen.bundle, approach));
    }
    for (Onlookers& each : onlookers) {
      const MeasuredPicture picture = MiddleRows(whole, each.rows);
      std::optional<FollowedFeature> followed;
      if (seen.approved) {
        Result<std::optional<FollowedFeature>> found =
            Follow(each, picture, X_WC, approach.p_W_cone());
        if (!found) {
          return found.error();
        }
        followed = std::move(found).value();
      }
      for (const Onlookers::Run& run : each.runs) {
        run.run->Add(*told[static_cast<std::size_t>(run.attitude)], rig, picture, seen.X_WB,
                     followed ? &*followed : nullptr, seen.approved);
      }
    }
  }
  std::vector<TrialRow> rows;
  for (const Onlookers& each : onlookers) {
    for (const Onlookers::Run& run : each.runs) {
      const PositionCase of{each.rows, NameOf(run.attitude), NameOf(run.estimator)};
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
