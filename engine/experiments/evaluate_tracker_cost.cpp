#include <algorithm>
#include <array>
#include <ctime>
#include <memory>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/core/text.h"
#include "engine/experiments/evaluate_trackers.h"
#include "engine/experiments/film_experiment.h"
#include "engine/experiments/point_methods.h"
#include "engine/report/statistics.h"
#include "engine/tracking/plane_tracker.h"
#include "engine/tracking/template_tracker.h"

namespace palace {
namespace {

constexpr const char* kPlaneAlone = "plane alone";
constexpr const char* kTemplateAlone = "template alone";
/// Without the set that a SiteTracker runs.
constexpr std::array kOthers = {PointMethod::kSet, PointMethod::kFollower, PointMethod::kKlt,
                                PointMethod::kKcf, PointMethod::kCsrt,     PointMethod::kEcc};
/// Of the worst film's median. The set may take all that tracker, estimator and filter have.
struct Budget {
  const char* method;
  double most_ms;
};
const std::array kBudgets = {Budget{kPlaneAlone, 2}, Budget{NameOf(PointMethod::kSet), 4}};

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

using TakePicture = std::function<void(const ImageU8& picture, int index)>;

LandingSite SiteOf(const PointFilm& film) {
  LandingSite site;
  site.p_WS = film.believed_point();
  return site;
}

Timestamp TimeOf(int index) { return AddSeconds({}, index / kFilmRate_hz); }

TakePicture StartPlane(const PointFilm& film, const ImageU8& first) {
  auto tracker = std::make_shared<PlaneTracker>();
  tracker->Lock(first, film.camera(), film.Believed(0), nullptr, SiteOf(film), {});
  return [tracker, &film](const ImageU8& picture, int index) {
    tracker->Track(picture, film.camera(), film.Believed(index), nullptr, {}, TimeOf(index));
  };
}

TakePicture StartTemplate(const PointFilm& film, const ImageU8& first) {
  auto tracker = std::make_shared<TemplateTracker>();
  tracker->Lock(first, film.camera(), film.Believed(0), SiteOf(film), {});
  return [tracker, &film](const ImageU8& picture, int index) {
    tracker->Track(picture, film.camera(), film.Believed(index), {}, TimeOf(index));
  };
}

/// Of the processor, each picture.
std::vector<double> TimesOf(const TakePicture& take, const std::vector<ImageU8>& pictures) {
  std::vector<double> times_ms;
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    const std::clock_t start = std::clock();
    take(pictures[i], static_cast<int>(i));
    times_ms.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return times_ms;
}

std::vector<TrialRow> RunCost(const FilmGround& ground, std::uint64_t seed) {
  const PointFilm film(ground.ground, ground.film, seed);
  std::vector<ImageU8> pictures;
  for (int i = 0; i < film.pictures(); ++i) {
    pictures.push_back(Exposed(film.Grey(i), film.Noise(i)));
  }
  std::vector<TrialRow> rows;
  const OpenCvThreads one(1);
  const auto add = [&](const char* method, const TakePicture& take) {
    const std::vector<double> times_ms = TimesOf(take, pictures);
    rows.push_back({ground.name, method, CsvNumber(Percentile(times_ms, 0.5)),
                    CsvNumber(Percentile(times_ms, 0.95)), CsvNumber(SpreadOf(times_ms).max)});
  };
  add(kPlaneAlone, StartPlane(film, pictures.front()));
  add(kTemplateAlone, StartTemplate(film, pictures.front()));
  for (const PointMethod method : kOthers) {
    add(NameOf(method), StartFollowing(method, film, pictures.front()));
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
  report.page.Paragraph(
      "Time of the processor a picture of 640 x 480, on one thread: what else the machine does "
      "hardly counts. Descents " +
      DescentText() +
      ". set: what a flight takes, for SiteTracker runs plane, template and features on every "
      "picture, whichever is in force.");
  for (const Budget& budget : kBudgets) {
    const TrialTable rows = table.Where("method", budget.method);
    const double worst_ms = SpreadOf(rows.Numbers("median_ms")).max;
    report.Judge(worst_ms <= budget.most_ms,
                 std::string(budget.method) + ": " + OrDash("%.2f", worst_ms) +
                     " ms a picture in the worst of " + std::to_string(rows.rows.size()) +
                     " films (median of its pictures), budget " + NumberText(budget.most_ms) +
                     " ms");
  }
  report.page.Table({"Method", "Median of all films' medians, ms", "Worst film's median, ms",
                     "Median of 95 %, ms", "Worst picture, ms"},
                    cells);
  return report;
}

}  // namespace

Experiment TrackerCostExperiment(const FilmGroundOptions& defaults) {
  Experiment experiment;
  experiment.name = "tracker-cost";
  experiment.purpose = "Time a picture of the trackers, ours and OpenCV's";
  experiment.default_trials = 5;
  experiment.columns = {"ground", "method", "median_ms", "p95_ms", "worst_ms"};
  experiment.report = ReportCost;
  return FilmExperiment(std::move(experiment), defaults, 2, RunCost);
}

}  // namespace palace
