#include "engine/experiments/evaluate_trackers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/text.h"
#include "engine/experiments/film_curve.h"
#include "engine/experiments/film_experiment.h"
#include "engine/experiments/point_methods.h"
#include "engine/report/figure_text.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

constexpr FilmCurve kCurve{8};

std::vector<std::string> Columns() {
  std::vector<std::string> columns = {
      "ground",       "motion_px",    "selected",          "method",        "error_middle_px",
      "error_end_px", "lost_picture", "told_lost_picture", "unseen_losses", "coherence_end"};
  const std::vector<std::string> curve = kCurve.Columns();
  columns.insert(columns.end(), curve.begin(), curve.end());
  return columns;
}

TrialRow RowOf(const std::string& ground, const PointFilm& film, PointMethod method,
               const FollowedFilm& track) {
  const int lost = FirstLost(track);
  const auto told = std::find(track.followed.begin(), track.followed.end(), false);
  TrialRow row = {
      ground,
      CsvNumber(film.motion_px()),
      film.selection_refused() ? "0" : "1",
      NameOf(method),
      CsvNumber(track.error_px[track.error_px.size() / 2]),
      CsvNumber(track.error_px.back()),
      CsvNumber(lost < 0 ? NAN : lost),
      CsvNumber(told == track.followed.end() ? NAN
                                             : static_cast<double>(told - track.followed.begin())),
      std::to_string(UnseenLosses(track)),
      CsvNumber(track.coherence_end)};
  kCurve.Append(track.error_px, row);
  return row;
}

std::vector<TrialRow> RunTrial(const FilmGround& ground, std::uint64_t seed) {
  const PointFilm film(ground.ground, ground.film, seed);
  std::vector<FollowPoint> methods;
  std::vector<FollowedFilm> tracks(kAllPointMethods.size());
  for (int i = 0; i < film.pictures(); ++i) {
    const ImageU8 picture = Exposed(film.Grey(i), film.Noise(i));
    for (std::size_t k = 0; k < kAllPointMethods.size(); ++k) {
      FollowedFilm& track = tracks[k];
      if (i == 0) {
        methods.push_back(StartFollowing(kAllPointMethods[k], film, picture));
        track.error_px.push_back(0);
        track.followed.push_back(true);
        continue;
      }
      const PointReading reading = methods[k](picture, i);
      track.error_px.push_back((reading.pixel - film.Truth(i)).norm());
      track.followed.push_back(reading.followed);
      track.coherence_end = reading.coherence;
    }
  }
  std::vector<TrialRow> rows;
  for (std::size_t k = 0; k < kAllPointMethods.size(); ++k) {
    rows.push_back(RowOf(ground.name, film, kAllPointMethods[k], tracks[k]));
  }
  return rows;
}

// ---- report ----

int CountUpTo(const std::vector<double>& values, double limit) {
  return static_cast<int>(
      std::count_if(values.begin(), values.end(), [limit](double v) { return v <= limit; }));
}

int CountKnown(const std::vector<double>& values) {
  return static_cast<int>(
      std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); }));
}

/// One method's row: what it was and what it said.
std::vector<std::string> Summary(const TrialTable& rows, const std::string& name) {
  const std::vector<double> end = rows.Numbers("error_end_px"), lost = rows.Numbers("lost_picture"),
                            unseen = rows.Numbers("unseen_losses");
  const int films = static_cast<int>(end.size());
  const int unseen_films = films - CountUpTo(unseen, 0);
  return {name,
          MedianAndWorst(rows.Numbers("error_middle_px"), 1),
          MedianAndWorst(end, 1),
          ShareText(CountUpTo(end, kFinalTrack_px), films),
          ShareText(CountKnown(lost), films),
          OrDash("%.0f", SpreadOf(lost).min),
          ShareText(unseen_films, films),
          ShareText(CountKnown(rows.Numbers("told_lost_picture")), films),
          OrDash("%.2f", Percentile(rows.Numbers("coherence_end"), 0.5))};
}

