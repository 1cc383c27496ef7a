#include "engine/experiments/evaluate_ground.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/experiments/family_options.h"
#include "engine/experiments/ground_field.h"
#include "engine/experiments/hidden_fit.h"
#include "engine/model/site_standing.h"
#include "engine/report/statistics.h"
#include "engine/runtime/settings_io.h"
#include "engine/slad/hazards/hidden_things.h"
#include "engine/slad/slad.h"
#include "engine/world/families/families.h"

namespace palace {
namespace {

constexpr double kLookRadius_m = 0.3;  // a disc in view is that much wider than the clear radius
constexpr double kEasy = 0.6;          // of all limits
constexpr double kHoverEnd_s = 1;

struct GroundOptions {
  FamilyOptions worlds;
  std::vector<double> heights_m = {8, 15, 20, 30};
  double pose_errors = 1;
  std::string pictures{};  ///< where drawn pairs are kept; empty: nowhere
  std::vector<std::string> set;
  KeptPictures Kept(const std::string& family, std::uint64_t seed, double height_m) const {
    return pictures.empty() ? KeptPictures{}
                            : KeptPictures(pictures, family + "-" + std::to_string(seed) + "-" +
                                                         CsvNumber(height_m) + "m");
  }
  std::string Setup() const {
    std::string text = worlds.Text() + ", heights";
    for (const double height_m : heights_m) {
      text += " " + CsvNumber(height_m);
    }
    text += " m, pose errors times " + CsvNumber(pose_errors);
    for (const std::string& assignment : set) {
      text += ", " + assignment;
    }
    return text;
  }
};

/// Columns of one site, or of none.
constexpr std::size_t kSiteColumns = 12 + std::size(kHiddenDensities);
std::string HiddenColumn(double density) { return "hidden_" + CsvNumber(density); }

const char* KindOf(SiteStanding standing) {
  switch (standing) {
    case SiteStanding::kConfirmed:
      return "confirmed";
    case SiteStanding::kProvisional:
      return "provisional";
    case SiteStanding::kToLookAt:
      return "look";
  }
  PALACE_CHECK(false);
}

/// What a field's rows share.
struct Field {
  std::string family;
  ViewPlan plan;
  bool safe_in_view = false, easy_in_view = false;

