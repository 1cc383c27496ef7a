#include "engine/experiments/evaluate_image_time.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/faults/faulted_source.h"
#include "engine/navigation/image_time_watch.h"
#include "engine/report/statistics.h"
#include "engine/simulation/session.h"

namespace palace {
namespace {

constexpr double kBefore_s = 10;  // healthy
constexpr double kAfter_s = 10;   // with the offset
constexpr double kWanted_s = 2;
constexpr double kWinds_mps[] = {0, 2.6, 5.1, 7.7};  // 0, 5, 10, 15 kt
constexpr double kOffsets_s[] = {0, 0.05, -0.05, 0.1, -0.1, 0.3, -0.3, 0.5};

struct Hover {
  double observable_share = 0;  ///< of the healthy part
  bool false_alarm = false;     ///< before the offset
  double found_s = NAN;         ///< after it
  double told_s = NAN;          ///< the offset that was told then
  double sigma_s = NAN;
  double turn_rad_s = 0;  ///< root mean square of the rates about the picture's axes
};

Result<Hover> FlyHover(double wind_mps, double offset_s, std::uint64_t seed,
                       const SceneCameraFactory& camera) {
  const Result<SimulatedSession> session =
      OpenSimulatedSession({.seed = seed, .wind_mps = wind_mps}, camera);
  if (!session) {
    return session.error();
  }
  FaultedSource source(session->simulator, nullptr, seed);
  if (offset_s != 0) {
    // Stamps of poses that are early make pictures late.
    const Result<int> added =
        source.Add({.kind = FaultKind::kAttitudeShifted, .value = -offset_s, .from_s = kBefore_s});
    if (!added) {
      return added.error();
    }
  }
  const StereoRig rig = DefaultRig();
  ImageTimeWatch watch;
  Hover hover;
  int healthy = 0, observable = 0, rates = 0;
  double depth_m = NAN;
  while (source.now_s() < kBefore_s + kAfter_s) {
    const Result<std::shared_ptr<const FrameBundle>> next = source.Next({});
    if (!next) {
      return next.error();
    }
    const FrameBundle& bundle = **next;
    for (const LaserRange& range : bundle.laser) {
      depth_m = std::isfinite(range.range_m) ? range.range_m : depth_m;
    }
    for (const VehiclePose& pose : bundle.poses) {
      const Eigen::Vector3d w_C = rig.X_BC().R.transpose() * pose.angular_rate_B;
      hover.turn_rad_s += w_C.head<2>().squaredNorm();
      ++rates;
    }
    watch.AddPoses(bundle.poses, rig.left.pinhole, rig.X_BC(), depth_m);
    if (bundle.stereo) {
      watch.AddPictures(&bundle.stereo->left, &bundle.stereo->right, bundle.stereo->time);
    }
    const double after_s = source.now_s() - kBefore_s;
    for (const ImageTime* found : {&watch.left(), &watch.right()}) {
      const bool off = found->state == ImageTime::State::kOff;
      if (after_s < 0 || offset_s == 0) {
        ++healthy;
        observable += found->state == ImageTime::State::kAgrees ? 1 : 0;
        hover.false_alarm = hover.false_alarm || off;
      } else if (off && std::isnan(hover.found_s)) {
        hover.found_s = after_s;
        hover.told_s = found->offset_s;
        hover.sigma_s = found->sigma_s;
      }
    }
  }
  hover.observable_share = static_cast<double>(observable) / std::max(1, healthy);
  hover.turn_rad_s = std::sqrt(hover.turn_rad_s / std::max(1, rates));
  return hover;
}

Result<std::vector<TrialRow>> RunTrial(std::uint64_t seed, const SceneCameraFactory& camera) {
  std::vector<TrialRow> rows;
  for (const double wind_mps : kWinds_mps) {
    for (const double offset_s : kOffsets_s) {
      const Result<Hover> hover = FlyHover(wind_mps, offset_s, seed, camera);
      if (!hover) {
        return hover.error();
      }
      rows.push_back({CsvNumber(wind_mps), CsvNumber(1000 * offset_s),
                      CsvNumber(hover->turn_rad_s * kDegPerRad), CsvNumber(hover->observable_share),
                      hover->false_alarm ? "1" : "0", CsvNumber(hover->found_s),
                      CsvNumber(1000 * hover->told_s), CsvNumber(1000 * hover->sigma_s)});
    }
  }
  return rows;
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: image time against attitude time")};
  const std::vector<double> wind = table.Numbers("wind_mps"), offset = table.Numbers("offset_ms"),
                            turn = table.Numbers("turn_deg_s"),
                            observable = table.Numbers("observable_share"),
                            alarm = table.Numbers("false_alarm"), found = table.Numbers("found_s"),
                            told = table.Numbers("told_ms");
  std::vector<std::vector<std::string>> cells;
  int false_alarms = 0;
  for (const double w : kWinds_mps) {
    for (const double o : kOffsets_s) {
      int flights = 0, in_time = 0, alarms = 0;
      double share = 0, rate = 0, worst_ms = 0;
      for (std::size_t i = 0; i < wind.size(); ++i) {
        if (std::abs(wind[i] - w) > 1e-9 || std::abs(offset[i] - 1000 * o) > 1e-6) {
          continue;
        }
        ++flights;
        in_time += found[i] <= kWanted_s ? 1 : 0;
        alarms += alarm[i] > 0 ? 1 : 0;
        share += observable[i];
        rate += turn[i];
        worst_ms =
            std::isfinite(told[i]) ? std::max(worst_ms, std::abs(told[i] - offset[i])) : worst_ms;
      }
      if (flights == 0) {
        continue;
      }
      false_alarms += alarms;
      const Interval interval = WilsonInterval(in_time, flights);
      cells.push_back(
          {WithNumbers("%.1f", w), WithNumbers("%.0f", 1000 * o),
           WithNumbers("%.2f", rate / flights), WithNumbers("%.0f %%", 100 * share / flights),
           WithNumbers("%.0f of %.0f", alarms, flights),
           o == 0 ? "-"
                  : WithNumbers("%.0f of ", in_time) + std::to_string(flights) +
                        WithNumbers(" (%.0f to %.0f %%)", 100 * interval.low, 100 * interval.high),
           o == 0 ? "-" : WithNumbers("%.0f", worst_ms)});
      report.lines.push_back("wind " + cells.back()[0] + " m/s, offset " + cells.back()[1] +
                             " ms: turns at " + cells.back()[2] + " deg/s, observable " +
                             cells.back()[3] + ", false alarms " + cells.back()[4] +
                             ", found in 2 s " + cells.back()[5] + ", off by at most " +
                             cells.back()[6] + " ms");
    }
  }
  report.passed = false_alarms == 0;
  report.page
      .Paragraph(
          "A hover of 10 s with right stamps, then 10 s with stamps of poses that make the "
          "pictures late by the offset. Observable: share of pictures of the healthy part "
          "at which times were seen to agree.")
      .Table({"Wind, m/s", "Pictures late by, ms", "Turning, rms, deg/s", "Observable",
              "False alarms", "Found within 2 s (95 % interval)", "Told wrong by at most, ms"},
             cells);
  return report;
}

}  // namespace

Experiment ImageTimeExperiment(SceneCameraFactory camera) {
  Experiment experiment;
  experiment.name = "image-time";
  experiment.purpose = "Wrong image times found in a hover, by offset and wind";
  experiment.default_trials = 2;
  experiment.columns = {"wind_mps",    "offset_ms", "turn_deg_s", "observable_share",
                        "false_alarm", "found_s",   "told_ms",    "sigma_ms"};
  experiment.run = [camera = std::move(camera)](int, std::uint64_t seed) {
    return RunTrial(seed, camera);
  };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
