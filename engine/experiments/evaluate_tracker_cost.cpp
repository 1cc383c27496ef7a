#include <algorithm>
#include <ctime>
#include <memory>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <opencv2/core.hpp>

#include "engine/core/text.h"
#include "engine/experiments/evaluate_trackers.h"
#include "engine/experiments/point_methods.h"
#include "engine/report/statistics.h"

namespace palace {
namespace {

constexpr double kBudget_ms = 2;

/// OpenCV's threads, as they were afterwards.
class OpenCvThreads {
 public:
  explicit OpenCvThreads(int count) : before_(cv::getNumThreads()) { cv::setNumThreads(count); }
  ~OpenCvThreads() { cv::setNumThreads(before_); }
  OpenCvThreads(const OpenCvThreads&) = delete;
  OpenCvThreads& operator=(const OpenCvThreads&) = delete;

 private:
  int before_;
};

/// Of the processor, each picture.
std::vector<double> TimesOf(PointMethod method, const PointFilm& film,
                            const std::vector<ImageU8>& pictures) {
  const FollowPoint follow = StartFollowing(method, film, pictures.front());
  std::vector<double> times_ms;
  for (int i = 1; i < film.pictures(); ++i) {
    const std::clock_t start = std::clock();
    follow(pictures[static_cast<std::size_t>(i)], i);
    times_ms.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return times_ms;
}

Result<std::vector<TrialRow>> RunCost(const FilmGroundOptions& options, int trial,
                                      std::uint64_t seed) {
  const Result<FilmGround> ground = GroundOfTrial(options, trial, seed);
  if (!ground) {
    return ground.error();
  }
  const PointFilm film(ground->ground, ground->film, seed);
  std::vector<ImageU8> pictures;
  for (int i = 0; i < film.pictures(); ++i) {
    pictures.push_back(Exposed(film.Grey(i), film.Noise(i)));
  }
  std::vector<TrialRow> rows;
  const OpenCvThreads one(1);
  for (const PointMethod method : kAllPointMethods) {
    const std::vector<double> times_ms = TimesOf(method, film, pictures);
    rows.push_back({ground->name, NameOf(method), CsvNumber(Percentile(times_ms, 0.5)),
                    CsvNumber(Percentile(times_ms, 0.95)), CsvNumber(SpreadOf(times_ms).max)});
  }
  return rows;
}

ExperimentReport ReportCost(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: cost of following a point")};
  std::vector<std::vector<std::string>> cells;
  for (const std::string& name : table.Values("method")) {
    const TrialTable rows = table.Where("method", name);
    const std::vector<double> median = rows.Numbers("median_ms");
    cells.push_back({name, OrDash("%.2f", Percentile(median, 0.5)),
                     OrDash("%.2f", SpreadOf(median).max),
                     OrDash("%.2f", Percentile(rows.Numbers("p95_ms"), 0.5)),
                     OrDash("%.2f", SpreadOf(rows.Numbers("worst_ms")).max)});
    report.lines.push_back(name + ": " + cells.back()[1] + " ms a picture (worst film " +
                           cells.back()[2] + "), 95 % " + cells.back()[3] + " ms");
  }
  report.page
      .Paragraph(
          "Time of the processor a picture of 640 x 480, on one thread: what else the machine does "
          "hardly counts. SiteTracker runs its whole set on every picture: plane and template take "
          "the time of all. Wanted of the plane tracker: at most " +
          NumberText(kBudget_ms) + " ms.")
      .Table({"Method", "Median of all films' medians, ms", "Worst film's median, ms",
              "Median of 95 %, ms", "Worst picture, ms"},
             cells);
  return report;
}

}  // namespace

Experiment TrackerCostExperiment(const FilmGroundOptions& defaults) {
  auto options = std::make_shared<FilmGroundOptions>(defaults);
  Experiment experiment;
  experiment.name = "tracker-cost";
  experiment.purpose = "Time a picture of the trackers, ours and OpenCV's";
  experiment.default_trials = 5;
  experiment.columns = {"ground", "method", "median_ms", "p95_ms", "worst_ms"};
  experiment.add_options = [options](CLI::App& verb) { AddFilmGroundOptions(verb, *options); };
  experiment.setup = [options] { return SetupOf(*options); };
  experiment.run = [options](int trial, std::uint64_t seed) {
    return RunCost(*options, trial, seed);
  };
  experiment.report = ReportCost;
  return experiment;
}

}  // namespace palace
