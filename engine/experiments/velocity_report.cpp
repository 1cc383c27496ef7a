#include "engine/experiments/velocity_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/text.h"
#include "engine/report/figure_text.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

constexpr std::array<LoopIntegral, 7> kIntegrals = {{{0.25, true},
                                                     {0.8, true},
                                                     {0.25, false},
                                                     {0.5, false},
                                                     {0.8, false},
                                                     {0.9, false},
                                                     {1, false}}};
constexpr const LoopIntegral& kOfFile = kIntegrals[0];
/// About the highest on which GPS still flies quietly.
constexpr const LoopIntegral& kSuitsGps = kIntegrals[4];
constexpr std::array kAxes = {"north", "east", "down"};

std::string NameOf(const LoopIntegral& integral) {
  return WithNumbers("%.2f", integral.gain_per_s2) + (integral.freezes ? " frozen" : " winds up");
}

TrialTable RowsOf(const TrialTable& table, const char* method, const LoopIntegral& integral,
                  const char* which = "loop") {
  return table.Where("case", which).Where("method", method).Where("integral", NameOf(integral));
}

int Crashes(const TrialTable& rows) {
  return static_cast<int>(rows.rows.size() - rows.Where("crash", "none").rows.size());
}

std::string CrashText(const TrialTable& rows) {
  const int crashes = Crashes(rows);
  std::string text = ShareText(crashes, static_cast<int>(rows.rows.size()));
  if (crashes > 0) {
    const std::vector<double> after_s = rows.Numbers("crash_s");
    text += WithNumbers(", after %.0f to %.0f s", Percentile(after_s, 0), Percentile(after_s, 1));
    for (const std::string& how : rows.Values("crash")) {
      text += how == "none" ? "" : ", " + how;
    }
  }
  return text;
}

/// "0.016 (0.015 to 0.017), most 0.021": mean over flights of the three axes together with the
/// interval of that mean, and the worst axis of any.
std::string RmsText(const TrialTable& rows, const std::string& part) {
  std::vector<double> together(rows.rows.size(), 0);
  double most = NAN;
  for (const char* axis : kAxes) {
    const std::vector<double> rms = rows.Numbers(part + "_" + axis + "_mps");
    for (std::size_t i = 0; i < rms.size(); ++i) {
      together[i] += rms[i] * rms[i] / 3;
      most = std::fmax(most, rms[i]);
    }
  }
  for (double& value : together) {
    value = std::sqrt(value);
  }
  const Spread spread = SpreadOf(together);
  if (spread.count == 0) {
    return "-";
  }
  const Interval interval = MeanInterval(together);
  return WithNumbers("%.3f", spread.mean) + OrDash(" (%.3f", interval.low) +
         OrDash(" to %.3f)", interval.high) + WithNumbers(", most %.3f", most);
}

std::string OffText(const TrialTable& rows, const char* column) {
  const std::vector<double> off = rows.Numbers(column);
  return OrDash("%.2f", Percentile(off, 0.5)) + OrDash(", most %.2f", Percentile(off, 1));
}

/// What several columns say of each row, at most; NaN where one is unknown.
std::vector<double> MostOfEach(const TrialTable& rows, const std::vector<std::string>& columns) {
  std::vector<double> most(rows.rows.size(), -INFINITY);
  for (const std::string& column : columns) {
    const std::vector<double> values = rows.Numbers(column);
    for (std::size_t i = 0; i < values.size(); ++i) {
      most[i] = std::isnan(most[i]) || values[i] <= most[i] ? most[i] : values[i];
    }
  }
  return most;
}

/// Every row has its figure and none is beyond the limit.
bool AllWithin(const std::vector<double>& values, double limit) {
  return !values.empty() &&
         std::all_of(values.begin(), values.end(), [&](double value) { return value <= limit; });
}

