#include "engine/experiments/evaluate_probability.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/random.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/experiments/touchdown_field.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"
#include "engine/runtime/settings_io.h"
#include "engine/slad/slad.h"

namespace palace {
namespace {

constexpr int kPlaces = 6;
constexpr int kEnough = 1000;     // touchdowns in a bin that must be right
constexpr double kWithin = 0.05;  // of the mean prediction
constexpr double kCalledSafe = 0.99;
constexpr int kMostReach_cells = 188;  // of the lander: a field of at most 400 cells a side
constexpr double kBins[] = {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0};

template <typename... Values>
std::string Text(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

Result<Settings> SettingsFrom(const std::vector<std::string>& assignments) {
  Result<Settings> settings = SettingsOfCommandLine(Settings{}, {}, assignments);
  if (settings && settings->slad.mode != SladMode::kModern) {
    return InvalidError("slad.mode: thesis mode has no probability");
  }
  return settings;
}

Result<std::vector<TrialRow>> RunTrial(const std::vector<std::string>& assignments, int trial,
                                       std::uint64_t seed) {
  const Result<Settings> settings = SettingsFrom(assignments);
  if (!settings) {
    return settings.error();
  }
  const SladSettings& slad = settings->slad;
  // The footprint, its planes' window and the gear must lie on the field.
  const double gear_m = std::hypot(slad.lander.gear_length_m, slad.lander.gear_width_m);
  const double across_m = std::max(slad.lander.base_size_m, gear_m);
  const double reach_cells = std::ceil(across_m / 2 / slad.grid.cell_m);
  if (reach_cells > kMostReach_cells) {
    return InvalidError((gear_m > slad.lander.base_size_m
                             ? "the gear of slad.gear_length_m and slad.gear_width_m is"
                             : "slad.lander_base_size_m is") +
                        WithNumbers(" %.10g m across, at most %.10g m (%.0f cells of slad.cell_m)",
                                    across_m, 2 * kMostReach_cells * slad.grid.cell_m,
                                    2.0 * kMostReach_cells));
  }
  const int rim = static_cast<int>(reach_cells) + 1;
  const int side = 2 * rim + 22;
  const int kind = trial % static_cast<int>(kGroundKindNames.size());
  const TouchdownField field = MakeTouchdownField(static_cast<GroundKind>(kind), slad, side, seed);
  Slad judge;
  judge.Take(field.map);
  const auto decision = judge.Decide(*settings, Letters::kOfCopy);
  const HazardMaps& hazards = *decision->hazards;
  RandomStream random(seed, "touchdown places");
  std::vector<TrialRow> rows;
  for (int k = 0; k < kPlaces; ++k) {
    const Cell cell{rim + random.Index(side - 2 * rim), rim + random.Index(side - 2 * rim)};
    const TrueTouchdown truth = FindTrueTouchdown(field, slad, cell);
    rows.push_back({kGroundKindNames[static_cast<std::size_t>(kind)], CsvNumber(field.sigma_m),
                    CsvNumber(static_cast<double>(hazards.safe_probability.at(cell))),
                    truth.Safe(slad) ? "1" : "0", CsvNumber(Deg(truth.slope_rad)),
                    CsvNumber(truth.deviation_m), CsvNumber(truth.step_m),
                    CsvNumber(Deg(truth.tilt_rad)), CsvNumber(truth.rise_m)});
  }
  return rows;
}

/// Touchdowns as predicted and as they were; those without a prediction are left out.
struct Outcomes {
  std::vector<double> predicted, safe;
  void Add(double probability, double was_safe) {
    if (std::isfinite(probability)) {
      predicted.push_back(probability);
      safe.push_back(was_safe);
    }
  }
  double Brier() const {
    double sum = 0;
    for (std::size_t i = 0; i < safe.size(); ++i) {
      sum += std::pow(predicted[i] - safe[i], 2);
    }
    return safe.empty() ? std::nan("") : sum / static_cast<double>(safe.size());
  }
};

Outcomes OutcomesOf(const TrialTable& table) {
  Outcomes outcomes;
  const std::vector<double> predicted = table.Numbers("predicted"), safe = table.Numbers("safe");
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    outcomes.Add(predicted[i], safe[i]);
  }
  return outcomes;
}

struct Bin {
  int count = 0, safe = 0;
  double predicted = 0;  ///< mean
  double observed() const { return static_cast<double>(safe) / count; }
};

std::vector<Bin> BinsOf(const Outcomes& outcomes) {
  std::vector<Bin> bins(std::size(kBins) - 1);
  for (std::size_t i = 0; i < outcomes.safe.size(); ++i) {
    const auto above =
        std::upper_bound(std::begin(kBins) + 1, std::end(kBins) - 1, outcomes.predicted[i]);
    Bin& bin = bins[static_cast<std::size_t>(above - std::begin(kBins) - 1)];
    ++bin.count;
    bin.safe += outcomes.safe[i] > 0.5 ? 1 : 0;
    bin.predicted += outcomes.predicted[i];
  }
  for (Bin& bin : bins) {
    bin.predicted /= std::max(1, bin.count);
  }
  return bins;
}

/// Largest distance of prediction and share over the bins that count.
double WorstBin(const std::vector<Bin>& bins) {
  double worst = 0;
  for (const Bin& bin : bins) {
    worst =
        bin.count >= kEnough ? std::max(worst, std::abs(bin.predicted - bin.observed())) : worst;
  }
  return worst;
}

/// The non-decreasing steps nearest to the outcomes: neighbours that fall are pooled (Ayer et al.
/// 1955).
class MonotoneShare {
 public:
  explicit MonotoneShare(const Outcomes& outcomes) {
    std::vector<std::size_t> order(outcomes.safe.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return outcomes.predicted[a] < outcomes.predicted[b];
    });
    for (const std::size_t i : order) {
      steps_.push_back({outcomes.predicted[i], outcomes.safe[i], 1});
      while (steps_.size() > 1 && steps_[steps_.size() - 2].share() >= steps_.back().share()) {
        const Step last = steps_.back();
        steps_.pop_back();
        steps_.back() = {last.end, steps_.back().safe + last.safe,
                         steps_.back().count + last.count};
      }
    }
  }
  double At(double predicted) const {
    const auto step = std::lower_bound(steps_.begin(), steps_.end(), predicted,
                                       [](const Step& s, double p) { return s.end < p; });
    return steps_.empty() ? predicted : (step == steps_.end() ? steps_.back() : *step).share();
  }

