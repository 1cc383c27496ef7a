#include "engine/calibration/calibration_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "engine/calibration/calibration_quality.h"
#include "engine/camera/cahvor.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/report/html_page.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

constexpr double kMostRowRms_px = 0.2;
constexpr double kMostHeldOutRatio = 1.5;
constexpr double kMostFocalShare = 0.002;
constexpr double kMostBaselineShare = 0.002;
constexpr double kReportDepth_m = 15;

const std::array<const char*, 2> kSideNames = {"left", "right"};

std::string Fixed(double value, int decimals) {
  return OrDash(("%." + std::to_string(decimals) + "f").c_str(), value);
}

std::string Percent(double share) { return Fixed(100 * share, 3) + " %"; }

double Sigma(const Calibration& calibration, int index) {
  return std::sqrt(std::max(0.0, calibration.covariance(index, index)));
}

/// One camera parameter as a person reads it.
struct Parameter {
  std::string name;  ///< key in the JSON file, unit included
  std::string meaning;
  double value = 0;
  double sigma = 0;
  int decimals = 4;
};

std::vector<Parameter> ParametersOf(const Calibration& calibration) {
  struct Row {
    const char* name;
    const char* meaning;
    double scale;
    int decimals;
  };
  static constexpr std::array<Row, kLensSize> kLensRows = {
      {{"hs_px", "focal length in columns", 1, 3},
       {"hc_px", "image centre, column", 1, 3},
       {"vs_px", "focal length in rows", 1, 3},
       {"vc_px", "image centre, row", 1, 3},
       {"o1", "optical axis beside A, to the right (tangent)", 1, 6},
       {"o2", "optical axis beside A, down (tangent)", 1, 6},
       {"rho1", "radial distortion, second order", 1, 5},
       {"rho2", "radial distortion, fourth order", 1, 5}}};
  std::vector<Parameter> parameters;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < kLensSize; ++i) {
      const Row& row = kLensRows[static_cast<std::size_t>(i)];
      const auto at = static_cast<std::size_t>(side);
      parameters.push_back({std::string(kSideNames[at]) + "_" + row.name, row.meaning,
                            calibration.estimate.lens[at][i],
                            Sigma(calibration, i + (side == 0 ? 0 : kRightLens)), row.decimals});
    }
  }
  const Eigen::AngleAxisd turn(calibration.estimate.X_C0C1.R);
  const Eigen::Vector3d rotation = turn.angle() * turn.axis();
  const std::array<const char*, 3> axes = {"x (right)", "y (down)", "z (forward)"};
  for (int i = 0; i < 3; ++i) {
    const char letter = "xyz"[i];
    parameters.push_back(
        {std::string("right_rotation_") + letter + "_deg",
         std::string("right camera turned about ") + axes[static_cast<std::size_t>(i)],
         Deg(rotation[i]), Deg(Sigma(calibration, kRightRotation + i)), 5});
  }
  for (int i = 0; i < 3; ++i) {
    const char letter = "xyz"[i];
    parameters.push_back({std::string("right_centre_") + letter + "_m",
                          std::string("right camera's place, ") + axes[static_cast<std::size_t>(i)],
                          calibration.estimate.X_C0C1.p[i], Sigma(calibration, kRightCentre + i),
                          6});
  }
  return parameters;
}

HeatMap PictureMap(const Calibration& calibration, const std::string& title,
                   const std::string& value, GridF cells, int decimals) {
  HeatMap map;
  map.title = title;
  map.x_label = "column, px";
  map.y_label = "row, px";
  map.value_label = value;
  map.cells = std::move(cells);
  map.x_min = -0.5;
  map.x_max = calibration.width - 0.5;
  map.y_top = -0.5;
  map.y_bottom = calibration.height - 0.5;
  map.low = 0;
  map.decimals = decimals;
  return map;
}

/// 1, 2 or 5 times a power of ten, so that typical arrows are about 12 px long.
double Magnification(double rms_px) {
  const double wanted = 12 / std::max(rms_px, 1e-6);
  const double decade = std::pow(10, std::floor(std::log10(wanted)));
  return decade * (wanted / decade >= 5 ? 5 : wanted / decade >= 2 ? 2 : 1);
}

