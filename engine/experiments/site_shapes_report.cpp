// How the table of `evaluate site-shapes` is read.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text.h"
#include "engine/experiments/evaluate_site_shapes.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

constexpr const char* kFused = "10";
constexpr std::array kTopNames = {"table", "roof", "platform"};
/// Of which 99 % must be found.
constexpr std::array kWanted = {"cube 6 in", "square 4 in high 0.30 m",
                                "rectangle 4 in high 0.30 x 0.60 m", "cylinder 4 in high 0.30 m"};
constexpr double kLeastFound = 0.99, kMostRefused = 0.01, kMostSlopeError_deg = 1.5;

/// found of tested with its interval.
struct Share {
  explicit Share(const TrialTable& rows, const char* column = "found")
      : hits(rows.Sum(column)), trials(rows.Sum("tested")) {}
  double hits, trials;
  double value() const { return trials > 0 ? hits / trials : NAN; }
  Interval interval() const {
    return WilsonInterval(static_cast<int>(hits), static_cast<int>(trials));
  }
  std::string percent() const { return OrDash("%.2f", 100 * value()); }
  std::string wilson() const {
    return OrDash("%.2f", 100 * interval().low) + " to " + OrDash("%.2f", 100 * interval().high);
  }
  std::string count() const { return OrDash("%.0f", hits) + " of " + OrDash("%.0f", trials); }
};

TrialTable Of(const TrialTable& table, const std::string& shape, const std::string& frames) {
  return table.Where("shape", shape).Where("frames", frames);
}
TrialTable At(const TrialTable& table, const std::string& limit_cm) {
  return table.Where("limit_cm", limit_cm);
}
std::string Chosen() { return CsvNumber(100 * kShapesLimit_m); }

bool IsTopName(const std::string& name) {
  return std::find(kTopNames.begin(), kTopNames.end(), name) != kTopNames.end();
}

/// Names of the shapes that are found or missed.
std::vector<std::string> ObjectNames(const TrialTable& table) {
  std::vector<std::string> names;
  for (const std::string& name : table.Values("shape")) {
    if (!IsTopName(name) && name != "ramp" && name != kClearFootprints && name != kClearCells &&
        name != kGroundSlope && name != kChosenSite && name.rfind("refused", 0) != 0) {
      names.push_back(name);
    }
  }
  return names;
}

