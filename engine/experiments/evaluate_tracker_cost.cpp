#include <algorithm>
#include <chrono>
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

std::vector<double> TimesOf(PointMethod method, const PointFilm& film,
                            const std::vector<ImageU8>& pictures) {
  const FollowPoint follow = StartFollowing(method, film, pictures.front());
  std::vector<double> times_ms;
  for (int i = 1; i < film.pictures(); ++i) {
    const auto start = std::chrono::steady_clock::now();
    follow(pictures[static_cast<std::size_t>(i)], i);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    times_ms.push_back(took.count());
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
  std::vector<int> thread_counts = {1};
  if (cv::getNumThreads() > 1) {
    thread_counts.push_back(cv::getNumThreads());
  }
  for (const int threads : thread_counts) {
    const OpenCvThreads scope(threads);
    for (const PointMethod method : kAllPointMethods) {
      const std::vector<double> times_ms = TimesOf(method, film, pictures);
      rows.push_back({ground->name, std::to_string(threads), NameOf(method),
                      CsvNumber(Percentile(times_ms, 0.5)), CsvNumber(Percentile(times_ms, 0.95)),
                      CsvNumber(SpreadOf(times_ms).max)});
    }
  }
  return rows;
}

ExperimentReport ReportCost(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: cost of following a point")};
  std::vector<std::vector<std::string>> cells;
  for (const std::string& threads : table.Values("threads")) {
    for (const std::string& name : table.Values("method")) {
      const TrialTable rows = table.Where("threads", threads).Where("method", name);
      const std::vector<double> median = rows.Numbers("median_ms");
      cells.push_back({name, threads, OrDash("%.2f", Percentile(median, 0.5)),
                       OrDash("%.2f", Percentile(rows.Numbers("p95_ms"), 0.5)),
                       OrDash("%.2f", SpreadOf(rows.Numbers("worst_ms")).max),
                       OrDash("%.2f", SpreadOf(median).max)});
      report.lines.push_back(name + ", " + threads + " threads: " + cells.back()[2] +
                             " ms a picture (median), 95 % " + cells.back()[3] + " ms");
    }
  }
  report.page
      .Paragraph(WithNumbers("Time of the clock a picture of 640 x 480. Wanted of the plane "
                             "tracker: at most %.0f ms.",
                             kBudget_ms))
      .Table({"Method", "OpenCV's threads", "Median of all films' medians, ms",
              "Median of 95 %, ms", "Worst picture, ms", "Worst film's median, ms"},
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
  experiment.columns = {"ground", "threads", "method", "median_ms", "p95_ms", "worst_ms"};
  experiment.add_options = [options](CLI::App& verb) { AddFilmGroundOptions(verb, *options); };
  experiment.setup = [options] { return SetupOf(*options); };
  experiment.run = [options](int trial, std::uint64_t seed) {
    return RunCost(*options, trial, seed);
  };
  experiment.report = ReportCost;
  return experiment;
}

}  // namespace palace