void AddResiduals(const Calibration& calibration, HtmlPage& page) {
  page.Heading("Residuals: observed minus predicted");
  for (const int side : {0, 1}) {
    const auto at = static_cast<std::size_t>(side);
    const double rms_px = side == 0 ? calibration.left_rms_px : calibration.right_rms_px;
    VectorPlot plot;
    plot.title = std::string(kSideNames[at]) + " camera, rms " + Fixed(rms_px, 4) + " px";
    plot.width = calibration.width;
    plot.height = calibration.height;
    plot.magnification = Magnification(rms_px);
    for (const PointResidual& r : calibration.residuals) {
      if (r.side == side) {
        plot.arrows.push_back({r.pixel.x(), r.pixel.y(), r.error_px.x(), r.error_px.y(), 0});
      }
    }
    for (const PointResidual& r : calibration.rejected) {
      if (r.side == side && r.error_px.allFinite()) {
        plot.arrows.push_back({r.pixel.x(), r.pixel.y(), r.error_px.x(), r.error_px.y(), 1});
      }
    }
    plot.series_names = {"used", "taken out as outlier"};
    page.Figure(VectorPlotSvg(plot),
                "Arrows drawn " + Fixed(plot.magnification, 0) +
                    " times too long. They should look random; a swirl or a fan that many views "
                    "share is a lens or a board that the model does not describe.");
  }
}

void AddMaps(const Calibration& calibration, HtmlPage& page) {
  page.Heading("Coverage and uncertainty");
  for (const int side : {0, 1}) {
    const std::string name = kSideNames[static_cast<std::size_t>(side)];
    page.Figure(HeatMapSvg(PictureMap(calibration, "points seen, " + name + " camera", "points",
                                      CoverageMap(calibration, side, kMapRows, kMapColumns), 0)),
                "Where the target has been in the picture. Empty cells are extrapolated.");
    page.Figure(
        HeatMapSvg(PictureMap(calibration, "uncertainty, " + name + " camera", "1 sigma, px",
                              UncertaintyMap(calibration, side, kMapRows, kMapColumns), 3)),
        "One sigma of where a known far direction appears, from the parameters' covariance; a "
        "common rotation of the camera is not counted.");
  }
  GridF depth = DepthSigmaMap(calibration, kReportDepth_m, kMapRows, kMapColumns);
  for (float& cell : depth.cells()) {
    cell *= 1000;
  }
  page.Figure(HeatMapSvg(PictureMap(calibration, "depth at 15 m from calibration alone",
                                    "1 sigma, mm", std::move(depth), 1)),
              "Left picture. Hatched: the right camera does not see that point. The target's pitch "
              "adds its own share of error to every depth; matching adds its own noise.");
}

void AddParameters(const Calibration& calibration, HtmlPage& page) {
  page.Heading("Parameters");
  page.Paragraph(
      "Frame: the left camera's own axes (x right, y down, z forward), origin at its projection "
      "centre; both model files are written in it. rho0 is 0 and theta -90 degrees by definition. "
      "Sigmas come from the residuals (" +
      Fixed(calibration.sigma_px, 4) +
      " px a coordinate); they hold when residuals are independent and the model is right. Weak "
      "priors keep "
      "what a lens without distortion cannot tell near zero: o1 and o2 within 0.05, rho1 within 1, "
      "rho2 within 5 (1 sigma). Scale "
      "is not observable: all lengths follow pitch_m of the target.");
  std::vector<std::vector<std::string>> rows;
  for (const Parameter& p : ParametersOf(calibration)) {
    rows.push_back({p.name, p.meaning, Fixed(p.value, p.decimals), Fixed(p.sigma, p.decimals + 1),
                    Fixed(3 * p.sigma, p.decimals + 1)});
  }
  rows.push_back({"baseline_m", "distance of the two cameras", Fixed(calibration.baseline_m(), 6),
                  Fixed(calibration.baseline_sigma_m(), 7),
                  Fixed(3 * calibration.baseline_sigma_m(), 7)});
  page.Table({"parameter", "meaning", "value", "1 sigma", "3 sigma"}, rows);
}