std::vector<std::vector<std::string>> DetectionRows(const TrialTable& table) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& name : ObjectNames(table)) {
    const TrialTable fused = At(Of(table, name, kFused), Chosen());
    const Share all(fused), one(At(Of(table, name, "1"), Chosen()));
    std::vector<std::string> row = {name, all.count(), all.percent(), all.wilson(), one.percent()};
    for (const char* texture : {"gravel", "grass", "asphalt", "cloud"}) {
      row.push_back(Share(fused.Where("texture", texture)).percent());
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Share found against the limit, one line a shape.
LinePlot PlotByLimit(const TrialTable& table) {
  LinePlot plot{
      "Found and refused against the roughness limit", "limit on roughness, cm", "share, %", {}};
  std::vector<std::string> names = ObjectNames(table);
  names.push_back(kClearFootprints);
  for (const std::string& name : names) {
    const TrialTable rows = Of(table, name, kFused);
    PlotSeries series{.name = name, .x = {}, .y = {}};
    for (const std::string& limit_cm : table.Values("limit_cm")) {
      const Share share(At(rows, limit_cm));
      series.x.push_back(std::atof(limit_cm.c_str()));
      series.y.push_back(100 * share.value());
      series.low.push_back(100 * share.interval().low);
      series.high.push_back(100 * share.interval().high);
    }
    plot.series.push_back(std::move(series));
  }
  plot.y_min = 0;
  plot.y_max = 100;
  return plot;
}

/// Found against refused: one line a shape, one point a limit.
LinePlot PlotTrade(const TrialTable& table) {
  LinePlot plot{
      "Detection against false alarm", "truly clear footprints refused, %", "found, %", {}};
  for (const char* name : kWanted) {
    PlotSeries series{.name = name, .x = {}, .y = {}};
    for (const std::string& limit_cm : table.Values("limit_cm")) {
      series.x.push_back(100 * Share(At(Of(table, kClearFootprints, kFused), limit_cm)).value());
      series.y.push_back(100 * Share(At(Of(table, name, kFused), limit_cm)).value());
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

std::vector<double> Errors(const TrialTable& table, const char* name, const char* frames) {
  std::vector<double> errors = Of(table, name, frames).Numbers("error_deg");
  for (double& error : errors) {
    error = std::abs(error);
  }
  return errors;
}

int CountWithin(const std::vector<double>& errors, double limit) {
  return static_cast<int>(
      std::count_if(errors.begin(), errors.end(), [&](double e) { return e <= limit; }));
}

std::vector<std::vector<std::string>> SlopeRows(const TrialTable& table) {
  std::vector<std::vector<std::string>> rows;
  for (const char* name : {kGroundSlope, "ramp"}) {
    for (const char* frames : {kFused, "1"}) {
      const std::vector<double> errors = Errors(table, name, frames);
      const int within = CountWithin(errors, kMostSlopeError_deg);
      const int count = static_cast<int>(errors.size());
      const Interval interval = WilsonInterval(within, count);
      rows.push_back(
          {name, frames, std::to_string(count), OrDash("%.2f", Percentile(errors, 0.5)),
           OrDash("%.2f", Percentile(errors, 0.95)), OrDash("%.2f", Percentile(errors, 1)),
           std::to_string(within) + " of " + std::to_string(count),
           OrDash("%.1f", 100 * interval.low) + " to " + OrDash("%.1f", 100 * interval.high)});
    }
  }
  return rows;
}

std::vector<std::vector<std::string>> TopRows(const TrialTable& table) {
  std::vector<std::vector<std::string>> rows;
  for (const char* name : kTopNames) {
    const TrialTable part = At(Of(table, name, kFused), Chosen());
    rows.push_back({name, OrDash("%.0f", part.Sum("tested")), Share(part, "elevated").percent(),
                    Share(part).percent(), Share(part, "accepted").percent()});
  }
  return rows;
}

class Findings {
 public:
  explicit Findings(ExperimentReport& report) : report_(report) {}
  void Judge(bool passed, const std::string& text) {
    report_.page.Verdict(passed, text);
    report_.lines.push_back((passed ? "ok    " : "FAIL  ") + text);
    report_.passed = report_.passed && passed;
  }

 private:
  ExperimentReport& report_;
};

/// Which footprints were refused, by cause and by texture.
std::string CausesText(const TrialTable& table) {
  std::string causes = "refused by";
  for (const char* cause : {kRefusedByHeight, kRefusedByFlags, kRefusedByUnknown, kRefusedByOdds}) {
    causes += std::string(" ") + (cause + 11) + " " +
              OrDash("%.0f", At(Of(table, cause, kFused), Chosen()).Sum("tested")) + ";";
  }
  for (const char* texture : {"gravel", "grass", "asphalt", "cloud"}) {
    const TrialTable part = Of(table, kClearFootprints, kFused).Where("texture", texture);
    causes += std::string(" on ") + texture + " " + Share(At(part, Chosen())).count() + ";";
  }
  return causes;
}

void JudgeFootprints(const TrialTable& table, ExperimentReport& report, Findings& findings) {
  const Share refused(At(Of(table, kClearFootprints, kFused), Chosen()));
  findings.Judge(refused.value() <= kMostRefused,
                 "clear footprints refused: " + refused.count() + " (" + refused.percent() +
                     " %, 95 % interval " + refused.wilson() + "), at most 1 %");
  report.lines.push_back(CausesText(table));
  report.page.Paragraph(report.lines.back());
}

void JudgeShapes(const TrialTable& table, Findings& findings) {
  for (const char* name : kWanted) {
    const Share found(At(Of(table, name, kFused), Chosen()));
    if (At(Of(table, name, kFused), Chosen()).rows.empty()) {
      findings.Judge(false,
                     std::string(name) + ": none among these fields, more trials are needed");
      continue;
    }
    findings.Judge(found.value() >= kLeastFound,
                   std::string(name) + ": " + found.count() + " found (" + found.percent() +
                       " %, 95 % interval " + found.wilson() + "), at least 99 %");
  }
}

void JudgeSlopes(const TrialTable& table, Findings& findings) {
  const std::vector<double> slopes = Errors(table, kGroundSlope, kFused);
  findings.Judge(!slopes.empty() && Percentile(slopes, 1) <= kMostSlopeError_deg,
                 "slope of footprints: error at most " + OrDash("%.2f", Percentile(slopes, 1)) +
                     " deg over " + std::to_string(slopes.size()) + " (limit 1.5 deg; thesis 5)");
}

void ReportSites(const TrialTable& table, ExperimentReport& report) {
  const Share site(Of(table, kChosenSite, kFused));
  std::string held;
  for (const std::string& name : table.Values("held")) {
    const TrialTable part = Of(table.Where("held", name), kChosenSite, kFused);
    held += name == "-" ? "" : " " + std::to_string(part.rows.size()) + " " + name + ";";
  }
  report.lines.push_back(
      "chosen sites with an object or an edge in the lander's circle: " + site.count() + held);
  report.page.Paragraph("False-safe: " + report.lines.back() +
                        ". On the fields of objects every circle holds some, so a site there is a "
                        "miss of them all.");
}

void ReportObjects(const TrialTable& table, ExperimentReport& report) {
  const Share cells(At(Of(table, kClearCells, kFused), Chosen()));
  report.lines.push_back("clear cells called hazards: " + cells.count() + " (" + cells.percent() +
                         " %)");
  const std::vector<std::vector<std::string>> rows = DetectionRows(table);
  for (const auto& row : rows) {
    report.lines.push_back(row[0] + ": " + row[1] + " = " + row[2] + " % (" + row[3] +
                           "), one frame " + row[4] + " %");
  }
  report.page.Heading("Objects").Table({"shape", "found", "%", "95 % interval", "one frame, %",
                                        "gravel, %", "grass, %", "asphalt, %", "cloud, %"},
                                       rows);
  report.page.Figure(LinePlotSvg(PlotByLimit(table)), "Ten fused frames, with 95 % intervals.")
      .Figure(LinePlotSvg(PlotTrade(table)), "One point a limit, from 12 cm (left) to 3 cm.");
}

void ReportLimits(const TrialTable& table, HtmlPage& page) {
  std::vector<std::vector<std::string>> limits;
  for (const std::string& limit_cm : table.Values("limit_cm")) {
    const Share footprints(At(Of(table, kClearFootprints, kFused), limit_cm));
    const Share clear(At(Of(table, kClearCells, kFused), limit_cm));
    limits.push_back({limit_cm, footprints.count(), footprints.percent(), footprints.wilson(),
                      OrDash("%.4f", 100 * clear.value())});
  }
  page.Heading("False alarm by limit")
      .Table({"limit, cm", "clear footprints refused", "%", "95 % interval",
              "clear cells called hazards, %"},
             limits);
}

void ReportSlopesAndTops(const TrialTable& table, ExperimentReport& report) {
  const std::vector<std::vector<std::string>> slopes = SlopeRows(table), tops = TopRows(table);
  report.page.Heading("Slopes").Table({"of", "frames", "count", "median error, °", "95 %, °",
                                       "largest, °", "within 1.5°", "95 % interval, %"},
                                      slopes);
  report.page.Heading("Raised tops")
      .Paragraph("Cells well inside the top, away from what stands on it.")
      .Table({"top", "cells", "called elevated, %", "hazards under avoid, %",
              "no hazard under allow, %"},
             tops);
  for (const auto& row : tops) {
    report.lines.push_back(row[0] + " top: " + row[2] + " % called elevated, " + row[3] +
                           " % hazards under avoid, " + row[4] + " % free under allow");
  }
  for (const auto& row : slopes) {
    report.lines.push_back(row[0] + ", " + row[1] + " frames: median " + row[3] + ", 95 % " +
                           row[4] + ", largest " + row[5] + " deg of " + row[2]);
  }
}

}  // namespace

ExperimentReport ReportSiteShapes(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: known shapes")};
  report.page.Paragraph(
      "Fields of known shapes in rendered pairs (640 x 480, baseline 1 m, nadir hover with drift, "
      "attitude motion and pose errors), ten frames fused. Found: a hazard that is known in a cell "
      "whose centre lies within one cell of the object's outline. Refused: a circle of the clear "
      "radius on even ground of 0 to 7 degrees, seen whole and without objects, where the lander "
      "may not be sent; circles lie a lander radius apart, so neighbours share errors and the "
      "intervals are narrower than independent circles would give. Objects stand on level ground, "
      "at any heading, on four textures. Unless said otherwise the limit on roughness is " +
      Chosen() + " cm and that on steps 1.5 times as much.");
  report.page.Heading("Must show");
  Findings findings(report);
  JudgeFootprints(table, report, findings);
  JudgeShapes(table, findings);
  JudgeSlopes(table, findings);
  ReportSites(table, report);
  ReportObjects(table, report);
  ReportLimits(table, report.page);
  ReportSlopesAndTops(table, report);
  return report;
}

}  // namespace palace