 private:
  struct Step {
    double end, safe, count;
    double share() const { return safe / count; }
  };
  std::vector<Step> steps_;
};

std::vector<std::string> KindRow(const TrialTable& table, const std::string& kind) {
  const Outcomes own = OutcomesOf(table.Where("kind", kind));
  Outcomes others;
  for (const std::string& other : table.Values("kind")) {
    const Outcomes more = OutcomesOf(table.Where("kind", other));
    for (std::size_t i = 0; other != kind && i < more.safe.size(); ++i) {
      others.Add(more.predicted[i], more.safe[i]);
    }
  }
  const MonotoneShare refitted(others);
  Outcomes again;
  int called = 0, wrongly = 0;
  for (std::size_t i = 0; i < own.safe.size(); ++i) {
    again.Add(refitted.At(own.predicted[i]), own.safe[i]);
    called += own.predicted[i] >= kCalledSafe ? 1 : 0;
    wrongly += own.predicted[i] >= kCalledSafe && own.safe[i] < 0.5 ? 1 : 0;
  }
  return {kind,
          Text("%zu", own.safe.size()),
          Text("%.3f", SpreadOf(own.safe).mean),
          Text("%.3f", SpreadOf(own.predicted).mean),
          Text("%.4f", own.Brier()),
          Text("%.3f", SpreadOf(again.predicted).mean),
          Text("%.4f", again.Brier()),
          Text("%d of %d", wrongly, called)};
}

ExperimentReport Report(const TrialTable& table) {
  const Outcomes all = OutcomesOf(table);
  const std::vector<Bin> bins = BinsOf(all);
  ExperimentReport report{HtmlPage("PALACE: probability of a safe touchdown")};
  PlotSeries series{.name = "touchdowns", .x = {}, .y = {}};
  std::vector<std::vector<std::string>> rows;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    const Bin& bin = bins[b];
    if (bin.count == 0) {
      continue;
    }
    const Interval interval = WilsonInterval(bin.safe, bin.count);
    series.x.push_back(bin.predicted);
    series.y.push_back(bin.observed());
    series.low.push_back(interval.low);
    series.high.push_back(interval.high);
    rows.push_back({Text("%.2f to %.2f", kBins[b], kBins[b + 1]), Text("%d", bin.count),
                    Text("%.3f", bin.predicted), Text("%.3f", bin.observed()),
                    Text("%.3f to %.3f", interval.low, interval.high)});
    report.lines.push_back(
        Text("Predicted %.2f to %.2f, mean %.3f: %d of %d safe, %.3f (95 %% %.3f to %.3f)",
             kBins[b], kBins[b + 1], bin.predicted, bin.safe, bin.count, bin.observed(),
             interval.low, interval.high));
  }
  const Bin& best = bins.back();
  const Interval false_safe = WilsonInterval(best.count - best.safe, best.count);
  const double worst = WorstBin(bins);
  const bool judged =
      std::any_of(bins.begin(), bins.end(), [](const Bin& bin) { return bin.count >= kEnough; });
  report.passed = judged && worst <= kWithin;
  report.lines.push_back(
      judged ? Text("Largest distance in bins of at least %d: %.1f points (limit %.0f)", kEnough,
                    100 * worst, 100 * kWithin)
             : Text("Not judged: no bin holds %d touchdowns, more trials are needed", kEnough));
  report.lines.push_back(Text("Brier score %.4f of %zu touchdowns", all.Brier(), all.safe.size()));
  report.lines.push_back(Text(
      "Called safe with at least %.2f: %d, unsafe of them %d (95 %% %.2f to %.2f %%)", kCalledSafe,
      best.count, best.count - best.safe, 100 * false_safe.low, 100 * false_safe.high));
  LinePlot plot{
      "Reliability", "predicted probability of a safe touchdown", "share that was safe", {}};
  plot.series = {std::move(series)};
  plot.diagonal = true;
  plot.x_min = plot.y_min = 0;
  plot.x_max = plot.y_max = 1;
  report.page.Verdict(report.passed, report.lines[report.lines.size() - 3])
      .List(report.lines)
      .Figure(LinePlotSvg(plot),
              "Bars: 95 % intervals; touchdowns of one field are not independent.")
      .Table({"Predicted", "Touchdowns", "Mean predicted", "Share safe", "95 % interval"}, rows);
  std::vector<std::vector<std::string>> kinds;
  for (const std::string& kind : table.Values("kind")) {
    kinds.push_back(KindRow(table, kind));
  }
  report.page.Heading("Kinds of ground")
      .Paragraph(
          "A probability is right for a mixture of ground. On level ground it is too careful, "
          "among rocks hidden by noise too bold. 'Without this kind': the probabilities "
          "re-fitted, monotone, on all other kinds and used on this one.")
      .Table({"Ground", "Touchdowns", "Share safe", "Predicted", "Brier score",
              "Predicted, without this kind", "Brier score, without this kind",
              "Unsafe of those called safe"},
             kinds);
  return report;
}

}  // namespace

Experiment ProbabilityExperiment() {
  auto set = std::make_shared<std::vector<std::string>>();
  Experiment experiment;
  experiment.name = "probability";
  experiment.purpose = "Touchdowns on simulated ground: predicted probability against share safe";
  experiment.default_trials = 1400;
  experiment.columns = {"kind",        "sigma_m",        "predicted",
                        "safe",        "true_slope_deg", "true_deviation_m",
                        "true_step_m", "true_tilt_deg",  "true_rise_m"};
  experiment.add_options = [set](CLI::App& verb) {
    verb.add_option("--set", *set, "One setting, e.g. slad.gear=pads");
  };
  experiment.setup = [set] {
    std::string text = "defaults";
    for (const std::string& assignment : *set) {
      text += ", " + assignment;
    }
    return text;
  };
  experiment.run = [set](int trial, std::uint64_t seed) { return RunTrial(*set, trial, seed); };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