void AddViews(const Calibration& calibration, const CalibrationNotes& notes, HtmlPage& page) {
  page.Heading("Views");
  std::vector<std::vector<std::string>> rows;
  for (const ViewResult& v : calibration.views) {
    rows.push_back({v.name, Fixed(Deg(v.tilt_rad), 1), Fixed(v.distance_m, 2),
                    std::to_string(v.left_points), std::to_string(v.right_points),
                    std::to_string(v.outliers()), Fixed(v.left_rms_px, 4), Fixed(v.right_rms_px, 4),
                    v.held_out ? "yes, " + Fixed(v.held_out_rms_px, 4) + " px" : ""});
  }
  page.Table({"view", "tilt, deg", "distance, m", "points left", "points right", "outliers",
              "rms left, px", "rms right, px", "held out"},
             rows);
  page.Paragraph(
      "Held-out views took no part in a second fit; the figure is their residual with its cameras. "
      "The result given here is the fit of all views.");
  if (!notes.unseen.empty()) {
    page.Paragraph("Pictures in which the target was not found:");
    page.List(notes.unseen);
  }
}

nlohmann::ordered_json ModelJson(const CahvorModel& model) {
  const auto vector = [](const Eigen::Vector3d& v) {
    return nlohmann::ordered_json::array({v.x(), v.y(), v.z()});
  };
  return {{"width_px", model.width}, {"height_px", model.height}, {"C_m", vector(model.C)},
          {"A", vector(model.A)},    {"H_px", vector(model.H)},   {"V_px", vector(model.V)},
          {"O", vector(model.O)},    {"R", vector(model.R)}};
}

