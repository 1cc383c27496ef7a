#include "engine/experiments/position_rows.h"

#include <algorithm>
#include <cmath>

#include "engine/core/text.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr double kThesis_m = 0.25;
constexpr double kPerfectLimit_m = 0.10;
constexpr double kPoorLimit_m = 0.25;
constexpr double kHonestLow = 0.8, kHonestHigh = 1.2;
constexpr double kTrackPeriod_s = 0.5;
constexpr const char* kAxes[] = {"north", "east", "down"};
constexpr const char *kWhole = "whole", *kMiddle = "middle rows";
constexpr std::size_t kErrorCells = 12;  // of one ErrorSums

/// Errors of one kind, raw or filtered, over one flight. One that is no number makes all unknown.
struct ErrorSums {
  std::vector<double> sizes_m, nees;
  Vector3d max_m = Vector3d::Zero(), axes_nees = Vector3d::Zero(), mean_m = Vector3d::Zero();

  void Add(const PositionError& error) {
    sizes_m.push_back(error.e_m.norm());
    nees.push_back(error.NeesPerDof());
    max_m = max_m.cwiseMax(error.e_m.cwiseAbs());
    axes_nees += error.NeesOfAxes();
    mean_m += error.e_m;
  }
  bool AllFinite() const {
    const auto finite = [](double value) { return std::isfinite(value); };
    return !nees.empty() && std::all_of(sizes_m.begin(), sizes_m.end(), finite) &&
           std::all_of(nees.begin(), nees.end(), finite);
  }
  void AddCells(TrialRow& row) const {
    if (!AllFinite()) {
      row.resize(row.size() + kErrorCells, CsvNumber(NAN));
      return;
    }
    const double count = static_cast<double>(sizes_m.size());
    row.push_back(CsvNumber(Percentile(sizes_m, 0.95)));
    row.push_back(CsvNumber(Percentile(sizes_m, 1)));
    for (int i = 0; i < 3; ++i) {
      row.push_back(CsvNumber(max_m[i]));
    }
    row.push_back(CsvNumber(SpreadOf(nees).mean));
    for (int i = 0; i < 3; ++i) {
      row.push_back(CsvNumber(axes_nees[i] / count));
    }
    for (int i = 0; i < 3; ++i) {
      row.push_back(CsvNumber(mean_m[i] / count));
    }
  }
};

void AddErrorColumns(const std::string& kind, std::vector<std::string>& columns) {
  columns.push_back(kind + "_p95_m");
  columns.push_back(kind + "_max_m");
  for (const char* suffix : {"_max_", "_nees", "_mean_"}) {
    if (suffix == std::string("_nees")) {
      columns.push_back(kind + "_nees");
    }
    for (const char* axis : kAxes) {
      const bool nees = suffix == std::string("_nees");
      columns.push_back(kind + suffix + (nees ? "_" : "") + axis + (nees ? "" : "_m"));
    }
  }
}

std::vector<std::string> TrackColumns() {
  std::vector<std::string> columns = {"t_s"};
  for (const char* what : {"true", "raw_error", "filter_error", "filter_sigma"}) {
    for (const char* axis : kAxes) {
      columns.push_back(std::string(what) + "_" + axis + "_m");
    }
  }
  return columns;
}

void AddVector(const Vector3d& v, TrialRow& row) {
  for (int i = 0; i < 3; ++i) {
    row.push_back(CsvNumber(v[i]));
  }
}

void AddTrack(const TrialRow& head, const std::vector<PositionSample>& samples,
              std::size_t flight_columns, std::vector<TrialRow>& rows) {
  double next_s = 0;
  for (const PositionSample& sample : samples) {
    const double t_s = SecondsBetween(samples.front().time, sample.time);
    if (t_s < next_s - 1e-6) {
      continue;
    }
    next_s += kTrackPeriod_s;
    const Vector3d unknown = Vector3d::Constant(NAN);
    TrialRow row = head;
    row.push_back("track");
    row.resize(row.size() + flight_columns, CsvNumber(NAN));
    row.push_back(CsvNumber(t_s));
    AddVector(sample.true_m, row);
    AddVector(sample.raw ? sample.raw->e_m : unknown, row);
    AddVector(sample.filtered ? sample.filtered->e_m : unknown, row);
    AddVector(
        sample.filtered ? Vector3d(sample.filtered->covariance_m2.diagonal().cwiseSqrt()) : unknown,
        row);
    rows.push_back(std::move(row));
  }
}