/// "most 0.021 m/s in 20 of 20 flights, limit 0.04 m/s".
std::string MostText(const std::vector<double>& values, const char* of, double limit_mps) {
  const Spread spread = SpreadOf(values);
  return OrDash("most %.3f m/s in ", spread.max) +
         WithNumbers("%.0f of %.0f ", spread.count, static_cast<double>(values.size())) + of +
         WithNumbers(", limit %.2f m/s", limit_mps);
}

std::vector<std::string> AxisColumns(const std::string& part) {
  std::vector<std::string> columns;
  for (const char* axis : kAxes) {
    columns.push_back(part + "_" + axis + "_mps");
  }
  return columns;
}

/// Velocity north: what was estimated over what was true.
std::string TrackPlot(const TrialTable& table, const char* method, const std::string& title) {
  const TrialTable rows = RowsOf(table, method, kSuitsGps, "track");
  LinePlot plot{.title = title, .x_label = "time on vision, s", .y_label = "velocity north, m/s"};
  for (const auto& [name, column] :
       {std::pair("estimated", "estimated_mps"), {"true", "true_mps"}}) {
    plot.series.push_back(
        {.name = name, .x = rows.Numbers("time_s"), .y = rows.Numbers(column), .points = false});
  }
  return LinePlotSvg(plot);
}

std::string ExcursionPlot(const TrialTable& table) {
  LinePlot plot{.title = "Farthest from the set-point in the hover, integral never frozen",
                .x_label = "integral gain, 1/s^2",
                .y_label = "median over flights, m"};
  for (const VelocityMethod& method : VelocityMethods()) {
    PlotSeries& series = plot.series.emplace_back();
    series.name = method.name;
    for (const LoopIntegral& integral : kIntegrals) {
      if (!integral.freezes) {
        series.x.push_back(integral.gain_per_s2);
        series.y.push_back(
            Percentile(RowsOf(table, method.name, integral).Numbers("hover_off_m"), 0.5));
      }
    }
  }
  plot.log_y = true;
  return LinePlotSvg(plot);
}

void AddGainTable(const TrialTable& table, const LoopIntegral& integral, ExperimentReport& report) {
  std::vector<std::vector<std::string>> cells;
  for (const VelocityMethod& method : VelocityMethods()) {
    const TrialTable rows = RowsOf(table, method.name, integral);
    if (rows.rows.empty()) {
      continue;
    }
    cells.push_back({method.name, RmsText(rows, "hover"), RmsText(rows, "approach"),
                     OffText(rows, "hover_off_m"), OffText(rows, "approach_off_m"),
                     CrashText(rows)});
    report.lines.push_back("integral " + NameOf(integral) + ", " + method.name +
                           ": velocity rms in the hover " + cells.back()[1] +
                           " m/s, off by median " + cells.back()[3] + " m, crashed " +
                           cells.back()[5]);
  }
  report.page.Heading("Integral gain " + NameOf(integral))
      .Table({"Velocity from", "Error in the hover, m/s rms", "On the slope, m/s rms",
              "Off in the hover, m", "Off on the slope, m", "Crashed"},
             cells);
}

void AddMissions(const TrialTable& missions, ExperimentReport& report) {
  if (missions.rows.empty()) {
    report.lines.push_back("no whole mission was flown: nothing is said of the hand-over");
    return;
  }
  const std::vector<double> step = missions.Numbers("step_mps"), gap = missions.Numbers("gap_mps"),
                            first = missions.Numbers("first_step_mps");
  report.Judge(AllWithin(step, kMostStep_mps),
               "Change of the error of the velocity sent, from message to message at the hand-over "
               "until its cross-fade is over: " +
                   OrDash("median %.3f, ", Percentile(step, 0.5)) +
                   MostText(step, "missions", kMostStep_mps));
  report.lines.push_back(
      "The first of these changes, from GPS to vision: " +
      OrDash("median %.3f, ", Percentile(first, 0.5)) +
      OrDash("most %.3f m/s; what the fade spreads, vision less GPS: ", Percentile(first, 1)) +
      OrDash("median %.3f, ", Percentile(gap, 0.5)) +
      OrDash("most %.3f m/s; between two on GPS ", Percentile(gap, 1)) +
      OrDash("%.3f m/s rms", SpreadOf(missions.Numbers("usual_mps")).mean));
  report.page.Paragraph(report.lines.back());
  const std::vector<double> beside = MostOfEach(missions, AxisColumns("hover"));
  report.Judge(AllWithin(beside, kMostHover_mps),
               "The vision filter on pictures, beside GPS in the hover, worst axis rms: " +
                   MostText(beside, "missions", kMostHover_mps));
  report.lines.push_back("Missions, vision filter in the hover " + RmsText(missions, "hover") +
                         " m/s rms, on the way down " + RmsText(missions, "approach") + " m/s rms");
}

