#include "engine/experiments/evaluate_occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/random.h"
#include "engine/core/text.h"
#include "engine/experiments/film_curve.h"
#include "engine/experiments/film_experiment.h"
#include "engine/experiments/occluder.h"
#include "engine/experiments/point_methods.h"
#include "engine/model/settings/settings.h"
#include "engine/report/figure_text.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

constexpr int kSecond = static_cast<int>(kFilmRate_hz);
constexpr int kToldWithin = kSecond / 2;
constexpr FilmCurve kCurve{4};
constexpr std::array kMethods = {PointMethod::kPlane, PointMethod::kTemplate,
                                 PointMethod::kFollower, PointMethod::kSet};

/// One before it comes, the longest, and the second after it.
int FewestPictures() {
  int longest = 0;
  for (const OccluderKind kind : kAllOccluders) {
    longest = std::max(longest, PicturesOf(kind));
  }
  return 1 + longest + kSecond + 1;
}

std::vector<std::string> Columns() {
  std::vector<std::string> columns = {
      "ground",          "flight",         "occluder",   "method",        "first",
      "error_before_px", "right_before",   "told_after", "wrong_as_good", "worst_as_good_px",
      "found_after",     "error_after_px", "good_after", "error_end_px",  "longest_told_lost"};
  const std::vector<std::string> curve = kCurve.Columns();
  columns.insert(columns.end(), curve.begin(), curve.end());
  return columns;
}

std::string OrNever(int pictures) { return CsvNumber(pictures < 0 ? NAN : pictures); }

TrialRow RowOf(const std::string& ground, FilmFlight flight, OccluderKind kind, PointMethod method,
               int first, const FollowedFilm& track) {
  const Occlusion told = JudgeOcclusion(track, first, first + PicturesOf(kind));
  TrialRow row = {ground,
                  NameOf(flight),
                  NameOf(kind),
                  NameOf(method),
                  std::to_string(first),
                  CsvNumber(told.error_before_px),
                  told.right_before ? "1" : "0",
                  OrNever(told.told_after),
                  std::to_string(told.wrong_as_good),
                  CsvNumber(told.worst_as_good_px),
                  OrNever(told.found_after),
                  CsvNumber(told.error_after_px),
                  told.good_after ? "1" : "0",
                  CsvNumber(told.error_end_px),
                  std::to_string(told.longest_told_lost)};
  kCurve.Append(track.error_px, row);
  return row;
}

/// One film, all occluders and methods at once, so that each picture is drawn once.
void AddFlight(const FilmGround& ground, FilmFlight flight, std::uint64_t seed,
               std::vector<TrialRow>& rows) {
  FilmOptions options = ground.film;
  options.flight = flight;
  const PointFilm film(ground.ground, options, seed);
  RandomStream random(seed, NameOf(flight));
  const int first = std::clamp(static_cast<int>(random.Uniform(0.25, 0.6) * film.pictures()), 1,
                               std::max(1, film.pictures() - FewestPictures() + 1));
  struct Run {
    OccluderKind kind;
    PointMethod method;
    FollowPoint follow;
    FollowedFilm track{};
  };
  std::vector<Run> runs;
  for (int i = 0; i < film.pictures(); ++i) {
    const ImageF grey = film.Grey(i), noise = film.Noise(i);
    const ImageU8 plain = Exposed(grey, noise);
    if (i == 0) {
      for (const OccluderKind kind : kAllOccluders) {
        for (const PointMethod method : kMethods) {
          runs.push_back({kind, method, StartFollowing(method, film, plain)});
          runs.back().track.error_px.push_back(0);
          runs.back().track.followed.push_back(true);
        }
      }
      continue;
    }
    for (const OccluderKind kind : kAllOccluders) {
      const bool struck = i >= first && i < first + PicturesOf(kind);
      ImageU8 picture;
      if (struck) {
        ImageF painted = grey;
        Occluder(kind, seed).Paint(i - first, film.Truth(i), painted);
        picture = Exposed(painted, noise);
      }
      for (Run& run : runs) {
        if (run.kind == kind) {
          const PointReading reading = run.follow(struck ? picture : plain, i);
          run.track.error_px.push_back((reading.pixel - film.Truth(i)).norm());
          run.track.followed.push_back(reading.followed);
        }
      }
    }
  }
  for (const Run& run : runs) {
    rows.push_back(RowOf(ground.name, flight, run.kind, run.method, first, run.track));
  }
}

std::vector<TrialRow> RunTrial(const FilmGround& ground, std::uint64_t seed) {
  std::vector<TrialRow> rows;
  for (const FilmFlight flight : {FilmFlight::kDescent, FilmFlight::kHover}) {
    AddFlight(ground, flight, seed, rows);
  }
  return rows;
}

// ---- report ----

