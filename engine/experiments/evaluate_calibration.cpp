#include "engine/experiments/evaluate_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/calibration/calibration.h"
#include "engine/calibration/calibration_quality.h"
#include "engine/calibration/rig_difference.h"
#include "engine/calibration/target_detection.h"
#include "engine/core/command_line.h"
#include "engine/core/text.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"
#include "engine/simulation/calibration_session.h"

namespace palace {
namespace {

constexpr double kFocalLimit_percent = 0.05;
constexpr double kBaselineLimit_percent = 0.1;
constexpr double kRowLimit_px = 0.05;
constexpr double kInsideLimit = 0.95;

const std::array<const char*, kCameraSize> kParameterNames = {
    "left hs",    "left hc",   "left vs",    "left vc",    "left o1",    "left o2",
    "left rho1",  "left rho2", "right hs",   "right hc",   "right vs",   "right vc",
    "right o1",   "right o2",  "right rho1", "right rho2", "rotation x", "rotation y",
    "rotation z", "centre x",  "centre y",   "centre z"};

std::string ZColumn(int i) {
  std::string name = std::string("z_") + kParameterNames[static_cast<std::size_t>(i)];
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

struct CalibrationTrialOptions {
  int views = 16;
};

Result<std::vector<TargetView>> LookAt(const CalibrationSession& session, std::uint64_t seed,
                                       int& unseen) {
  std::vector<TargetView> views;
  for (int v = 0; v < static_cast<int>(session.X_FT.size()); ++v) {
    TargetView view;
    view.name = "view " + std::to_string(v);
    for (const int side : {0, 1}) {
      auto seen = DetectTarget(RenderSessionView(session, seed, v, side), session.target);
      if (!seen) {
        ++unseen;
        continue;
      }
      (side == 0 ? view.left : view.right) = std::move(*seen);
    }
    MatchTurn(session.target, view.left, view.right);
    views.push_back(std::move(view));
  }
  return views;
}

double FocalError_percent(const RigEstimate& estimate, const RigEstimate& truth) {
  double most = 0;
  for (const std::size_t side : {0u, 1u}) {
    for (const int index : {kHs, kVs}) {
      most = std::max(most, std::abs(estimate.lens[side][index] / truth.lens[side][index] - 1));
    }
  }
  return 100 * most;
}

Result<std::vector<TrialRow>> RunTrial(std::uint64_t seed, const CalibrationTrialOptions& options) {
  const CalibrationSession session = MakeCalibrationSession(seed, options.views);
  const RigEstimate truth = RigFromModels(session.left, session.right);
  int unseen = 0;
  const auto views = LookAt(session, seed, unseen);
  if (!views) {
    return views.error();
  }
  CalibrationOptions calibration_options;
  calibration_options.width = session.left.width;
  calibration_options.height = session.left.height;
  TrialRow row = {CsvNumber(truth.lens[0][kHs]), CsvNumber(truth.X_C0C1.p.norm()),
                  CsvNumber(session.look.noise_sigma), CsvNumber(session.look.blur_sigma_px),
                  std::to_string(unseen)};
  const auto result = Calibrate(session.target, *views, calibration_options);
  if (!result) {
    row.push_back("refused");
    row.resize(14 + kCameraSize, "nan");
    return std::vector<TrialRow>{row};
  }
  const CameraVector error = RigDifference(result->estimate, truth);
  const EpipolarCheck rows = CheckEpipolar(*result);
  const double mahalanobis = error.dot(result->covariance.ldlt().solve(error));
  row.insert(row.end(),
             {"calibrated", std::to_string(result->points), std::to_string(result->outliers),
              CsvNumber(result->sigma_px), CsvNumber(FocalError_percent(result->estimate, truth)),
              CsvNumber(100 * std::abs(result->baseline_m() / truth.X_C0C1.p.norm() - 1)),
              CsvNumber(rows.rms_px), CsvNumber(rows.held_out_rms_px),
              CsvNumber(mahalanobis / kCameraSize)});
  for (int i = 0; i < kCameraSize; ++i) {
    row.push_back(CsvNumber(error[i] / std::sqrt(result->covariance(i, i))));
  }
  return std::vector<TrialRow>{row};
}

/// All z of all trials.
std::vector<double> AllZ(const TrialTable& table) {
  std::vector<double> all;
  for (int i = 0; i < kCameraSize; ++i) {
    for (const double z : table.Numbers(ZColumn(i))) {
      if (std::isfinite(z)) {
        all.push_back(z);
      }
    }
  }
  return all;
}

int CountWithin(const std::vector<double>& values, double limit) {
  return static_cast<int>(
      std::count_if(values.begin(), values.end(), [&](double v) { return std::abs(v) <= limit; }));
}

struct Measure {
  const char* column;
  const char* label;
  const char* unit;
  double limit;
};

constexpr std::array<Measure, 3> kMeasures = {
    {{"focal_error_percent", "worst focal length error", "%", kFocalLimit_percent},
     {"baseline_error_percent", "baseline error", "%", kBaselineLimit_percent},
     {"row_rms_px", "epipolar row rms", "px", kRowLimit_px}}};

void AddMeasure(const TrialTable& table, const Measure& measure, ExperimentReport& report) {
  const std::vector<double> values = table.Numbers(measure.column);
  const Spread spread = SpreadOf(values);
  const bool passed = spread.count == static_cast<int>(values.size()) && spread.count > 0 &&
                      spread.max <= measure.limit;
  const std::string text = std::string(measure.label) + ": median " +
                           OrDash("%.4f", Percentile(values, 0.5)) + " " + measure.unit +
                           ", worst " + OrDash("%.4f", spread.max) + " " + measure.unit +
                           " (limit " + OrDash("%.2f", measure.limit) + " " + measure.unit + ")";
  report.Judge(passed, text);
}

void AddCoverage(const std::vector<double>& all, ExperimentReport& report) {
  const int count = static_cast<int>(all.size());
  const int inside = CountWithin(all, 3);
  const Interval interval = WilsonInterval(inside, count);
  const bool passed = count > 0 && inside >= kInsideLimit * count;
  const std::string text = "truth inside the stated 3 sigma: " + std::to_string(inside) + " of " +
                           std::to_string(count) + " parameters (95 % interval " +
                           OrDash("%.1f", 100 * interval.low) + " to " +
                           OrDash("%.1f", 100 * interval.high) + " %, wanted 95 %)";
  report.Judge(passed, text);
}

std::string MeasurePlot(const TrialTable& table, const Measure& measure) {
  LinePlot plot;
  plot.title = measure.label;
  plot.x_label = "trial";
  plot.y_label = std::string(measure.label) + ", " + measure.unit;
  plot.series = {{"trials", table.Numbers("trial"), table.Numbers(measure.column)}};
  plot.series[0].line = false;
  plot.limits = {{measure.limit, "limit"}};
  // Half a trial of room on both sides, or the first and last points lie on the frame.
  const std::vector<double>& trials = plot.series[0].x;
  if (!trials.empty()) {
    plot.x_min = *std::min_element(trials.begin(), trials.end()) - 0.5;
    plot.x_max = *std::max_element(trials.begin(), trials.end()) + 0.5;
  }
  plot.y_min = 0;
  return LinePlotSvg(plot);
}

/// Standard deviation of error over stated sigma, per parameter: 1 where the sigma is honest.
std::string HonestyPlot(const TrialTable& table) {
  LinePlot plot;
  plot.title = "error over stated sigma, root mean square per parameter";
  plot.x_label = "parameter (1 left hs ... 22 right centre z)";
  plot.y_label = "rms of error / sigma";
  PlotSeries series{"rms over the trials", {}, {}};
  series.line = false;
  for (int i = 0; i < kCameraSize; ++i) {
    const std::vector<double> z = table.Numbers(ZColumn(i));
    series.x.push_back(i + 1);
    series.y.push_back(SpreadOf(z).rms);
  }
  plot.series = {series};
  plot.limits = {{1, "honest"}};
  plot.y_min = 0;
  return LinePlotSvg(plot);
}

std::string DistributionPlot(std::vector<double> all) {
  LinePlot plot;
  plot.title = "share of parameters within k sigma";
  plot.x_label = "k";
  plot.y_label = "share";
  PlotSeries seen{"measured", {}, {}}, normal{"normal distribution", {}, {}};
  seen.points = normal.points = false;
  for (double k = 0; k <= 4.001; k += 0.1) {
    seen.x.push_back(k);
    seen.y.push_back(static_cast<double>(CountWithin(all, k)) /
                     std::max<double>(1, static_cast<double>(all.size())));
    normal.x.push_back(k);
    normal.y.push_back(std::erf(k / std::sqrt(2.0)));
  }
  plot.series = {seen, normal};
  return LinePlotSvg(plot);
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("Rendered calibrations against their truth")};
  const std::vector<double> all = AllZ(table);
  const int refused = static_cast<int>(table.Where("outcome", "refused").rows.size());
  report.page.Paragraph(
      "Each trial draws a rig of two CAHVOR cameras, renders a dot board before it, finds the dots "
      "and calibrates; nothing but the pictures and the board's size is known to the calibration.");
  for (const Measure& measure : kMeasures) {
    AddMeasure(table, measure, report);
  }
  AddCoverage(all, report);
  if (refused > 0) {
    report.Judge(false, std::to_string(refused) + " trials were refused");
  }
  const double rms = SpreadOf(all).rms;
  const std::string honesty =
      "error over stated sigma: rms " + OrDash("%.2f", rms) + " over all parameters (1 is honest)";
  report.page.Paragraph(honesty);
  report.lines.push_back(honesty);
  report.page.Heading("Errors");
  for (const Measure& measure : kMeasures) {
    report.page.Figure(MeasurePlot(table, measure), "Every trial.");
  }
  report.page.Heading("Are the sigmas honest?");
  report.page.Figure(HonestyPlot(table),
                     "Above 1 the stated sigma is too small, below 1 too large.");
  report.page.Figure(DistributionPlot(all), "All parameters of all trials.");
  std::vector<std::vector<std::string>> rows;
  for (int i = 0; i < kCameraSize; ++i) {
    const std::vector<double> z = table.Numbers(ZColumn(i));
    const Spread spread = SpreadOf(z);
    rows.push_back({kParameterNames[static_cast<std::size_t>(i)], OrDash("%.2f", spread.mean),
                    OrDash("%.2f", spread.rms),
                    std::to_string(CountWithin(z, 3)) + " of " + std::to_string(spread.count)});
  }
  report.page.Table({"parameter", "mean error / sigma", "rms", "inside 3 sigma"}, rows);
  return report;
}

}  // namespace

Experiment CalibrationExperiment() {
  auto options = std::make_shared<CalibrationTrialOptions>();
  Experiment experiment;
  experiment.name = "calibration";
  experiment.purpose = "Rendered calibrations of random CAHVOR rigs against their truth";
  experiment.default_trials = 20;
  experiment.columns = {"focal_px",
                        "baseline_m",
                        "noise_grey",
                        "blur_sigma_px",
                        "pictures_unseen",
                        "outcome",
                        "points",
                        "outliers",
                        "sigma_px",
                        "focal_error_percent",
                        "baseline_error_percent",
                        "row_rms_px",
                        "held_out_row_rms_px",
                        "mahalanobis_per_parameter"};
  for (int i = 0; i < kCameraSize; ++i) {
    experiment.columns.push_back(ZColumn(i));
  }
  experiment.add_options = [options](CLI::App& app) {
    app.add_option("--views", options->views, "Views a calibration")
        ->check(FiniteRange(4, 100))
        ->capture_default_str();
  };
  experiment.setup = [options] { return "views " + std::to_string(options->views); };
  experiment.run = [options](int, std::uint64_t seed) { return RunTrial(seed, *options); };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