/// JSON has no NaN: null.
nlohmann::ordered_json NumberOrNull(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

/// Root mean square with the outliers in it.
double RmsOfAll(const Calibration& calibration, int side) {
  double sum = 0;
  int count = 0;
  for (const auto* residuals : {&calibration.residuals, &calibration.rejected}) {
    for (const PointResidual& r : *residuals) {
      if (r.side == side && r.error_px.allFinite()) {
        sum += r.error_px.squaredNorm();
        ++count;
      }
    }
  }
  return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

double FocalShare(const Calibration& calibration) {
  double most = 0;
  for (const int side : {0, 1}) {
    for (const int index : {kHs, kVs}) {
      most = std::max(most, Sigma(calibration, index + (side == 0 ? 0 : kRightLens)) /
                                calibration.estimate.lens[static_cast<std::size_t>(side)][index]);
    }
  }
  return most;
}

}  // namespace

std::vector<Criterion> Acceptance(const Calibration& calibration) {
  const EpipolarCheck rows = CheckEpipolar(calibration);
  std::vector<Criterion> criteria;
  criteria.push_back({rows.rms_px <= kMostRowRms_px,
                      "rows of the aligned pictures agree to " + Fixed(rows.rms_px, 4) +
                          " px rms (limit " + Fixed(kMostRowRms_px, 2) + " px), " +
                          Fixed(rows.max_px, 3) + " px at most, over " +
                          std::to_string(rows.points) + " points"});
  if (std::isfinite(calibration.held_out_rms_px)) {
    const double fitted_px =
        std::hypot(calibration.left_rms_px, calibration.right_rms_px) / std::sqrt(2.0);
    criteria.push_back({calibration.held_out_rms_px <= kMostHeldOutRatio * fitted_px,
                        "views that were held out leave " + Fixed(calibration.held_out_rms_px, 4) +
                            " px rms, all views " + Fixed(fitted_px, 4) +
                            " px (limit 1.5 times as much); their rows agree to " +
                            Fixed(rows.held_out_rms_px, 4) + " px rms"});
  }
  const std::vector<std::string> contradictions = Contradictions(calibration);
  for (const std::string& sentence : contradictions) {
    criteria.push_back({false, sentence});
  }
  if (contradictions.empty()) {
    criteria.push_back({true, "every picture fits: none has more than 25 % outliers"});
  }
  const double focal = FocalShare(calibration);
  criteria.push_back({focal <= kMostFocalShare, "focal lengths are known to " + Percent(focal) +
                                                    ", 1 sigma (limit " + Percent(kMostFocalShare) +
                                                    ")"});
  const double baseline = calibration.baseline_sigma_m() / calibration.baseline_m();
  criteria.push_back(
      {baseline <= kMostBaselineShare, "the baseline is known to " + Percent(baseline) +
                                           ", 1 sigma (limit " + Percent(kMostBaselineShare) +
                                           "), beside the error of the target's pitch"});
  return criteria;
}

std::string CalibrationToJson(const Calibration& calibration, const CalibrationTarget& target,
                              const CalibrationNotes& notes) {
  const EpipolarCheck rows = CheckEpipolar(calibration);
  nlohmann::ordered_json json;
  json["frame"] = "left camera axes: x right, y down, z forward; metres";
  json["target"] = {{"file", notes.target_file},
                    {"kind", target.kind == TargetKind::kDots ? "dots" : "chessboard"},
                    {"columns", target.columns},
                    {"rows", target.rows},
                    {"pitch_m", target.pitch_m}};
  json["left"] = ModelJson(calibration.LeftModel());
  json["right"] = ModelJson(calibration.RightModel());
  json["baseline_m"] = calibration.baseline_m();
  json["baseline_sigma_m"] = calibration.baseline_sigma_m();
  json["sigma_px"] = calibration.sigma_px;
  json["left_rms_px"] = NumberOrNull(calibration.left_rms_px);
  json["right_rms_px"] = NumberOrNull(calibration.right_rms_px);
  json["left_rms_with_outliers_px"] = NumberOrNull(RmsOfAll(calibration, 0));
  json["right_rms_with_outliers_px"] = NumberOrNull(RmsOfAll(calibration, 1));
  json["held_out_rms_px"] = NumberOrNull(calibration.held_out_rms_px);
  json["epipolar_row_rms_px"] = NumberOrNull(rows.rms_px);
  json["epipolar_row_max_px"] = NumberOrNull(rows.max_px);
  json["epipolar_row_held_out_rms_px"] = NumberOrNull(rows.held_out_rms_px);
  json["points"] = calibration.points;
  json["outliers"] = calibration.outliers;
  for (const Criterion& criterion : Acceptance(calibration)) {
    json["acceptance"].push_back({{"passed", criterion.passed}, {"text", criterion.text}});
  }
  for (const Parameter& p : ParametersOf(calibration)) {
    json["parameters"].push_back({{"name", p.name}, {"value", p.value}, {"sigma", p.sigma}});
  }
  // In the fitted units: the rotation's small angles are radians.
  for (int i = 0; i < kCameraSize; ++i) {
    auto row = nlohmann::ordered_json::array();
    for (int j = 0; j < kCameraSize; ++j) {
      row.push_back(calibration.covariance(i, j));
    }
    json["covariance_rotation_rad"].push_back(row);
  }
  for (const ViewResult& v : calibration.views) {
    json["views"].push_back({{"name", v.name},
                             {"tilt_deg", Deg(v.tilt_rad)},
                             {"distance_m", v.distance_m},
                             {"left_points", v.left_points},
                             {"right_points", v.right_points},
                             {"right_name", v.right_name},
                             {"outliers", v.outliers()},
                             {"left_outliers", v.left_outliers},
                             {"right_outliers", v.right_outliers},
                             {"left_rms_px", NumberOrNull(v.left_rms_px)},
                             {"right_rms_px", NumberOrNull(v.right_rms_px)},
                             {"held_out", v.held_out},
                             {"held_out_rms_px", NumberOrNull(v.held_out_rms_px)}});
  }
  json["unseen"] = notes.unseen;
  json["next_view"] = NextView(calibration);
  // File names may hold bytes that are no UTF-8.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string CalibrationToHtml(const Calibration& calibration, const CalibrationTarget& target,
                              const CalibrationNotes& notes) {
  HtmlPage page("Stereo calibration");
  page.Paragraph(std::to_string(calibration.views.size()) + " views of " +
                 std::to_string(target.columns) + " x " + std::to_string(target.rows) +
                 (target.kind == TargetKind::kDots ? " dots" : " inner corners") + ", pitch " +
                 Fixed(1000 * target.pitch_m, 3) + " mm (" + notes.target_file + "); " +
                 std::to_string(calibration.points) + " points, " +
                 std::to_string(calibration.outliers) +
                 (calibration.outliers == 1 ? " of them taken out as outlier."
                                            : " of them taken out as outliers."));
  for (const Criterion& criterion : Acceptance(calibration)) {
    page.Verdict(criterion.passed, criterion.text);
  }
  page.Heading("What to do next");
  page.Paragraph(NextView(calibration));
  AddMaps(calibration, page);
  AddResiduals(calibration, page);
  AddViews(calibration, notes, page);
  AddParameters(calibration, page);
  return page.Text();
}

}  // namespace palace