void AddVerdicts(const TrialTable& table, ExperimentReport& report) {
  const TrialTable ours = RowsOf(table, VelocityMethods().back().name, kOfFile);
  const std::vector<double> hover = MostOfEach(ours, AxisColumns("hover"));
  report.Judge(AllWithin(hover, kMostHover_mps) && Crashes(ours) == 0,
               "Ours in the hover, at the vehicle's gains, worst axis rms: " +
                   MostText(hover, "flights", kMostHover_mps) + "; crashed " + CrashText(ours));
  AddMissions(table.Where("case", "mission"), report);
}

std::vector<std::string> FixLines(const TrialTable& table) {
  const TrialTable ours = RowsOf(table, VelocityMethods().back().name, kOfFile);
  std::vector<std::string> lines;
  for (const char* axis : kAxes) {
    const std::vector<double> noise = ours.Numbers(std::string("noise_") + axis + "_m"),
                              bias = ours.Numbers(std::string("bias_") + axis + "_m");
    lines.push_back(std::string("Fixes ") + axis +
                    WithNumbers(": deviation in a hover %.3f m, mean %.3f m rms over flights",
                                SpreadOf(noise).mean, SpreadOf(bias).rms));
  }
  return lines;
}

TrialRow EmptyRow() { return TrialRow(VelocityColumns().size(), "nan"); }

class RowWriter {
 public:
  RowWriter() : row_(EmptyRow()), columns_(VelocityColumns()) {}
  void Set(const std::string& column, const std::string& text) {
    row_.at(static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), column) -
                                     columns_.begin())) = text;
  }
  void Set(const std::string& column, double value) { Set(column, CsvNumber(value)); }
  void Set(const std::string& part, const char* unit, const Eigen::Vector3d& value) {
    for (std::size_t i = 0; i < kAxes.size(); ++i) {
      Set(part + "_" + kAxes[i] + unit, value[static_cast<Eigen::Index>(i)]);
    }
  }
  TrialRow row() const { return row_; }

 private:
  TrialRow row_;
  std::vector<std::string> columns_;
};

}  // namespace

std::span<const LoopIntegral> LoopIntegrals() { return kIntegrals; }

std::vector<std::string> VelocityColumns() {
  std::vector<std::string> columns = {"case",          "method",      "integral",       "crash",
                                      "crash_s",       "step_mps",    "first_step_mps", "gap_mps",
                                      "usual_mps",     "hover_off_m", "approach_off_m", "time_s",
                                      "estimated_mps", "true_mps"};
  for (const char* axis : kAxes) {
    for (const char* part : {"hover_", "approach_"}) {
      columns.push_back(std::string(part) + axis + "_mps");
    }
    for (const char* part : {"noise_", "bias_"}) {
      columns.push_back(std::string(part) + axis + "_m");
    }
  }
  return columns;
}

