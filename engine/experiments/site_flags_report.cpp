// How the table of `evaluate site-flags` is read.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text.h"
#include "engine/experiments/evaluate_site_flags.h"
#include "engine/report/statistics.h"

namespace palace {
namespace {

constexpr double kFalseLimit = 0.001;  // of the cells, where there is nothing
constexpr double kAlong_deg = 15;      // wires nearer to the baseline's direction count apart

using Rows = std::vector<std::vector<std::string>>;

/// "97 % (92-99), 31 of 32" of the rows that pass; found is half of what should be flagged.
std::string Found(const TrialTable& table, const std::function<bool(double direction)>& passes) {
  const std::vector<double> shares = table.Numbers("share");
  const std::vector<double> directions = table.Numbers("direction_deg");
  int hits = 0, count = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (std::isfinite(shares[k]) && passes(directions[k])) {
      ++count;
      hits += shares[k] >= 0.5 ? 1 : 0;
    }
  }
  const Interval interval = WilsonInterval(hits, count);
  return count == 0
             ? "-"
             : OrDash("%.0f %% (", 100.0 * hits / count) + OrDash("%.0f-", 100 * interval.low) +
                   OrDash("%.0f), ", 100 * interval.high) + std::to_string(hits) + " of " +
                   std::to_string(count);
}

bool Any(double) { return true; }
bool Across(double direction_deg) { return direction_deg >= kAlong_deg; }
bool Along(double direction_deg) { return direction_deg < kAlong_deg; }

void ReportWires(const TrialTable& wires, ExperimentReport& report) {
  Rows rows;
  for (const std::string& size : wires.Values("size")) {
    for (const std::string& grey : wires.Values("grey")) {
      const TrialTable part = wires.Where("size", size).Where("grey", grey);
      std::vector<std::string> row = {size, grey};
      for (const char* texture : {"cloud", "gravel", "grass", "asphalt"}) {
        row.push_back(Found(part.Where("texture", texture), Across));
      }
      row.push_back(Found(part, Across));
      row.push_back(Found(part, Along));
      report.lines.push_back("wire " + size + " cm, grey " + grey + ": found " + row[6] +
                             "; within 15 deg of the baseline " + row[7]);
      rows.push_back(std::move(row));
    }
  }
  report.page.Heading("Wires").Table(
      {"thickness, cm", "grey", "cloud", "gravel", "grass", "asphalt", "all, from 15 degrees",
       "within 15 degrees of the baseline"},
      rows);
  rows.clear();
  for (const std::string& height : wires.Values("height_ft")) {
    for (const std::string& tilt : wires.Values("tilt_deg")) {
      const TrialTable part = wires.Where("height_ft", height).Where("tilt_deg", tilt);
      rows.push_back({height, tilt, Found(part, Across)});
      report.lines.push_back("wires from " + height + " ft, tilt " + tilt + " deg: found " +
                             rows.back()[2]);
    }
  }
  report.page.Table({"height, ft", "tilt, degrees", "found, from 15 degrees"}, rows);
}

void ReportOtherThings(const TrialTable& table, ExperimentReport& report) {
  struct Kind {
    const char *name, *size, *unit;
  };
  Rows rows;
  for (const Kind& kind : {Kind{"pool", "diameter", "m"},
                           {"walker", "speed", "m/s"},
                           {"painted line", "width", "cm"}}) {
    const TrialTable part = table.Where("thing", kind.name);
    for (const std::string& size : part.Values("size")) {
      const std::string named = std::string(kind.size) + " " + size + " " + kind.unit;
      rows.push_back({kind.name, named, Found(part.Where("size", size), Any)});
      report.lines.push_back(std::string(kind.name) + ", " + named + ": flagged " + rows.back()[2]);
    }
  }
  report.page.Heading("Other things")
      .Paragraph("A painted line should not be flagged.")
      .Table({"thing", "size", "flagged"}, rows);
}

void ReportNothing(const TrialTable& nothing, ExperimentReport& report) {
  Rows rows;
  const auto falses = [&](const TrialTable& part, const std::string& name) {
    const double cells = part.Sum("cells");
    std::vector<std::string> row = {name};
    double worst = 0;
    for (const char* column : {"thin_cells", "bare_cells", "motion_cells", "shadow_cells"}) {
      const double share = part.Sum(column) / cells;
      row.push_back(OrDash("%.4f %%", 100 * share));
      worst = column == std::string("shadow_cells") ? worst : std::max(worst, share);
    }
    report.lines.push_back("nothing there, " + name + ": thin " + row[1] + ", no texture " +
                           row[2] + ", motion " + row[3] + ", shadow " + row[4] + " of the cells");
    rows.push_back(std::move(row));
    return worst;
  };
  for (const std::string& texture : nothing.Values("texture")) {
    falses(nothing.Where("texture", texture), texture);
  }
  const double worst = falses(nothing, "all");
  report.page.Heading("Where there is nothing")
      .Table({"ground", "thin structure", "no texture", "motion", "shadow"}, rows);
  report.passed = !(worst > kFalseLimit);
  report.page.Verdict(report.passed, "At most " + OrDash("%.1f %%", 100 * kFalseLimit) +
                                         " of the cells flagged falsely, each kind by itself");
}

}  // namespace

ExperimentReport ReportSiteFlags(const TrialTable& table) {
  ExperimentReport report{HtmlPage("Flags from pictures and motion")};
  report.page.Paragraph(
      "Found: at least half of the cells that should carry the flag do. Wires run across the "
      "picture; direction is counted from the baseline's, 0 degrees along it. Intervals: Wilson, "
      "95 %.");
  ReportWires(table.Where("thing", "wire"), report);
  ReportOtherThings(table, report);
  ReportNothing(table.Where("thing", "nothing"), report);
  return report;
}

}  // namespace palace
