#include "engine/experiments/evaluate_stereo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/camera/pinhole.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"
#include "engine/stereo/accuracy.h"
#include "engine/stereo/opencv_matchers.h"
#include "engine/stereo/stereo.h"
#include "engine/world/ray_pictures.h"

namespace palace {
namespace {

constexpr double kBoxHeight_m = 0.1524;  // 6 inches
constexpr double kRamp_rad = 5 * kRadPerDeg;
constexpr double kLander_m = 3.6;
constexpr const char* kOurs = "PALACE";
constexpr std::array kTextures = {GroundTexture::kGravel, GroundTexture::kGrass,
                                  GroundTexture::kAsphalt};
constexpr std::array kHeights_ft = {10.0, 20.0, 30.0, 50.0, 100.0, 150.0};
constexpr std::array kTilts_deg = {-90.0, -45.0};
constexpr std::array kNoises_grey = {2.0, 4.0};
constexpr std::array kPeers = {OpenCvMatcher::kSgbm, OpenCvMatcher::kSgbmHh, OpenCvMatcher::kBm};

/// What one trial looks at.
struct Condition {
  GroundTexture texture;
  double height_ft;
  double tilt_deg;
  double noise_grey;
};

Condition ConditionOf(int trial) {
  const auto pick = [&trial](const auto& values) {
    const auto value = values[static_cast<std::size_t>(trial) % values.size()];
    trial /= static_cast<int>(values.size());
    return value;
  };
  Condition condition{};
  condition.texture = pick(kTextures);
  condition.tilt_deg = pick(kTilts_deg);
  condition.height_ft = pick(kHeights_ft);
  condition.noise_grey = pick(kNoises_grey);
  return condition;
}

struct Obstacles {
  std::vector<Patch> small;  ///< 0.3 m wide
  std::vector<Patch> wide;   ///< 0.5 m wide
  std::vector<Patch> ramps;
};

/// Around the place where the optical axis meets the ground, no wider than both cameras see.
Obstacles PlaceObstacles(double north_m, double height_m) {
  Obstacles obstacles;
  const double pitch_m = std::clamp(height_m / 7, 0.8, 2.2);
  for (int i = -1; i <= 1; ++i) {
    obstacles.small.push_back({north_m + pitch_m * i, 0.4, 0.3, 0.3});
    obstacles.wide.push_back({north_m + pitch_m * i, 0.4 + pitch_m, 0.5, 0.5});
  }
  if (height_m > 6) {  // lower down a ramp of 2 m does not fit into the picture
    obstacles.ramps = {{north_m - 1.3, -2.0, 2, 2}, {north_m + 1.3, -2.0, 2, 2}};
  }
  return obstacles;
}

World MakeWorld(const Condition& condition, const Obstacles& obstacles, std::uint64_t seed) {
  World world;
  world.ground.texture = condition.texture;
  world.ground.texture_seed = seed;
  for (const auto* boxes : {&obstacles.small, &obstacles.wide}) {
    for (const Patch& box : *boxes) {
      world.solids.push_back(
          MakeBox(box.north_m, box.east_m, box.size_north_m, box.size_east_m, kBoxHeight_m));
    }
  }
  for (const Patch& ramp : obstacles.ramps) {
    world.solids.push_back(
        MakeWedge(ramp.north_m, ramp.east_m, ramp.size_north_m, ramp.size_east_m, kRamp_rad));
  }
  return world;
}

double MeanOf(const std::vector<double>& values) { return SpreadOf(values).mean; }

std::vector<std::string> Columns() {
  std::vector<std::string> columns = {
      "texture",  "height_ft",        "tilt_deg",      "noise_grey",
      "matcher",  "coverage",         "outliers",      "rms_px",
      "lock_px",  "error_per_sigma",  "box_0_3_m_cm",  "box_0_5_m_cm",
      "ramp_deg", "slope_median_deg", "slope_p95_deg", "slope_patches"};
  for (std::size_t k = 0; k < kFractionBins; ++k) {
    columns.push_back("fraction_" + std::to_string(k) + "_px");
  }
  return columns;
}

TrialRow MeasureRow(const Condition& condition, const StereoView& view, const Obstacles& obstacles,
                    const char* matcher, const ImageF& disparity_px, const ImageF& sigma_px) {
  const double fb = view.camera.fx_px * view.baseline_m;
  const DisparityAccuracy accuracy =
      CompareDisparity(disparity_px, sigma_px, DisparityFromDepth(view.depth_m, fb));
  const ImageF depth_m = DisparityFromDepth(disparity_px, fb);  // the relation is its own inverse
  const MeasuredView measured{view.camera, view.X_WC, depth_m, view.depth_m};
  const auto heights_cm = [&](const std::vector<Patch>& boxes) {
    std::vector<double> heights;
    for (const Patch& box : boxes) {
      heights.push_back(100 * MeasuredHeight(measured, box, kBoxHeight_m));
    }
    return CsvNumber(MeanOf(heights));
  };
  std::vector<double> ramps_deg, slopes_deg;
  for (const Patch& ramp : obstacles.ramps) {
    ramps_deg.push_back(
        Deg(MeasureSlope(measured, {ramp.north_m, ramp.east_m, 1.8, 1.8}).slope_rad));
  }
  for (const PatchSlope& slope : SlopesOverGround(measured, view.baseline_m, kLander_m)) {
    slopes_deg.push_back(Deg(slope.error_rad));
  }
  TrialRow row = {NameOf(condition.texture),
                  CsvNumber(condition.height_ft),
                  CsvNumber(condition.tilt_deg),
                  CsvNumber(condition.noise_grey),
                  matcher,
                  CsvNumber(accuracy.coverage),
                  CsvNumber(accuracy.outliers),
                  CsvNumber(accuracy.rms_px),
                  CsvNumber(accuracy.lock_px),
                  CsvNumber(accuracy.normalised),
                  heights_cm(obstacles.small),
                  heights_cm(obstacles.wide),
                  CsvNumber(MeanOf(ramps_deg)),
                  CsvNumber(Percentile(slopes_deg, 0.5)),
                  CsvNumber(Percentile(slopes_deg, 0.95)),
                  std::to_string(slopes_deg.size())};
  for (const double mean : accuracy.mean_error_px) {
    row.push_back(CsvNumber(mean));
  }
  return row;
}

Result<std::vector<TrialRow>> RunAccuracy(int trial, std::uint64_t seed) {
  const Condition condition = ConditionOf(trial);
  const double height_m = condition.height_ft * kMetresPerFoot;
  const double tilt_rad = Rad(condition.tilt_deg);
  const double axis_north_m = condition.tilt_deg < -60 ? 0 : height_m / std::tan(-tilt_rad);
  const Obstacles obstacles = PlaceObstacles(axis_north_m, height_m);
  const StereoView view = ViewFrom(MakeWorld(condition, obstacles, seed),
                                   PinholeFromFov(640, 480, Rad(45)), height_m, tilt_rad);
  const ImageU8 left = Expose(view.left_grey, {condition.noise_grey}, 2 * seed);
  const ImageU8 right = Expose(view.right_grey, {condition.noise_grey}, 2 * seed + 1);
  const StereoSettings settings;
  const DisparityWindow window =
      PredictWindow(view.camera, view.baseline_m, view.X_WC, 0, 1, settings);
  StereoMatcher matcher;
  const Result<StereoResult> ours =
      matcher.Match(left, right, view.camera, view.baseline_m, window, settings, {});
  if (!ours) {
    return ours.error();
  }
  std::vector<TrialRow> rows = {MeasureRow(
      condition, view, obstacles, kOurs, ours->range.disparity_px, ours->range.disparity_sigma_px)};
  for (const OpenCvMatcher peer : kPeers) {
    rows.push_back(MeasureRow(condition, view, obstacles, NameOf(peer),
                              MatchWithOpenCv(peer, left, right, window, settings), {}));
  }
  return rows;
}

// ---- report ----

/// Mean error by fraction of a pixel: flat when nothing locks.
LinePlot LockPlot(const TrialTable& table) {
  LinePlot plot{"Lock to whole pixels", "fraction of the true disparity, px", "mean error, px", {}};
  for (const std::string& name : table.Values("matcher")) {
    const TrialTable rows = table.Where("matcher", name);
    PlotSeries series{.name = name, .x = {}, .y = {}};
    for (std::size_t k = 0; k < kFractionBins; ++k) {
      series.x.push_back((static_cast<double>(k) + 0.5) / kFractionBins);
      series.y.push_back(MeanOf(rows.Numbers("fraction_" + std::to_string(k) + "_px")));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// Mean of a column against height, one line a matcher.
LinePlot PlotByHeight(const TrialTable& table, const std::string& column, const std::string& title,
                      const std::string& y_label) {
  LinePlot plot{title, "height above ground, ft", y_label, {}};
  for (const std::string& name : table.Values("matcher")) {
    const TrialTable rows = table.Where("matcher", name);
    PlotSeries series{.name = name, .x = {}, .y = {}};
    for (const double height_ft : kHeights_ft) {
      series.x.push_back(height_ft);
      series.y.push_back(MeanOf(rows.Where("height_ft", CsvNumber(height_ft)).Numbers(column)));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

std::vector<std::vector<std::string>> Summary(const TrialTable& table) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& name : table.Values("matcher")) {
    for (const double tilt : kTilts_deg) {
      const TrialTable part = table.Where("matcher", name).Where("tilt_deg", CsvNumber(tilt));
      const auto mean = [&](const char* column) { return MeanOf(part.Numbers(column)); };
      rows.push_back({name, tilt < -60 ? "nadir" : "45°", OrDash("%.3f", mean("coverage")),
                      OrDash("%.4f", mean("outliers")), OrDash("%.3f", mean("rms_px")),
                      OrDash("%.3f", mean("lock_px")), OrDash("%.2f", mean("error_per_sigma")),
                      OrDash("%.1f", mean("box_0_3_m_cm")), OrDash("%.1f", mean("box_0_5_m_cm")),
                      OrDash("%.2f", mean("ramp_deg")), OrDash("%.2f", mean("slope_median_deg")),
                      OrDash("%.2f", mean("slope_p95_deg"))});
    }
  }
  return rows;
}

ExperimentReport ReportAccuracy(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: stereo accuracy")};
  const std::vector<std::string> header = {"matcher",
                                           "view",
                                           "coverage",
                                           "off by > 1 px",
                                           "rms, px",
                                           "lock, px",
                                           "error / sigma",
                                           "0.3 m box, cm",
                                           "0.5 m box, cm",
                                           "5° ramp, °",
                                           "slope error, median, °",
                                           "slope error, p95, °"};
  report.page.Paragraph(
      "Ray-cast pairs of the thesis's rig (640 x 480, 45° wide, baseline 1 m) with exact depths. "
      "Boxes are 6 inches (15.24 cm) high, ramps rise by 5° over 2 m, slopes are of 3.6 m patches. "
      "Means over all heights, textures and noise levels below.");
  const auto all = Summary(table);
  report.page.Table(header, all);
  const TrialTable fifty = table.Where("height_ft", CsvNumber(50));
  const auto at_fifty = Summary(fifty);
  report.page.Heading("At 50 ft");
  if (at_fifty.empty()) {
    report.lines.push_back("no trial was at 50 ft; " + std::to_string(kStereoTrials) +
                           " trials run the whole plan");
    report.page.Paragraph(report.lines.back());
  } else {
    report.page.Table(header, at_fifty);
  }
  const TrialTable ours = fifty.Where("matcher", kOurs);
  std::vector<std::vector<std::string>> sigmas;
  for (const GroundTexture texture : kTextures) {
    const TrialTable part = ours.Where("texture", NameOf(texture));
    sigmas.push_back({NameOf(texture), OrDash("%.2f", MeanOf(part.Numbers("error_per_sigma"))),
                      OrDash("%.3f", MeanOf(part.Numbers("rms_px")))});
  }
  report.page.Heading("Honesty of sigma at 50 ft, by texture")
      .Table({"texture", "sd of error / sigma", "rms, px"}, sigmas);
  report.page.Figure(LinePlotSvg(LockPlot(table)), "Mean over all trials.");
  LinePlot box =
      PlotByHeight(table, "box_0_3_m_cm", "Height read of a 6-inch box 0.3 m wide", "height, cm");
  box.limits = {{100 * kBoxHeight_m, "true"}};
  LinePlot ramp = PlotByHeight(table, "ramp_deg", "Slope read of a 5° ramp", "slope, °");
  ramp.limits = {{5, "true"}};
  report.page.Figure(LinePlotSvg(box), "Mean over textures, tilts and noise levels.")
      .Figure(LinePlotSvg(ramp), "Ramps do not fit into the picture below 20 ft.")
      .Figure(LinePlotSvg(PlotByHeight(table, "rms_px", "Disparity error", "rms, px")),
              "Errors up to 1 px.")
      .Figure(LinePlotSvg(PlotByHeight(table, "coverage", "Coverage", "share of pixels")),
              "Of the pixels that both cameras see.");
  for (const auto& row : at_fifty) {
    report.lines.push_back("50 ft " + row[1] + ", " + row[0] + ": lock " + row[5] + " px, rms " +
                           row[4] + " px, boxes " + row[7] + " / " + row[8] + " cm, ramp " +
                           row[9] + " deg, slope error " + row[10] + " / " + row[11] +
                           " deg, error/sigma " + row[6]);
  }
  return report;
}

}  // namespace

Experiment StereoAccuracyExperiment() {
  Experiment experiment;
  experiment.name = "stereo-accuracy";
  experiment.purpose =
      "Ranges, 6-inch boxes and 5-degree ramps against exact depths, beside OpenCV";
  experiment.default_trials = kStereoTrials;
  experiment.columns = Columns();
  experiment.run = RunAccuracy;
  experiment.report = ReportAccuracy;
  return experiment;
}

}  // namespace palace