template <typename Wanted>
int CountOf(const std::vector<double>& values, Wanted wanted) {
  return static_cast<int>(std::count_if(values.begin(), values.end(), wanted));
}

/// One second after it: told as good and right.
int CountFound(const TrialTable& rows) {
  const std::vector<double> error = rows.Numbers("error_after_px"),
                            good = rows.Numbers("good_after");
  int found = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    found += good[i] > 0 && error[i] <= kFinalTrack_px ? 1 : 0;
  }
  return found;
}

int CountWrongAsGood(const TrialTable& rows) {
  return CountOf(rows.Numbers("wrong_as_good"), [](double v) { return !(v <= 0); });
}

/// Of one flight, occluder and method: one row a film.
std::vector<std::string> CellsOf(const TrialTable& all) {
  const TrialTable rows = all.Where("right_before", "1");
  const int tracks = static_cast<int>(rows.rows.size());
  const std::vector<double> told = rows.Numbers("told_after");
  const double limit_pictures = MissionSettings{}.max_vision_outage_s * kFilmRate_hz;
  std::vector<double> wrong = rows.Numbers("wrong_as_good");
  std::erase_if(wrong, [](double v) { return v <= 0; });
  const auto share = [tracks](int hits) { return ShareText(hits, tracks); };
  return {ShareText(tracks, static_cast<int>(all.rows.size())),
          share(CountOf(told, [](double v) { return std::isfinite(v); })),
          MedianAndWorst(told, 0),
          share(CountWrongAsGood(rows)),
          MedianAndWorst(wrong, 0),
          OrDash("%.1f", SpreadOf(rows.Numbers("worst_as_good_px")).max),
          share(CountFound(rows)),
          MedianAndWorst(rows.Numbers("found_after"), 0),
          MedianAndWorst(rows.Numbers("error_after_px"), 1),
          share(CountOf(rows.Numbers("longest_told_lost"),
                        [limit_pictures](double v) { return v > limit_pictures; }))};
}

/// Films of which a method did so through everything that struck them.
struct FilmCounts {
  int films = 0;
  int right_before = 0;
  int found = 0;
  int wrong = 0;  ///< a wrong place told as good in one of the tracks at least
  int right = 0;  ///< right before and after, and never wrong
};

/// One film a trial and flight; `rows` are of one method.
FilmCounts CountFilms(const TrialTable& rows) {
  FilmCounts counts;
  for (const std::string& trial : rows.Values("trial")) {
    const TrialTable of_trial = rows.Where("trial", trial);
    for (const std::string& flight : of_trial.Values("flight")) {
      const TrialTable film = of_trial.Where("flight", flight);
      const auto tracks = film.rows.size();
      const bool before = film.Where("right_before", "1").rows.size() == tracks;
      const bool found = static_cast<std::size_t>(CountFound(film)) == tracks;
      const bool wrong = CountWrongAsGood(film) > 0;
      ++counts.films;
      counts.right_before += before ? 1 : 0;
      counts.found += found ? 1 : 0;
      counts.wrong += wrong ? 1 : 0;
      counts.right += before && found && !wrong ? 1 : 0;
    }
  }
  return counts;
}

/// What is asked of the plane tracker, of every film: nobody is left out for having been wrong
/// before, and films that nothing struck are counted by themselves.
void AddVerdicts(const TrialTable& table, ExperimentReport& report) {
  const std::string none = NameOf(OccluderKind::kNone);
  const TrialTable plane = table.Where("method", NameOf(PointMethod::kPlane));
  const TrialTable struck = plane.WhereNot("occluder", none);
  const FilmCounts films = CountFilms(struck);
  const std::string all = Joined(struck.Values("occluder"));
  const std::string limit = NumberText(kFinalTrack_px) + " px";
  report.Judge(films.films > 0 && films.right_before == films.films,
               "plane: told as good and right when it began, for all of " + all + ", in " +
                   ShareText(films.right_before, films.films) + " films");
  report.Judge(films.films > 0 && films.found == films.films,
               "plane: found again within 1 s and " + limit + " after all of them in " +
                   ShareText(films.found, films.films) + " films");
  report.Judge(films.films > 0 && films.wrong == 0,
               "plane: a wrong place told as good after any of them in " +
                   ShareText(films.wrong, films.films) + " films");
  const FilmCounts clear = CountFilms(plane.Where("occluder", none));
  if (clear.films > 0) {
    report.Judge(clear.right == clear.films,
                 "plane, where nothing came: right and told as good in " +
                     ShareText(clear.right, clear.films) + " films");
  }
}