TrialRow RowOf(const VelocityMethod& method, const LoopIntegral& integral,
               const VelocityFlight& flight) {
  RowWriter row;
  row.Set("case", "loop");
  row.Set("method", method.name);
  row.Set("integral", NameOf(integral));
  row.Set("crash", flight.crash);
  row.Set("crash_s", flight.crash_s);
  row.Set("hover_off_m", flight.hover_off_m);
  row.Set("approach_off_m", flight.approach_off_m);
  row.Set("hover", "_mps", flight.hover_rms_mps);
  row.Set("approach", "_mps", flight.approach_rms_mps);
  row.Set("noise", "_m", flight.fix_noise_m);
  row.Set("bias", "_m", flight.fix_bias_m);
  return row.row();
}

TrialRow RowOf(const HandoverFlight& flight) {
  RowWriter row;
  row.Set("case", "mission");
  row.Set("method", "ours; pictures");
  row.Set("integral", NameOf(kOfFile));
  row.Set("crash", "none");
  row.Set("step_mps", flight.step_mps);
  row.Set("first_step_mps", flight.first_step_mps);
  row.Set("gap_mps", flight.gap_mps);
  row.Set("usual_mps", flight.usual_mps);
  row.Set("hover", "_mps", flight.hover_rms_mps);
  row.Set("approach", "_mps", flight.descent_rms_mps);
  return row.row();
}

TrialRow TrackRowOf(const VelocityMethod& method, const LoopIntegral& integral,
                    const VelocityFlight::Sample& sample) {
  RowWriter row;
  row.Set("case", "track");
  row.Set("method", method.name);
  row.Set("integral", NameOf(integral));
  row.Set("time_s", sample.time_s);
  row.Set("estimated_mps", sample.estimated_mps.x());
  row.Set("true_mps", sample.true_mps.x());
  return row.row();
}

bool IsTracked(const LoopIntegral& integral) { return NameOf(integral) == NameOf(kSuitsGps); }

ExperimentReport VelocityReport(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: velocities from vision fixes, flown on")};
  AddVerdicts(table, report);
  const std::vector<std::string> fixes = FixLines(table);
  report.lines.insert(report.lines.end(), fixes.begin(), fixes.end());
  report.page.List(fixes);
  const auto methods = VelocityMethods();
  report.page
      .Figure(TrackPlot(table, methods[1].name, "As Figure 5.1: unstable velocity estimates"),
              std::string(methods[1].name) + ", integral " + NameOf(kSuitsGps))
      .Figure(TrackPlot(table, methods[4].name, "High gains at 10 Hz"),
              std::string(methods[4].name) + ", integral " + NameOf(kSuitsGps))
      .Figure(TrackPlot(table, methods[5].name, "As Figure 5.2: improved velocity estimates"),
              std::string(methods[5].name) + ", integral " + NameOf(kSuitsGps))
      .Figure(TrackPlot(table, methods[7].name, "Ours, by the stamps of the fixes"),
              std::string(methods[7].name) + ", integral " + NameOf(kSuitsGps))
      .Figure(ExcursionPlot(table), "A flight that crashes counts with where it was then.");
  for (const LoopIntegral& integral : kIntegrals) {
    AddGainTable(table, integral, report);
  }
  report.page.Paragraph(
      "Each flight: 20 s on GPS, then on what the method says a hover at 50 ft, of two minutes if "
      "not told otherwise, and the slope to 2 m. High: the gains of a steady Kalman filter for "
      "fixes of 0.02 m every 0.1 s and 0.5 m/s^2/sqrt(Hz); low: 0.08 m and 0.03. Free: a fix every "
      "33 to 100 ms, which is also how late it comes; only ours puts it at its stamp. Late "
      "attitude: the fix is made with the attitude that stands when it is told, not with that of "
      "its picture. Winds up: the acceleration is not limited, so the integral never freezes. A "
      "crash: on the ground, 10 m off the set-point, or tilted by 45 deg. Velocities: root mean "
      "square of estimate less truth, mean of three axes over flights with its 95 % interval, and "
      "the worst axis. Missions fly the whole station on drawn pictures, until ten seconds after "
      "the "
      "hand-over. Intervals: 95 %, of means by Student, of shares by Wilson.");
  return report;
}

}  // namespace palace
