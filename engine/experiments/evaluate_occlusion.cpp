#include "engine/experiments/evaluate_occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/check.h"
#include "engine/core/random.h"
#include "engine/core/text.h"
#include "engine/experiments/occluder.h"
#include "engine/experiments/point_methods.h"
#include "engine/model/settings/settings.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"

namespace palace {
namespace {

constexpr int kSecond = static_cast<int>(kFilmRate_hz);
constexpr int kToldWithin = kSecond / 2;
constexpr int kCurveStep = 4;  // pictures between two points of the plotted curve
constexpr std::size_t kCurvePoints = kFilmPictures / kCurveStep;
constexpr std::array kMethods = {PointMethod::kPlane, PointMethod::kTemplate,
                                 PointMethod::kFollower, PointMethod::kSet};

std::string CurveColumn(std::size_t k) {
  return "error_at_" + std::to_string(k * kCurveStep) + "_px";
}

std::vector<std::string> Columns() {
  std::vector<std::string> columns = {
      "ground",          "flight",         "occluder",   "method",        "first",
      "error_before_px", "right_before",   "told_after", "wrong_as_good", "worst_as_good_px",
      "found_after",     "error_after_px", "good_after", "error_end_px",  "longest_told_lost"};
  for (std::size_t k = 0; k < kCurvePoints; ++k) {
    columns.push_back(CurveColumn(k));
  }
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
  for (std::size_t k = 0; k < kCurvePoints; ++k) {
    const std::size_t i = k * kCurveStep;
    row.push_back(CsvNumber(i < track.error_px.size() ? track.error_px[i] : NAN));
  }
  return row;
}

/// One film, all occluders and methods at once, so that each picture is drawn once.
void AddFlight(const FilmGround& ground, FilmFlight flight, std::uint64_t seed,
               std::vector<TrialRow>& rows) {
  FilmOptions options = ground.film;
  options.flight = flight;
  const PointFilm film(ground.ground, options, seed);
  RandomStream random(seed, NameOf(flight));
  const int first =
      std::clamp(static_cast<int>(random.Uniform(0.25, 0.6) * film.pictures()), 1,
                 std::max(1, film.pictures() - PicturesOf(OccluderKind::kShadow) - kSecond - 1));
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

Result<std::vector<TrialRow>> RunTrial(const FilmGroundOptions& options, int trial,
                                       std::uint64_t seed) {
  const Result<FilmGround> ground = GroundOfTrial(options, trial, seed);
  if (!ground) {
    return ground.error();
  }
  std::vector<TrialRow> rows;
  for (const FilmFlight flight : {FilmFlight::kDescent, FilmFlight::kHover}) {
    AddFlight(*ground, flight, seed, rows);
  }
  return rows;
}

// ---- report ----

std::string ShareText(int hits, int trials) {
  if (trials == 0) {
    return "-";
  }
  const Interval interval = WilsonInterval(hits, trials);
  return std::to_string(hits) + " of " + std::to_string(trials) +
         WithNumbers(" (%.0f to %.0f %%)", 100 * interval.low, 100 * interval.high);
}

template <typename Wanted>
int CountOf(const std::vector<double>& values, Wanted wanted) {
  return static_cast<int>(std::count_if(values.begin(), values.end(), wanted));
}

std::string MedianAndWorst(const std::vector<double>& values, const char* format) {
  return OrDash(format, Percentile(values, 0.5)) + " / " + OrDash(format, SpreadOf(values).max);
}

/// Of the rows of one flight, occluder and method that were right before.
struct Cell {
  int tracks = 0;  ///< right before
  int all = 0;
  int told = 0;
  int wrong = 0;  ///< with a wrong place told as good
  int found = 0;  ///< one second later told as good and right
  int held = 0;   ///< told as lost for longer than a mission goes on without
  std::vector<std::string> texts;
};

Cell CellOf(const TrialTable& all) {
  const TrialTable rows = all.Where("right_before", "1");
  const std::vector<double> wrong = rows.Numbers("wrong_as_good"),
                            told = rows.Numbers("told_after"),
                            error = rows.Numbers("error_after_px"),
                            good = rows.Numbers("good_after"),
                            lost = rows.Numbers("longest_told_lost");
  const double limit_pictures = MissionSettings{}.max_vision_outage_s * kFilmRate_hz;
  Cell cell;
  cell.all = static_cast<int>(all.rows.size());
  cell.tracks = static_cast<int>(rows.rows.size());
  cell.told = CountOf(told, [](double v) { return std::isfinite(v); });
  cell.wrong = CountOf(wrong, [](double v) { return v > 0; });
  cell.held = CountOf(lost, [limit_pictures](double v) { return v > limit_pictures; });
  for (std::size_t i = 0; i < error.size(); ++i) {
    cell.found += good[i] > 0 && error[i] <= kFinalTrack_px ? 1 : 0;
  }
  std::vector<double> wrong_counts;
  std::copy_if(wrong.begin(), wrong.end(), std::back_inserter(wrong_counts),
               [](double v) { return v > 0; });
  cell.texts = {ShareText(cell.tracks, cell.all),
                ShareText(cell.told, cell.tracks),
                MedianAndWorst(told, "%.0f"),
                ShareText(cell.wrong, cell.tracks),
                MedianAndWorst(wrong_counts, "%.0f"),
                OrDash("%.1f", SpreadOf(rows.Numbers("worst_as_good_px")).max),
                ShareText(cell.found, cell.tracks),
                MedianAndWorst(rows.Numbers("found_after"), "%.0f"),
                MedianAndWorst(error, "%.1f"),
                ShareText(cell.held, cell.tracks)};
  return cell;
}

LinePlot CurvePlot(const TrialTable& one, const std::string& occluder) {
  const TrialTable rows = one.Where("occluder", occluder);
  const std::string first = rows.rows.front()[rows.Index("first")];
  LinePlot plot{occluder + " from picture " + first + ", " +
                    rows.rows.front()[rows.Index("ground")] + ", " +
                    rows.rows.front()[rows.Index("flight")] + ", seed " +
                    rows.rows.front()[rows.Index("seed")],
                "picture, 30 a second",
                "error of the told point, px",
                {}};
  plot.log_y = true;
  plot.limits = {{kFinalTrack_px, "right"}};
  for (const auto& row : rows.rows) {
    PlotSeries series{.name = row[rows.Index("method")], .x = {}, .y = {}};
    series.points = false;
    for (std::size_t k = 1; k < kCurvePoints; ++k) {
      series.x.push_back(static_cast<double>(k * kCurveStep));
      series.y.push_back(rows.Where("method", series.name).Numbers(CurveColumn(k)).front());
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: something comes between camera and point")};
  const std::string right = NumberText(kFinalTrack_px) + " px";
  report.page.Paragraph(
      "Descents from 45.7 m to 4 m and hovers at 15.24 m. Of the tracks that were right (within " +
      right +
      ") and told as good in the picture before. Told: LOST while it lasted or within 0.5 s after. "
      "Wrong as good: pictures since then beyond " +
      right +
      " that were told as good. Found again: 1 s after it, told as good and right. Held: told as "
      "lost for more than the " +
      NumberText(MissionSettings{}.max_vision_outage_s) + " s after which a mission holds.");
  const std::vector<std::string> header = {"Occluder",
                                           "Method",
                                           "Right before",
                                           "Told as lost (95 % interval)",
                                           "After pictures, median / worst",
                                           "A wrong place told as good (95 % interval)",
                                           "For pictures, median / worst",
                                           "Worst of them, px",
                                           "Found again in 1 s (95 % interval)",
                                           "After pictures, median / worst",
                                           "Error 1 s after, px, median / worst",
                                           "A mission would have held"};
  int tracks = 0, found = 0, wrong = 0;
  for (const std::string& flight : table.Values("flight")) {
    std::vector<std::vector<std::string>> cells;
    for (const std::string& occluder : table.Values("occluder")) {
      for (const std::string& method : table.Values("method")) {
        const Cell cell = CellOf(
            table.Where("flight", flight).Where("occluder", occluder).Where("method", method));
        cells.push_back({occluder, method});
        cells.back().insert(cells.back().end(), cell.texts.begin(), cell.texts.end());
        report.lines.push_back(flight + ", " + occluder + ", " + method + ": told as lost in " +
                               cell.texts[1] + ", a wrong place told as good in " + cell.texts[3] +
                               ", found again in " + cell.texts[6] + ", error 1 s after " +
                               cell.texts[8] + " px, held " + cell.texts[9]);
        if (method == NameOf(PointMethod::kPlane)) {
          tracks += cell.tracks;
          found += cell.found;
          wrong += cell.wrong;
        }
      }
    }
    report.page.Heading(flight).Table(header, cells);
  }
  report.passed = tracks > 0 && found == tracks && wrong == 0;
  const std::string verdict = "plane: found again within 1 s and 5 px in " +
                              ShareText(found, tracks) + ", a wrong place told as good in " +
                              ShareText(wrong, tracks);
  report.lines.push_back((report.passed ? "passed: " : "FAILED: ") + verdict);
  report.page.Verdict(report.passed, verdict);
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
  auto options = std::make_shared<FilmGroundOptions>(defaults);
  Experiment experiment;
  experiment.name = "occlusion";
  experiment.purpose = "A bird, a hand, a shadow, black pictures: lost, told, found again";
  experiment.default_trials = 10;
  experiment.columns = Columns();
  experiment.add_options = [options](CLI::App& verb) { AddFilmGroundOptions(verb, *options); };
  experiment.setup = [options] { return SetupOf(*options); };
  experiment.run = [options](int trial, std::uint64_t seed) {
    return RunTrial(*options, trial, seed);
  };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