  TrialRow Row(std::vector<std::string> site) const {
    TrialRow row = {family,
                    CsvNumber(plan.height_m),
                    CsvNumber(Deg(plan.tilt_rad)),
                    CsvNumber(Deg(2 * std::atan(plan.camera.width / 2.0 / plan.camera.fx_px))),
                    safe_in_view ? "1" : "0",
                    easy_in_view ? "1" : "0"};
    row.insert(row.end(), site.begin(), site.end());
    return row;
  }
};

/// What a field's sites hide, for each of kHiddenDensities.
std::vector<GridF> HiddenOn(const TerrainDecision& decision) {
  const ElevationMap& map = *decision.elevation;
  std::vector<GridF> hidden;
  if (!map.narrow.share.empty()) {
    const NarrowView view{map.narrow, map.geometry.cell_m, decision.settings.limits.max_deviation_m,
                          &decision.hazards->safe_distance_m};
    for (const double density : kHiddenDensities) {
      hidden.push_back(HiddenThings(view, decision.settings.lander.clear_radius_m(), density));
    }
  }
  return hidden;
}

TrialRow RowOfSite(const Field& field, const World& world, const LandingSite& site, int rank,
                   const Settings& settings, const TruthLimits& limits,
                   const std::vector<GridF>& hidden_on) {
  const Eigen::Vector2d place_m = site.p_WS.head<2>();
  const SiteTruth truth = TruthOfSite(world, place_m, settings.slad.lander, limits, kHoverEnd_s);
  TrialRow row = {CsvNumber(rank),
                  KindOf(StandingOf(site, settings.slad)),
                  SiteVerdictName(truth.verdict()),
                  CsvNumber(truth.worst_of_limit),
                  truth.what,
                  CsvNumber(site.safe_probability),
                  CsvNumber(site.safe_distance_m),
                  CsvNumber(place_m.x()),
                  CsvNumber(place_m.y()),
                  "none",
                  CsvNumber(site.hidden_things),
                  CsvNumber(site.roughness_m.three_sigma / 3)};
  for (const GridF& hidden : hidden_on) {
    row.push_back(CsvNumber(static_cast<double>(hidden.at(site.cell))));
  }
  row.resize(kSiteColumns, "nan");  // maps without such figures
  return field.Row(std::move(row));
}

Result<std::vector<TrialRow>> RunField(const GroundOptions& options, const std::string& family,
                                       int trial, std::uint64_t seed, const Settings& settings) {
  const Result<World> world = MakeFamily(family, seed);
  if (!world) {
    return world.error();
  }
  const TruthLimits limits{settings.slad.limits.max_slope_deg, settings.slad.limits.max_deviation_m,
                           settings.slad.limits.max_step_m};
  Field field{family, DrawViewPlan(family, seed)};
  if (family != "rmax") {  // that one is seen from where its helicopter flew
    field.plan.height_m =
        options.heights_m[static_cast<std::size_t>(trial) % options.heights_m.size()];
  }
  const double radius_m = settings.slad.lander.clear_radius_m() + kLookRadius_m;
  field.safe_in_view = SeesSafeDisc(*world, field.plan, radius_m, limits, 1);
  field.easy_in_view =
      field.safe_in_view && SeesSafeDisc(*world, field.plan, radius_m, limits, kEasy);
  const auto frames = LookAtGround(*world, field.plan, options.pose_errors, settings.stereo, seed,
                                   options.Kept(family, seed, field.plan.height_m));
  if (!frames) {
    return frames.error();
  }
  const auto decision = DecideOnField(*frames, settings);
  const SiteSelection& selection = decision->selection;
  const std::vector<GridF> hidden = HiddenOn(*decision);
  std::vector<TrialRow> rows;
  for (const LandingSite& site : selection.sites) {
    rows.push_back(RowOfSite(field, *world, site, static_cast<int>(rows.size()) + 1, settings,
                             limits, hidden));
  }
  if (rows.empty()) {
    TrialRow row = {"0",   "none", "none", "nan", "none",
                    "nan", "nan",  "nan",  "nan", CsvText(selection.none_reason)};
    row.resize(kSiteColumns, "nan");
    rows.push_back(field.Row(std::move(row)));
  }
  return rows;
}

Result<std::vector<TrialRow>> RunTrial(const GroundOptions& options, int trial,
                                       std::uint64_t seed) {
  const Result<Settings> settings = SettingsOfCommandLine(Settings{}, {}, options.set);
  if (!settings) {
    return settings.error();
  }
  std::vector<TrialRow> rows;
  for (const std::string& family : options.worlds.Families()) {
    const auto of_field = RunField(options, family, trial, seed, *settings);
    if (!of_field) {
      return of_field.error();
    }
    rows.insert(rows.end(), of_field->begin(), of_field->end());
    std::fprintf(stderr, "seed %llu, %s: %s\n", static_cast<unsigned long long>(seed),
                 family.c_str(), of_field->front()[7].c_str());
  }
  return rows;
}

int Count(const TrialTable& table, const char* kind) {
  return static_cast<int>(table.Where("kind", kind).rows.size());
}

/// Those whose verdict is that or worse.
int AtLeast(const TrialTable& table, SiteTruth::Verdict verdict) {
  int count = 0;
  for (int i = static_cast<int>(verdict); i < kSiteVerdictCount; ++i) {
    count += static_cast<int>(
        table.Where("verdict", SiteVerdictName(static_cast<SiteTruth::Verdict>(i))).rows.size());
  }
  return count;
}

std::string Share(int hits, int trials) {
  if (trials == 0) {
    return "-";
  }
  const Interval share = WilsonInterval(hits, trials);
  return WithNumbers("%.0f of %.0f", hits, trials) +
         WithNumbers(" (%.1f to %.1f %%)", 100 * share.low, 100 * share.high);
}

/// Fields, by their first row, of which `column` reads 1, and those of them with a site.
std::array<int, 2> Offered(const TrialTable& table, const char* column) {
  std::array<int, 2> counts{};
  const std::vector<double> rank = table.Numbers("rank"), in_view = table.Numbers(column);
  for (std::size_t i = 0; i < rank.size(); ++i) {
    if (rank[i] <= 1 && in_view[i] > 0.5) {
      ++counts[0];
      counts[1] += rank[i] > 0.5 ? 1 : 0;
    }
  }
  return counts;
}

std::vector<std::string> RowOfReport(const std::string& name, const TrialTable& table) {
  const TrialTable confirmed = table.Where("kind", "confirmed"),
                   provisional = table.Where("kind", "provisional"),
                   looks = table.Where("kind", "look");
  const int n = Count(table, "confirmed"), m = Count(table, "provisional"),
            k = Count(table, "look");
  const auto safe = Offered(table, "safe_in_view"), easy = Offered(table, "easy_in_view");
  using V = SiteTruth::Verdict;
  return {name,
          Share(AtLeast(confirmed, V::kOver), n),
          Share(AtLeast(confirmed, V::kUnsafe), n),
          Share(AtLeast(confirmed, V::kGrosslyUnsafe), n),
          Share(AtLeast(provisional, V::kUnsafe), m),
          Share(AtLeast(looks, V::kUnsafe), k),
          Share(safe[1], safe[0]),
          Share(easy[1], easy[0])};
}

std::vector<JudgedSite> JudgedSites(const TrialTable& table) {
  std::vector<JudgedSite> sites;
  const std::size_t family = table.Index("family"), verdict = table.Index("verdict");
  std::vector<std::vector<double>> hidden;
  for (const double density : kHiddenDensities) {
    hidden.push_back(table.Numbers(HiddenColumn(density)));
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    JudgedSite site{table.rows[i][family], {}, false};
    for (const std::vector<double>& of_density : hidden) {
      site.hidden.push_back(of_density[i]);
    }
    const std::string& is = table.rows[i][verdict];
    site.unsafe = is == SiteVerdictName(SiteTruth::Verdict::kUnsafe) ||
                  is == SiteVerdictName(SiteTruth::Verdict::kGrosslyUnsafe);
    if (!std::isnan(site.hidden.front())) {
      sites.push_back(std::move(site));
    }
  }
  return sites;
}

/// Probabilities said against the share of sites that were safe, in bins.
void AddCalibration(const TrialTable& table, HtmlPage& page) {
  constexpr double kEdges[] = {0, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 1.0001};
  const std::vector<double> said = table.Numbers("probability");
  const std::size_t verdict = table.Index("verdict");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k + 1 < std::size(kEdges); ++k) {
    double sum = 0;
    int count = 0, safe = 0;
    for (std::size_t i = 0; i < said.size(); ++i) {
      if (said[i] >= kEdges[k] && said[i] < kEdges[k + 1]) {
        const std::string& is = table.rows[i][verdict];
        sum += said[i];
        ++count;
        safe += is == SiteVerdictName(SiteTruth::Verdict::kWithin) ||
                        is == SiteVerdictName(SiteTruth::Verdict::kOver)
                    ? 1
                    : 0;
      }
    }
    if (count > 0) {
      rows.push_back({WithNumbers("%.2f to ", kEdges[k]) + WithNumbers("%.2f", kEdges[k + 1]),
                      WithNumbers("%.3f", sum / count), Share(safe, count)});
    }
  }
  page.Heading("Probability said and found").Table({"Said", "Mean", "Safe up to 1.2 x"}, rows);
}

void AddLeaveOneOut(const TrialTable& table, ExperimentReport& report) {
  const std::vector<JudgedSite> sites = JudgedSites(table);
  const std::vector<LeftOut> left_out = LeaveOneOut(sites);
  if (left_out.empty()) {
    return;
  }
  std::vector<std::vector<std::string>> rows;
  for (const LeftOut& one : left_out) {
    rows.push_back({one.family, WithNumbers("%.4f", one.things_per_m2),
                    WithNumbers("%.1f %%", 100 * one.said_unsafe), Share(one.unsafe, one.sites)});
  }
  report.lines.push_back("Hidden rocks and holes a square metre, fitted on all these sites: " +
                         WithNumbers("%.4f, in force %.4f", FitDensity(sites), kThingsPer_m2));
  report.page.Heading("Leave one family out")
      .Paragraph(
          "Rocks and holes hidden a square metre, fitted on the sites of all other families; by it "
          "the mean chance that something over 1.2 times a limit hides under a site of this "
          "family, and the share of its sites that were so. Nothing else is fitted.")
      .Table({"Family left out", "Fitted, 1/m2", "Said unsafe", "Unsafe"}, rows);
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: sites on every family of worlds")};
  std::vector<std::vector<std::string>> rows;
  for (const std::string& family : table.Values("family")) {
    rows.push_back(RowOfReport(family, table.Where("family", family)));
  }
  for (const std::string& height : table.Values("height_m")) {
    rows.push_back(RowOfReport(height + " m", table.Where("height_m", height)));
  }
  rows.push_back(RowOfReport("all", table));
  const std::vector<std::string>& all = rows.back();
  const TrialTable nowhere = table.Where("family", "nowhere");
  const int offered =
      Count(nowhere, "confirmed") + Count(nowhere, "provisional") + Count(nowhere, "look");
  const int gross = AtLeast(table.Where("kind", "confirmed"), SiteTruth::Verdict::kGrosslyUnsafe);
  report.passed = gross == 0 && offered == 0;
  report.lines = {"Confirmed sites over a limit: " + all[1],
                  "Confirmed sites over 1.2 times a limit (unsafe): " + all[2],
                  "Confirmed sites over 1.5 times a limit (grossly unsafe): " + all[3],
                  "Provisional sites over 1.2 times a limit: " + all[4],
                  "Places to look at first over 1.2 times a limit: " + all[5],
                  "Fields with a safe disc in view that are offered a site: " + all[6],
                  "Fields with an easy disc in view that are offered a site: " + all[7],
                  "Sites offered where nothing is safe (nowhere): " + WithNumbers("%.0f", offered)};
  report.page.List(report.lines)
      .Paragraph(
          "Shares with 95 % intervals (Wilson). A site is judged by the worst touchdown within the "
          "navigation error of its middle; limits as set. Water and what moves count as grossly "
          "unsafe. An easy disc keeps six tenths of every limit. Sites of one field are related.")
      .Table({"Family or height", "Confirmed: over a limit", "Confirmed: over 1.2 x",
              "Confirmed: over 1.5 x", "Provisional: over 1.2 x", "Look first: over 1.2 x",
              "Safe disc in view: offered", "Easy disc in view: offered"},
             rows);
  AddCalibration(table, report.page);
  AddLeaveOneOut(table, report);
  return report;
}

}  // namespace

