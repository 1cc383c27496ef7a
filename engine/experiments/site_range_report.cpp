#include "engine/experiments/site_range_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

constexpr std::array kMethods = {kFused, kOneFrame, kThesisMode};

constexpr int kPooledSites = 3000;         // needed to speak of one in a thousand
constexpr double kFalseSafeLimit = 0.001;  // of confirmed sites

/// Least share of right sites among tall cones; thesis Table 4.5 beside it where it has a row.
struct Target {
  double altitude_ft;
  double least;   ///< 0: none
  double thesis;  ///< percent; NaN: not flown
};
const std::array<Target, 9> kTargets = {{{10, 0, NAN},
                                         {20, 0.99, NAN},
                                         {30, 0.99, 85},
                                         {40, 0.99, 89},
                                         {50, 0.99, 100},
                                         {60, 0.99, 98},
                                         {70, 0.98, 65},
                                         {100, 0.95, NAN},
                                         {150, 0, NAN}}};

/// "99.3 % (97.6-99.8)".
std::string ShareText(int hits, int count) {
  const Interval interval = WilsonInterval(hits, count);
  return count == 0
             ? "-"
             : OrDash("%.1f %% (", 100.0 * hits / count) + OrDash("%.1f-", 100 * interval.low) +
                   OrDash("%.1f)", 100 * interval.high);
}

int Count(const TrialTable& table, const char* column, const char* text) {
  return static_cast<int>(table.Where(column, text).rows.size());
}

/// The rows of one altitude by one method.
struct AltitudeFigures {
  int trials = 0, right = 0, wrong = 0, none = 0;
  int confirmed = 0, wrong_confirmed = 0;
  double refused = NAN;        ///< share of the truly safe cells
  double three_sigma_m = NAN;  ///< of the site's height, median
};

AltitudeFigures FiguresOf(const TrialTable& rows) {
  AltitudeFigures cell;
  cell.trials = static_cast<int>(rows.rows.size());
  cell.right = Count(rows, "outcome", kRightSite);
  cell.wrong = Count(rows, "outcome", kWrongSite);
  cell.none = Count(rows, "outcome", kNoSite);
  const TrialTable confirmed = rows.Where("standing", kConfirmed);
  cell.confirmed = static_cast<int>(confirmed.rows.size());
  cell.wrong_confirmed = Count(confirmed, "outcome", kWrongSite);
  const double safe = rows.Sum("safe_cells");
  cell.refused = safe > 0 ? rows.Sum("refused_cells") / safe : NAN;
  std::vector<double> sigmas;
  for (const double sigma : rows.Numbers("three_sigma_m")) {
    if (std::isfinite(sigma)) {
      sigmas.push_back(sigma);
    }
  }
  cell.three_sigma_m = Percentile(sigmas, 0.5);
  return cell;
}

const Target* TargetAt(double altitude_ft) {
  const auto target = std::find_if(kTargets.begin(), kTargets.end(), [&](const Target& t) {
    return std::abs(t.altitude_ft - altitude_ft) < 0.5;
  });
  return target == kTargets.end() ? nullptr : &*target;
}

