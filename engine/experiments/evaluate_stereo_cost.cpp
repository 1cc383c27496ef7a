#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include <opencv2/core.hpp>

#include "engine/camera/pinhole.h"
#include "engine/core/units.h"
#include "engine/experiments/evaluate_stereo.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"
#include "engine/stereo/opencv_matchers.h"
#include "engine/stereo/stereo.h"
#include "engine/world/ray_pictures.h"

namespace palace {
namespace {

constexpr const char* kOurs = "PALACE with sigma";
constexpr int kRepeats = 5;
constexpr double kBudget_ms = 40;  // 640x480, 96 disparities, 2 cores
constexpr std::array kPeers = {OpenCvMatcher::kSgbm3Way, OpenCvMatcher::kSgbm,
                               OpenCvMatcher::kSgbmHh, OpenCvMatcher::kBm};

struct Load {
  int width;
  int height;
  int disparities;
};
constexpr std::array kLoads = {Load{320, 240, 96}, Load{480, 360, 96},  Load{640, 480, 96},
                               Load{960, 720, 96}, Load{1280, 960, 96}, Load{640, 480, 32},
                               Load{640, 480, 64}, Load{640, 480, 128}, Load{640, 480, 192},
                               Load{640, 480, 256}};

/// Median of a few runs, milliseconds.
template <typename Work>
double TimeOf(const Work& work) {
  std::vector<double> times_ms;
  for (int k = 0; k < kRepeats; ++k) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    times_ms.push_back(took.count());
  }
  return Percentile(times_ms, 0.5);
}

Result<std::vector<TrialRow>> RunCost(int trial, std::uint64_t seed) {
  const Load load = kLoads[static_cast<std::size_t>(trial) % kLoads.size()];
  World world;
  world.ground.texture_seed = seed;
  const StereoView view =
      ViewFrom(world, PinholeFromFov(load.width, load.height, Rad(45)), 15.24, Rad(-90), 1);
  const ImageU8 left = Expose(view.left_grey, {}, 1), right = Expose(view.right_grey, {}, 2);
  const DisparityWindow window{16, load.disparities};
  const StereoSettings settings;
  std::vector<TrialRow> rows;
  const auto add = [&](const char* matcher, double time_ms) {
    rows.push_back({std::to_string(load.width), std::to_string(load.height),
                    std::to_string(load.disparities), std::to_string(cv::getNumThreads()), matcher,
                    CsvNumber(time_ms)});
  };
  StereoMatcher matcher;
  Status failed = Ok();
  add(kOurs, TimeOf([&] {
        const auto result =
            matcher.Match(left, right, view.camera, view.baseline_m, window, settings, {});
        failed = result ? Ok() : Status(result.error());
      }));
  if (!failed) {
    return failed.error();
  }
  for (const OpenCvMatcher peer : kPeers) {
    add(NameOf(peer), TimeOf([&] { MatchWithOpenCv(peer, left, right, window, settings); }));
  }
  return rows;
}

/// Time against size or disparities, the other held at 640x480 or 96.
LinePlot CostPlot(const TrialTable& table, bool by_size) {
  LinePlot plot{
      by_size ? "Cost against picture size, 96 disparities" : "Cost against disparities, 640 x 480",
      by_size ? "picture size, megapixels" : "disparities",
      "time a pair, ms",
      {}};
  plot.y_min = 0;
  const TrialTable fixed = by_size ? table.Where("disparities", "96") : table.Where("width", "640");
  for (const std::string& name : fixed.Values("matcher")) {
    const TrialTable rows = fixed.Where("matcher", name);
    const std::vector<double> width = rows.Numbers("width"), height = rows.Numbers("height"),
                              count = rows.Numbers("disparities"), time = rows.Numbers("time_ms");
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < time.size(); ++i) {
      points.emplace_back(by_size ? width[i] * height[i] * 1e-6 : count[i], time[i]);
    }
    std::sort(points.begin(), points.end());
    PlotSeries series{.name = name, .x = {}, .y = {}};
    for (const auto& [x, y] : points) {
      series.x.push_back(x);
      series.y.push_back(y);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

ExperimentReport ReportCost(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: cost of stereo")};
  const TrialTable usual = table.Where("width", "640").Where("disparities", "96");
  for (const std::string& name : usual.Values("matcher")) {
    const std::vector<double> times = usual.Where("matcher", name).Numbers("time_ms");
    char line[128];
    std::snprintf(line, sizeof line, "640 x 480, 96 disparities: %s %.1f ms", name.c_str(),
                  Percentile(times, 0.5));
    report.lines.emplace_back(line);
  }
  if (report.lines.empty()) {
    report.lines.emplace_back("no trial was 640 x 480 with 96 disparities; the default trials are");
  }
  LinePlot by_size = CostPlot(table, true);
  by_size.limits = {{kBudget_ms, "budget at 0.31 megapixels, 2 cores"}};
  report.page.List(report.lines)
      .Figure(LinePlotSvg(by_size), "Ours gives depth and sigma, the others whole disparities.")
      .Figure(LinePlotSvg(CostPlot(table, false)), "The same against the width of the search.");
  report.page.Heading("Every run").Table(table.columns, table.rows);
  return report;
}

}  // namespace

Experiment StereoCostExperiment() {
  Experiment experiment;
  experiment.name = "stereo-cost";
  experiment.purpose = "Time of stereo against picture size and disparities, beside OpenCV";
  experiment.default_trials = static_cast<int>(kLoads.size());
  experiment.columns = {"width", "height", "disparities", "threads", "matcher", "time_ms"};
  experiment.run = RunCost;
  experiment.report = ReportCost;
  return experiment;
}

}  // namespace palace
