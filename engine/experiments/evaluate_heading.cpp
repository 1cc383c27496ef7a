#include "engine/experiments/evaluate_heading.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/text.h"
#include "engine/experiments/heading_case.h"
#include "engine/experiments/heading_reference.h"
#include "engine/model/settings/settings.h"
#include "engine/report/figure_text.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

double Clockwise_deg(double heading_rad) {
  const double deg = Deg(WrapAngle(heading_rad));
  return deg < -1e-9 ? deg + 360 : std::max(deg, 0.0);
}

TrialRow RowOf(const HeadingCase& one) {
  const HeadingConditions& now = one.conditions;
  const auto deg = [](double rad) { return CsvNumber(Clockwise_deg(rad)); };
  return {one.name,
          CsvNumber(now.wind_mps),
          deg(now.wind_from_rad),
          deg(now.sun_azimuth_rad),
          CsvNumber(Deg(now.sun_elevation_rad)),
          deg(now.wanted_rad),
          one.clear,
          deg(one.heading_rad),
          one.side,
          one.reason,
          CsvNumber(one.tailwind_mps),
          CsvNumber(one.over_limit_mps),
          CsvNumber(kTailwindOfNearest * now.wind_mps),
          one.flies_blocked ? "1" : "0",
          CsvNumber(one.curve_error),
          one.agrees ? "1" : "0"};
}

double OffTheWind_deg(double heading_deg, double wind_from_deg) {
  return std::abs(std::remainder(heading_deg - wind_from_deg, 360));
}

std::string CoursePlot(const TrialTable& drawn) {
  LinePlot plot{.title = "Chosen course against the wind",
                .x_label = "wind, m/s",
                .y_label = "course off the wind, deg (0: into it)"};
  for (const char* reason : kCourseReasons) {
    const TrialTable rows = drawn.Where("reason", reason);
    PlotSeries& series = plot.series.emplace_back();
    series.name = reason;
    series.line = false;
    series.x = rows.Numbers("wind_mps");
    const std::vector<double> heading = rows.Numbers("heading_deg"),
                              from = rows.Numbers("wind_from_deg");
    for (std::size_t i = 0; i < heading.size(); ++i) {
      series.y.push_back(OffTheWind_deg(heading[i], from[i]));
    }
  }
  plot.y_min = 0;
  plot.y_max = 180;
  return LinePlotSvg(plot);
}

int CountOf(const TrialTable& rows) { return static_cast<int>(rows.rows.size()); }