std::string CurvePlot(const TrialTable& table, const std::string& title) {
  LinePlot plot = kCurve.Plot(table, title);
  plot.limits = {{kLostTrack_px, "lost"}, {kFinalTrack_px, "wanted at the end"}};
  return LinePlotSvg(plot);
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: one point followed down a glide slope")};
  const std::vector<std::string> methods = table.Values("method");
  std::vector<std::vector<std::string>> all, by_ground;
  for (const std::string& name : methods) {
    const TrialTable rows = table.Where("method", name);
    all.push_back(Summary(rows, name));
    const auto& cells = all.back();
    report.lines.push_back(name + ": error in the middle " + cells[1] + " px, at the end " +
                           cells[2] + " px (median / worst), at most 5 px in " + cells[3] +
                           ", lost in " + cells[4] + ", lost and told as good in " + cells[6] +
                           ", coherence at the end " + cells[8]);
  }
  const std::vector<std::string> grounds = table.Values("ground");
  for (const std::string& ground : grounds) {
    by_ground.push_back({ground});
    for (const std::string& name : methods) {
      const TrialTable rows = table.Where("ground", ground).Where("method", name);
      by_ground.back().push_back(MedianAndWorst(rows.Numbers("error_end_px"), 1));
    }
  }
  const std::vector<std::string> ours_name = {NameOf(PointMethod::kPlane)};
  const TrialTable ours = table.Where("method", ours_name.front());
  const int films = static_cast<int>(ours.rows.size());
  const int lost = CountKnown(ours.Numbers("lost_picture"));
  const int right = CountUpTo(ours.Numbers("error_end_px"), kFinalTrack_px);
  const int chosen = CountUpTo(ours.Numbers("selected"), 0);
  report.page
      .Paragraph(
          "Descents " + DescentText() +
          " at 45 degrees, with 2 to 5 px of attitude motion a picture and noise of 2.5 grey "
          "levels. plane and template are ours and know the believed poses, the others see "
          "pictures alone. Lost: beyond 15 px. Told as good: the method's own word, see "
          "point_methods.h.")
      .Paragraph(std::to_string(films - chosen) + " of " + std::to_string(films) +
                 " points were chosen by the station's selection; in the others it refused all "
                 "and the end of the slope was followed.");
  report.Judge(films > 0 && lost == 0 && right == films,
               "plane: lost in " + ShareText(lost, films) + ", at most 5 px at the end in " +
                   ShareText(right, films));
  report.page.Table({"Method", "Error in the middle, px, median / worst", "At the end, px",
                     "At most 5 px at the end (95 % interval)", "Lost (95 % interval)",
                     "First lost at picture", "Lost and told as good (95 % interval)",
                     "Ever told as lost (95 % interval)", "Coherence at the end, median"},
                    all);
  std::vector<std::string> header = {"Ground"};
  header.insert(header.end(), methods.begin(), methods.end());
  report.page.Heading("Error at the end by ground, px, median / worst").Table(header, by_ground);
  if (!table.rows.empty()) {
    const std::string& first = table.rows.front()[table.Index("trial")];
    const TrialTable one = table.Where("trial", first);
    const std::string what =
        one.rows.front()[table.Index("ground")] + ", seed " + one.rows.front()[table.Index("seed")];
    report.page
        .Figure(CurvePlot(one, "Error against picture: " + what),
                "One film. Errors of 0 leave a gap.")
        .Figure(CurvePlot(table, "Error against picture: median of all films"), "All films.");
  }
  return report;
}

}  // namespace

int FirstLost(const FollowedFilm& film) {
  const auto lost = std::find_if(film.error_px.begin(), film.error_px.end(),
                                 [](double e) { return !(e <= kLostTrack_px); });
  return lost == film.error_px.end() ? -1 : static_cast<int>(lost - film.error_px.begin());
}

int UnseenLosses(const FollowedFilm& film) {
  int count = 0;
  for (std::size_t i = 0; i < film.error_px.size(); ++i) {
    count += film.followed[i] && !(film.error_px[i] <= kLostTrack_px) ? 1 : 0;
  }
  return count;
}

Experiment TrackersExperiment(const FilmGroundOptions& defaults) {
  Experiment experiment;
  experiment.name = "trackers";
  experiment.purpose = "One point followed down a glide slope, beside OpenCV's trackers";
  experiment.default_trials = 25;
  experiment.columns = Columns();
  experiment.report = Report;
  return FilmExperiment(std::move(experiment), defaults, 2, RunTrial);
}

}  // namespace palace