std::vector<std::string> FlightColumns() {
  std::vector<std::string> columns = {"pictures", "fixes", "refused", "nis"};
  AddErrorColumns("raw", columns);
  AddErrorColumns("filter", columns);
  return columns;
}

double MeanOf(const TrialTable& table, const std::string& column) {
  return SpreadOf(table.Numbers(column)).mean;
}

double MaxOf(const TrialTable& table, const std::string& column) {
  return SpreadOf(table.Numbers(column)).max;
}

std::string NeesText(const TrialTable& table, const std::string& kind) {
  const std::vector<double> nees = table.Numbers(kind + "_nees");
  const Interval interval = MeanInterval(nees);
  return WithNumbers("%.2f (%.2f to %.2f)", SpreadOf(nees).mean, interval.low, interval.high);
}

/// Whether the verdict on the mean could be another with other flights of the same kind.
std::string DoubtText(const TrialTable& table, const std::string& kind) {
  const Interval interval = MeanInterval(table.Numbers(kind + "_nees"));
  const bool honest = interval.low >= kHonestLow && interval.high <= kHonestHigh;
  const bool not_honest = interval.high < kHonestLow || interval.low > kHonestHigh;
  return honest || not_honest ? "" : "; too few flights to be sure";
}

std::string AxesText(const TrialTable& table, const std::string& kind) {
  return WithNumbers("%.2f, %.2f, %.2f", MeanOf(table, kind + "_nees_north"),
                     MeanOf(table, kind + "_nees_east"), MeanOf(table, kind + "_nees_down"));
}

std::string CaseText(const std::string& picture, const std::string& attitude,
                     const std::string& estimator) {
  return picture + ", attitude " + attitude + ", " + estimator;
}

TrialTable WholeOnes(const TrialTable& table) { return table.Where("cut", kWhole); }

/// One quality of attitude and one estimator.
TrialTable CaseOf(const TrialTable& table, const std::string& attitude,
                  const std::string& estimator) {
  return table.Where("attitude", attitude).Where("estimator", estimator);
}

/// Flights of which every judged figure is known.
int KnownFlights(const TrialTable& of) {
  const std::vector<double> raw = of.Numbers("raw_nees"), filtered = of.Numbers("filter_nees");
  int known = 0;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    known += std::isfinite(raw[i]) && std::isfinite(filtered[i]) ? 1 : 0;
  }
  return known;
}

bool IsKnown(const TrialTable& of) {
  return !of.rows.empty() && KnownFlights(of) == static_cast<int>(of.rows.size());
}

std::string KnownText(const TrialTable& of) {
  return WithNumbers("%.0f of %.0f", KnownFlights(of), static_cast<double>(of.rows.size()));
}

std::vector<double> Sum(const std::vector<double>& a, const std::vector<double>& b, double sign) {
  std::vector<double> sum;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum.push_back(sign * (a[i] + b[i]));
  }
  return sum;
}