double AltitudeOf(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

void AddCones(const TrialTable& table, const std::string& cone_in, ExperimentReport& report) {
  const TrialTable all = table.Where("cone_in", cone_in);
  LinePlot plot{"Right sites, cones of " + cone_in + " in", "altitude, ft", "right sites, %"};
  plot.y_min = 0;
  plot.y_max = 100;
  std::vector<std::vector<std::string>> rows;
  for (const char* method : kMethods) {
    const TrialTable part = all.Where("method", method);
    PlotSeries series{.name = method, .x = {}, .y = {}};
    for (const std::string& altitude : part.Values("altitude_ft")) {
      const AltitudeFigures cell = FiguresOf(part.Where("altitude_ft", altitude));
      const Interval interval = WilsonInterval(cell.right, cell.trials);
      series.x.push_back(AltitudeOf(altitude));
      series.y.push_back(100.0 * cell.right / cell.trials);
      series.low.push_back(100 * interval.low);
      series.high.push_back(100 * interval.high);
      const Target* target = TargetAt(AltitudeOf(altitude));
      const std::string thesis = target != nullptr && method == std::string(kThesisMode)
                                     ? OrDash("%.0f %%", target->thesis)
                                     : "";
      rows.push_back({altitude, method, std::to_string(cell.trials),
                      ShareText(cell.right, cell.trials), std::to_string(cell.wrong),
                      std::to_string(cell.none), std::to_string(cell.confirmed),
                      std::to_string(cell.wrong_confirmed), OrDash("%.1f %%", 100 * cell.refused),
                      OrDash("%.1f", 100 * cell.three_sigma_m), thesis});
      report.lines.push_back(cone_in + " in, " + altitude + " ft, " + method + ": right " +
                             ShareText(cell.right, cell.trials) + ", wrong " +
                             std::to_string(cell.wrong) + ", none " + std::to_string(cell.none) +
                             ", confirmed " + std::to_string(cell.confirmed) + " (" +
                             std::to_string(cell.wrong_confirmed) + " wrong), refused " +
                             OrDash("%.1f %%", 100 * cell.refused) + ", 3 sigma " +
                             OrDash("%.1f cm", 100 * cell.three_sigma_m));
    }
    plot.series.push_back(std::move(series));
  }
  PlotSeries thesis{.name = "thesis, Table 4.5", .x = {}, .y = {}};
  for (const Target& target : kTargets) {
    if (std::isfinite(target.thesis)) {
      thesis.x.push_back(target.altitude_ft);
      thesis.y.push_back(target.thesis);
    }
  }
  plot.series.push_back(std::move(thesis));
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return AltitudeOf(a[0]) < AltitudeOf(b[0]);
  });
  report.page.Heading("Cones of " + cone_in + " in")
      .Figure(LinePlotSvg(plot), "Bars: 95 % intervals (Wilson).")
      .Table({"altitude, ft", "method", "trials", "right (95 % interval)", "wrong", "no site",
              "confirmed", "of them wrong", "truly safe cells refused", "3 sigma of height, cm",
              "thesis"},
             rows);
}

/// Verdicts on the altitudes that have a limit.
void AddTargets(const TrialTable& tall, ExperimentReport& report) {
  for (const std::string& altitude : tall.Values("altitude_ft")) {
    const Target* target = TargetAt(AltitudeOf(altitude));
    if (target == nullptr || target->least <= 0) {
      continue;
    }
    const AltitudeFigures cell = FiguresOf(tall.Where("altitude_ft", altitude));
    const bool passed = cell.right >= target->least * cell.trials;
    const std::string text = altitude + " ft: right sites " + ShareText(cell.right, cell.trials) +
                             ", wanted " + OrDash("%.0f %%", 100 * target->least);
    report.Judge(passed, text);
  }
}

/// Sites chosen that are not safe: confirmed and provisional ones apart, all cones and altitudes.
void AddFalseSafe(const TrialTable& fused, ExperimentReport& report) {
  for (const char* standing : {kConfirmed, kProvisional}) {
    const TrialTable sites = fused.Where("standing", standing);
    const int count = static_cast<int>(sites.rows.size());
    const int wrong = Count(sites, "outcome", kWrongSite);
    const std::string text = std::string("false-safe of ") + std::to_string(count) + " " +
                             standing + " sites: " + std::to_string(wrong) + ", " +
                             ShareText(wrong, count);
    if (standing == std::string(kConfirmed)) {
      const bool passed = count > 0 && wrong <= kFalseSafeLimit * count;
      report.Judge(passed, text + ", limit 0.1 % over at least " + std::to_string(kPooledSites) +
                               " chosen sites");
    } else {
      report.page.Paragraph(text);
      report.lines.push_back(text);
    }
    for (const auto& row : sites.Where("outcome", kWrongSite).rows) {
      report.lines.push_back("  wrong: seed " + row[sites.Index("seed")] + ", " +
                             row[sites.Index("altitude_ft")] + " ft, cones " +
                             row[sites.Index("cone_in")] + " in, " + row[sites.Index("texture")] +
                             ", true distance " + row[sites.Index("true_distance_m")] +
                             " m, claimed " + row[sites.Index("safe_distance_m")] + " m");
    }
  }
}