LinePlot CurvePlot(const TrialTable& film, const std::string& occluder) {
  const TrialTable rows = film.Where("occluder", occluder);
  const auto first = [&rows](const char* column) { return rows.rows.front()[rows.Index(column)]; };
  LinePlot plot =
      kCurve.Plot(rows, occluder + " from picture " + first("first") + ", " + first("ground") +
                            ", " + first("flight") + ", seed " + first("seed"));
  plot.limits = {{kFinalTrack_px, "right"}};
  return plot;
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: something comes between camera and point")};
  const std::string right = NumberText(kFinalTrack_px) + " px";
  report.page.Paragraph(
      "Descents " + DescentText() +
      " and hovers at 15.24 m. The tables are of the tracks that were right (within " + right +
      ") and told as good in the picture before; the verdict is of all films, a trial's descent "
      "and its hover each one. Told: LOST while it lasted or within 0.5 s after. Wrong as good: "
      "pictures since then beyond " +
      right +
      " that were told as good. Found again: 1 s after it, told as good and right. Held: told as "
      "lost for more than the " +
      NumberText(MissionSettings{}.max_vision_outage_s) +
      " s after which a mission holds. Intervals count films, never pictures or tracks.");
  const std::vector<std::string> header = {"Occluder",
                                           "Method",
                                           "Right before (95 % interval)",
                                           "Told as lost (95 % interval)",
                                           "After pictures, median / worst",
                                           "A wrong place told as good (95 % interval)",
                                           "For pictures, median / worst",
                                           "Worst of them, px",
                                           "Found again in 1 s (95 % interval)",
                                           "After pictures, median / worst",
                                           "Error 1 s after, px, median / worst",
                                           "A mission would have held"};
  for (const std::string& flight : table.Values("flight")) {
    std::vector<std::vector<std::string>> rows;
    for (const std::string& occluder : table.Values("occluder")) {
      for (const std::string& method : table.Values("method")) {
        const std::vector<std::string> cells = CellsOf(
            table.Where("flight", flight).Where("occluder", occluder).Where("method", method));
        rows.push_back({occluder, method});
        rows.back().insert(rows.back().end(), cells.begin(), cells.end());
        report.lines.push_back(flight + ", " + occluder + ", " + method + ": right before in " +
                               cells[0] + "; of these told as lost in " + cells[1] +
                               ", a wrong place told as good in " + cells[3] + ", found again in " +
                               cells[6] + ", error 1 s after " + cells[8] + " px, held " +
                               cells[9]);
      }
    }
    report.page.Heading(flight).Table(header, rows);
  }
  AddVerdicts(table, report);
  if (!table.rows.empty()) {
    const TrialTable one = table.Where("trial", table.rows.front()[table.Index("trial")])
                               .Where("flight", table.rows.front()[table.Index("flight")]);
    report.page.Heading("One film");
    for (const std::string& occluder : one.Values("occluder")) {
      report.page.Figure(LinePlotSvg(CurvePlot(one, occluder)), "Errors of 0 leave a gap.");
    }
  }
  return report;
}

}  // namespace

Occlusion JudgeOcclusion(const FollowedFilm& film, int first, int clear) {
  const int last = static_cast<int>(film.error_px.size()) - 1;
  PALACE_CHECK(first > 0 && clear > first && clear + kSecond <= last, first, clear, last);
  const auto error = [&](int i) { return film.error_px[static_cast<std::size_t>(i)]; };
  const auto good = [&](int i) { return bool(film.followed[static_cast<std::size_t>(i)]); };
  const auto right = [&](int i) { return error(i) <= kFinalTrack_px; };
  Occlusion told;
  told.error_before_px = error(first - 1);
  told.right_before = good(first - 1) && right(first - 1);
  told.error_after_px = error(clear + kSecond);
  told.good_after = good(clear + kSecond);
  told.error_end_px = error(last);
  int in_a_row = 0;
  for (int i = first; i <= last; ++i) {
    if (!good(i) && told.told_after < 0 && i < clear + kToldWithin) {
      told.told_after = i - first;
    }
    in_a_row = good(i) ? 0 : in_a_row + 1;
    told.longest_told_lost = std::max(told.longest_told_lost, in_a_row);
    if (!good(i)) {
      continue;
    }
    told.worst_as_good_px = std::max(told.worst_as_good_px, error(i));
    told.wrong_as_good += right(i) ? 0 : 1;
    if (i >= clear && right(i) && told.found_after < 0) {
      told.found_after = i - clear;
    }
  }
  return told;
}

Experiment OcclusionExperiment(const FilmGroundOptions& defaults) {
  Experiment experiment;
  experiment.name = "occlusion";
  experiment.purpose = "A bird, a hand, a shadow, black pictures: lost, told, found again";
  experiment.default_trials = 10;
  experiment.columns = Columns();
  experiment.report = Report;
  return FilmExperiment(std::move(experiment), defaults, FewestPictures(), RunTrial);
}

}  // namespace palace