void AddFigures(const TrialTable& track, const std::string& what, HtmlPage& page) {
  const std::vector<double> t_s = track.Numbers("t_s");
  page.Heading("First flight: " + what);
  for (const char* axis : kAxes) {
    const bool down = axis == std::string("down");
    const double sign = down ? -1 : 1;
    const std::string of = std::string(axis) + "_m";
    const std::vector<double> truth = track.Numbers("true_" + of);
    const std::string name = down ? "altitude above the cone's foot" : of.substr(0, of.size() - 2);
    LinePlot plot{
        name + ", estimated over actual", "time since the site was told, s", name + ", m", {}};
    plot.series = {{.name = "actual", .x = t_s, .y = Sum(truth, truth, sign / 2), .points = false},
                   {.name = "raw",
                    .x = t_s,
                    .y = Sum(truth, track.Numbers("raw_error_" + of), sign),
                    .line = false},
                   {.name = "filtered",
                    .x = t_s,
                    .y = Sum(truth, track.Numbers("filter_error_" + of), sign),
                    .points = false}};
    page.Figure(LinePlotSvg(plot), "As Fig. 3.7 of the thesis.");
    std::vector<double> three_sigma = track.Numbers("filter_sigma_" + of), minus;
    for (double& sigma : three_sigma) {
      sigma *= 3;
      minus.push_back(-sigma);
    }
    LinePlot errors{std::string("error, ") + axis,
                    "time since the site was told, s",
                    std::string("error ") + axis + ", m",
                    {}};
    errors.series = {
        {.name = "raw", .x = t_s, .y = track.Numbers("raw_error_" + of), .line = false},
        {.name = "filtered", .x = t_s, .y = track.Numbers("filter_error_" + of), .points = false},
        {.name = "+3 sigma", .x = t_s, .y = three_sigma, .points = false},
        {.name = "-3 sigma", .x = t_s, .y = minus, .points = false}};
    errors.limits = {{kThesis_m, "thesis, 0.25 m"}, {-kThesis_m, ""}};
    page.Figure(LinePlotSvg(errors), "Three standard deviations as the filter states them.");
  }
}

void AddCaseTable(const TrialTable& flights, ExperimentReport& report) {
  std::vector<std::vector<std::string>> cells;
  for (const std::string& picture : flights.Values("picture")) {
    for (const std::string& attitude : flights.Values("attitude")) {
      for (const std::string& estimator : flights.Values("estimator")) {
        const TrialTable of = CaseOf(flights.Where("picture", picture), attitude, estimator);
        if (of.rows.empty()) {
          continue;
        }
        cells.push_back(
            {picture, attitude, estimator, KnownText(of),
             WithNumbers("%.3f / %.3f", MaxOf(of, "raw_p95_m"), MaxOf(of, "raw_max_m")),
             WithNumbers("%.3f / %.3f", MaxOf(of, "filter_p95_m"), MaxOf(of, "filter_max_m")),
             WithNumbers("%.3f, %.3f, %.3f", MaxOf(of, "filter_max_north_m"),
                         MaxOf(of, "filter_max_east_m"), MaxOf(of, "filter_max_down_m")),
             NeesText(of, "raw"), AxesText(of, "raw"), NeesText(of, "filter"),
             AxesText(of, "filter"), WithNumbers("%.2f", MeanOf(of, "nis")),
             WithNumbers("%.0f of %.0f", of.Sum("refused"), of.Sum("fixes"))});
        const std::vector<std::string>& c = cells.back();
        report.lines.push_back(CaseText(picture, attitude, estimator) + ", " + c[3] +
                               " flights: raw p95/max " + c[4] + " m, filtered " + c[5] +
                               " m (n, e, d " + c[6] + "); NEES/dof raw " + c[7] + " (" + c[8] +
                               "), filtered " + c[9] + " (" + c[10] + "); NIS/dof " + c[11] +
                               "; refused " + c[12]);
      }
    }
  }
  report.page.Table(
      {"Picture", "Attitude", "Estimator", "Flights", "Raw p95 / max, m", "Filtered p95 / max, m",
       "Filtered max north, east, down, m", "NEES/dof raw (95 %)", "north, east, down",
       "NEES/dof filtered (95 %)", "north, east, down", "NIS/dof", "Refused fixes"},
      cells);
}