std::string WorstText(const TrialTable& drawn, const std::vector<double>& over) {
  std::size_t worst = over.size();
  for (std::size_t i = 0; i < over.size(); ++i) {
    if (std::isfinite(over[i]) && (worst == over.size() || over[i] > over[worst])) {
      worst = i;
    }
  }
  if (worst == over.size()) {
    return "No case in which a clear course keeps the limit";
  }
  const std::vector<std::string>& row = drawn.rows[worst];
  const auto number = [&](const char* column) { return drawn.Numbers(column)[worst]; };
  return "Worst case, seed " + row[1] + ": wind " +
         WithNumbers("%.1f m/s from %03.0f deg", number("wind_mps"), number("wind_from_deg")) +
         WithNumbers(", wanted %03.1f deg, flown %03.1f deg", number("wanted_deg"),
                     number("heading_deg")) +
         WithNumbers("; tailwind %.2f m/s, %+.2f m/s of the limit", number("tailwind_mps"),
                     over[worst]);
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: the course of an approach by wind, sun and obstacles")};
  const TrialTable drawn = table.Where("case", kDrawnCase);
  const TrialTable listed = table.WhereNot("case", kDrawnCase);
  const TrialTable flown = drawn.WhereNot("reason", kCourseRefused);
  const int cases = CountOf(drawn), flown_cases = CountOf(flown);
  const std::vector<double> over = drawn.Numbers("over_limit_mps"),
                            of_nearest = drawn.Numbers("nearest_mps");
  int keepable = 0, above = 0, far_above = 0;
  for (std::size_t i = 0; i < over.size(); ++i) {
    keepable += std::isfinite(over[i]) ? 1 : 0;
    above += over[i] > 1e-9 ? 1 : 0;
    far_above += over[i] > of_nearest[i] + 1e-9 ? 1 : 0;
  }
  const int blocked = CountOf(drawn.Where("flies_blocked", "1"));
  const int disagrees = CountOf(drawn.Where("agrees", "0"));
  const int unlisted = CountOf(listed.Where("agrees", "0"));
  const std::vector<double> errors = table.Numbers("curve_error");
  const double worst_error = errors.empty() ? NAN : *std::max_element(errors.begin(), errors.end());
  report.Judge(blocked == 0,
               "Never a blocked side, and the best of the curve never vetoed; else, of the cases "
               "that were flown: " +
                   ShareText(blocked, flown_cases, 1));
  report.Judge(far_above == 0,
               "Never more tailwind than the limit where a clear course keeps it, but for what the "
               "nearest of 72 courses rounds; else, of the cases with such a course: " +
                   ShareText(far_above, keepable, 1));
  report.Judge(worst_error <= kReferenceTolerance,
               "The curve equals the slow reference; off by at most " +
                   WithNumbers("%.1e, tolerance %.0e", worst_error, kReferenceTolerance));
  report.Judge(
      disagrees == 0,
      "Always the course that the reference leads to; else, of the cases that were flown: " +
          ShareText(disagrees, flown_cases, 1));
  report.Judge(unlisted == 0,
               WithNumbers("The headings that the reference lists; others: %.0f of %.0f", unlisted,
                           CountOf(listed)));
  std::vector<std::string> told = {
      "More tailwind than the limit although a clear course keeps it, by however little: " +
          ShareText(above, keepable, 1),
      WorstText(drawn, over)};
  for (const char* reason : kCourseReasons) {
    told.push_back(std::string(reason) + ": " +
                   ShareText(CountOf(drawn.Where("reason", reason)), cases, 1));
  }
  report.lines.insert(report.lines.end(), told.begin(), told.end());
  report.page.List(told).Figure(
      CoursePlot(drawn), "Every drawn case, by why its course was chosen. 180 deg: from behind.");
  std::vector<std::vector<std::string>> rows;
  for (const std::vector<std::string>& row : listed.rows) {
    const auto cell = [&](const char* column) { return row[listed.Index(column)]; };
    rows.push_back({cell("case"), cell("sun_azimuth_deg"), cell("sun_elevation_deg"),
                    cell("wind_from_deg"), cell("wind_mps"), cell("wanted_deg"), cell("reason"),
                    cell("heading_deg")});
  }
  report.page.Heading("The reference's seven cases")
      .Table({"Case", "Sun from, deg", "Sun up, deg", "Wind from, deg", "Wind, m/s", "Wanted, deg",
              "Reference", "Chosen, deg"},
             rows)
      .Paragraph(
          "Drawn evenly: wind 0 to 15 m/s, its bearing, the sun's bearing and height of -20 to 85 "
          "deg, the straight course (the one that is wanted), and for each case the share of clear "
          "corridors among the straight one and eight sectors. Shares with 95 % intervals "
          "(Wilson). The slow reference sums each centroid over 4000 slices, from the sentences of "
          "the reference alone.");
  return report;
}

}  // namespace

Experiment HeadingExperiment() {
  auto limit_mps = std::make_shared<double>(MissionSettings{}.max_tailwind_mps);
  Experiment experiment;
  experiment.name = "heading";
  experiment.purpose = "Courses chosen in drawn wind, sun and obstacles, beside a slow reference";
  experiment.default_trials = 500;
  experiment.columns = {"case",
                        "wind_mps",
                        "wind_from_deg",
                        "sun_azimuth_deg",
                        "sun_elevation_deg",
                        "wanted_deg",
                        "clear",
                        "heading_deg",
                        "side",
                        "reason",
                        "tailwind_mps",
                        "over_limit_mps",
                        "nearest_mps",
                        "flies_blocked",
                        "curve_error",
                        "agrees"};
  experiment.add_options = [limit_mps](CLI::App& verb) {
    verb.add_option("--max-tailwind", *limit_mps, "Limit of an approach, m/s")
        ->check(FiniteRange(0, 15))
        ->capture_default_str();
  };
  experiment.setup = [limit_mps] { return "max tailwind " + CsvNumber(*limit_mps) + " m/s"; };
  experiment.run = [limit_mps](int trial, std::uint64_t seed) -> Result<std::vector<TrialRow>> {
    std::vector<TrialRow> rows = {RowOf(DrawnHeadingCase(seed, *limit_mps))};
    if (trial == 0) {
      for (const HeadingCase& listed : ListedHeadingCases()) {
        rows.push_back(RowOf(listed));
      }
    }
    return rows;
  };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