Experiment GroundExperiment() {
  auto options = std::make_shared<GroundOptions>();
  Experiment experiment;
  experiment.name = "ground";
  experiment.purpose = "Sites on every family of worlds, held against their truth";
  experiment.default_trials = 8;
  experiment.columns = {
      "family", "height_m", "tilt_deg", "fov_deg", "safe_in_view", "easy_in_view",    "rank",
      "kind",   "verdict",  "of_limit", "limit",   "probability",  "safe_distance_m", "north_m",
      "east_m", "why",      "hidden",   "sigma_m"};
  for (const double density : kHiddenDensities) {
    experiment.columns.push_back(HiddenColumn(density));
  }
  experiment.add_options = [options](CLI::App& verb) {
    options->worlds.Add(verb);
    verb.add_option("--heights", options->heights_m,
                    "Heights over the ground, m, one a trial in turn (rmax has its own)")
        ->delimiter(',')
        ->check(FiniteRange(3.0, 60.0))
        ->capture_default_str();
    verb.add_option("--pose-errors", options->pose_errors, "Times the pose errors of the draw")
        ->check(FiniteRange(0.0, 10.0))
        ->capture_default_str();
    verb.add_option("--pictures", options->pictures,
                    "Keep the drawn pairs in this folder and take those that are there, "
                    "for the next run of another version of SLAD on the same ground");
    verb.add_option("--set", options->set, "One setting, e.g. slad.max_slope_deg=8");
  };
  experiment.setup = [options] { return options->Setup(); };
  experiment.run = [options](int trial, std::uint64_t seed) {
    return RunTrial(*options, trial, seed);
  };
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