/// The altitude at which the median 3 sigma of height reaches a limit, by linear interpolation.
double DistanceAtSigma(const TrialTable& rows, double limit_m) {
  double below_ft = NAN, below_m = NAN;
  for (const std::string& altitude : rows.Values("altitude_ft")) {
    const double sigma_m = FiguresOf(rows.Where("altitude_ft", altitude)).three_sigma_m;
    if (sigma_m < limit_m) {
      below_ft = AltitudeOf(altitude);
      below_m = sigma_m;
    } else if (std::isfinite(sigma_m) && std::isfinite(below_ft)) {
      const double share = (limit_m - below_m) / (sigma_m - below_m);
      return (below_ft + share * (AltitudeOf(altitude) - below_ft)) * kMetresPerFoot;
    }
  }
  return below_ft * kMetresPerFoot;
}

void AddConfirmedDistance(const TrialTable& tall, ExperimentReport& report) {
  LinePlot plot{"Certainty of the chosen site", "altitude, ft", "3 sigma of height, cm"};
  plot.log_y = true;
  plot.limits = {{10, "roughness limit"}, {15, "6 in"}};
  std::vector<std::vector<std::string>> rows;
  for (const char* method : {kFused, kOneFrame}) {
    const TrialTable part = tall.Where("method", method);
    PlotSeries series{.name = method, .x = {}, .y = {}};
    for (const std::string& altitude : part.Values("altitude_ft")) {
      series.x.push_back(AltitudeOf(altitude));
      series.y.push_back(100 * FiguresOf(part.Where("altitude_ft", altitude)).three_sigma_m);
    }
    plot.series.push_back(std::move(series));
    rows.push_back({method, OrDash("%.1f m", DistanceAtSigma(part, 0.10)),
                    OrDash("%.1f m", DistanceAtSigma(part, 0.15))});
    report.lines.push_back(std::string(method) + ": 3 sigma of height is under 0.10 m up to " +
                           rows.back()[1] + ", under 0.15 m up to " + rows.back()[2]);
  }
  report.page.Heading("How far the noise of height lets a site be confirmed")
      .Figure(LinePlotSvg(plot), "Medians over the fields in which a site was found.")
      .Table({"method", "3 sigma < 0.10 m up to", "3 sigma < 0.15 m up to"}, rows)
      .Paragraph("Where it is nowhere exceeded, the largest altitude at which a site was found.");
}

}  // namespace

std::vector<std::string> SiteRangeColumns() {
  return {"altitude_ft",      "cone_in",         "method",          "texture",
          "slope_deg",        "outcome",         "standing",        "north_m",
          "east_m",           "true_distance_m", "safe_distance_m", "three_sigma_m",
          "safe_probability", "safe_cells",      "refused_cells",   "listed",
          "listed_unsafe",    "cell_m"};
}

ExperimentReport ReportSiteRange(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: the right site by altitude")};
  report.page.Paragraph(
      "Twelve road cones stand at random places in what both cameras see (640 x 480, baseline 1 m, "
      "straight down), on ground of random texture that slopes by 0 to 3°. One disc of the clear "
      "radius (lander radius and touchdown dispersion), 0.21 m wider, is kept free and lies in "
      "view, except where it does not fit: at 10 ft it never does, and there the figures stand as "
      "they are. Pictures are ray-cast with 2 grey levels of noise; the camera drifts by 0.2 m and "
      "1° (one sigma) between frames, and its pose is reported with errors of 3 cm and 0.1°.");
  report.page.Paragraph(
      "Right: the true disc of the clear radius about the chosen site holds no part of a cone, and "
      "the true slope is within the limit. No site counts as not right. The thesis's lens of 45° "
      "does not hold the disc of 4.6 m at 20 ft; this experiment takes 60° unless --fov-deg says "
      "otherwise. A trial is one field at every altitude, so --trials is the number of fields at "
      "each.");
  const TrialTable fused = table.Where("method", kFused);
  AddTargets(fused.Where("cone_in", "28"), report);
  AddFalseSafe(fused, report);
  for (const std::string& cone_in : table.Values("cone_in")) {
    AddCones(table, cone_in, report);
  }
  const auto sizes = table.Values("cone_in");
  if (!sizes.empty()) {
    AddConfirmedDistance(table.Where("cone_in", sizes.front()), report);
  }
  return report;
}

}  // namespace palace