/// `flights`: on whole pictures.
void AddVerdicts(const TrialTable& flights, ExperimentReport& report) {
  const std::string resection = NameOf(PositionEstimator::kResection);
  const auto limit = [&](const std::string& attitude, double limit_m) {
    const TrialTable of = CaseOf(flights, attitude, resection);
    const double max_m = MaxOf(of, "filter_max_m");
    report.Judge(IsKnown(of) && max_m <= limit_m,
                 WithNumbers("Resection, filtered, never more than %.2f m off", limit_m) +
                     " with attitude " + attitude + WithNumbers(": at most %.3f m in ", max_m) +
                     KnownText(of) + " flights");
  };
  limit(NameOf(AttitudeQuality::kPerfect), kPerfectLimit_m);
  limit(NameOf(AttitudeQuality::kPoor), kPoorLimit_m);
  for (const AttitudeQuality attitude : kAttitudeQualities) {
    const TrialTable of = CaseOf(flights, NameOf(attitude), resection);
    for (const auto& [kind, name] : {std::pair("raw", "raw"), {"filter", "filtered"}}) {
      const double nees = MeanOf(of, std::string(kind) + "_nees");
      report.Judge(IsKnown(of) && nees >= kHonestLow && nees <= kHonestHigh,
                   std::string("Normalised error squared of the resection, ") + name +
                       ", with attitude " + NameOf(attitude) + ": " + NeesText(of, kind) + " in " +
                       KnownText(of) +
                       WithNumbers(" flights, %.1f to %.1f is honest", kHonestLow, kHonestHigh) +
                       DoubtText(of, kind));
    }
  }
}

}  // namespace

std::vector<std::string> PositionColumns() {
  std::vector<std::string> columns = {"picture", "cut", "attitude", "estimator", "row"};
  for (const auto& more : {FlightColumns(), TrackColumns()}) {
    columns.insert(columns.end(), more.begin(), more.end());
  }
  return columns;
}

void AddPositionRows(const PositionCase& of, const std::vector<PositionSample>& samples,
                     bool with_track, std::vector<TrialRow>& rows) {
  ErrorSums raw, filtered;
  std::vector<double> nis;
  int refused = 0;
  for (const PositionSample& sample : samples) {
    refused += sample.refused ? 1 : 0;
    nis.push_back(sample.nis_per_dof);
    if (sample.raw) {
      raw.Add(*sample.raw);
    }
    if (sample.filtered) {
      filtered.Add(*sample.filtered);
    }
  }
  const TrialRow head = {of.picture, of.whole ? kWhole : kMiddle, of.attitude, of.estimator};
  TrialRow row = head;
  row.push_back("flight");
  row.push_back(CsvNumber(static_cast<double>(samples.size())));
  row.push_back(CsvNumber(static_cast<double>(raw.sizes_m.size())));
  row.push_back(CsvNumber(refused));
  row.push_back(CsvNumber(SpreadOf(nis).mean));
  raw.AddCells(row);
  filtered.AddCells(row);
  row.resize(PositionColumns().size(), CsvNumber(NAN));
  rows.push_back(std::move(row));
  if (with_track) {
    AddTrack(head, samples, FlightColumns().size(), rows);
  }
}

ExperimentReport PositionReport(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: position by vision on the approach to a cone")};
  const TrialTable flights = table.Where("row", "flight"), tracks = table.Where("row", "track");
  AddVerdicts(WholeOnes(flights), report);
  report.page.Paragraph(
      "Hover at 50 ft over flat ground, a road cone where the left camera's axis meets it, then "
      "down that axis until the skids are 2 m above the ground: flown by the simulated vehicle, "
      "guided by the truth, its sensors and pictures those of its file. All estimators see the "
      "same pictures. Errors are of the position relative to the cone's foot. The site is told "
      "as stereo and the believed poses of the hover place it. The lower pictures: the middle "
      "rows, as many as the thesis's have.");
  AddCaseTable(flights, report);
  report.page.Paragraph(
      "Flights: those of which every figure is known, of all. p95 and max are of the worst "
      "flight. NEES/dof: mean of the flights' means of the squared error over the stated "
      "covariance; its interval (Student) is over flights, because errors of one flight have much "
      "in common.");
  for (const PositionEstimator estimator :
       {PositionEstimator::kResection, PositionEstimator::kSevenSteps}) {
    for (const AttitudeQuality attitude : {AttitudeQuality::kPerfect, AttitudeQuality::kVehicle}) {
      const TrialTable track = CaseOf(WholeOnes(tracks), NameOf(attitude), NameOf(estimator));
      for (const std::string& picture : track.Values("picture")) {
        AddFigures(track, CaseText(picture, NameOf(attitude), NameOf(estimator)), report.page);
      }
    }
  }
  return report;
}

}  // namespace palace
