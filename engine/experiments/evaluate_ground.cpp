#include "engine/experiments/evaluate_ground.h"

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
#include "engine/experiments/ground_report.h"
#include "engine/experiments/hidden_fit.h"
#include "engine/experiments/landing_peers.h"
#include "engine/model/site_standing.h"
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

  TrialRow Row(std::vector<std::string> site, const char* by = kByPalace) const {
    TrialRow row = {by,
                    family,
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
  if (!map.narrow.empty()) {
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

TrialRow RowOfNone(const Field& field, const char* by, const std::string& why) {
  TrialRow row = {"0", "none", "none", "nan", "none", "nan", "nan", "nan", "nan", CsvText(why)};
  row.resize(kSiteColumns, "nan");
  return field.Row(std::move(row), by);
}

/// The thesis's best site, then those of the rules of others.
std::vector<PeerPlace> OthersPlaces(const std::vector<FieldFrame>& frames,
                                    const TerrainDecision& decision, const Settings& settings) {
  Settings of_thesis = settings;
  of_thesis.slad.mode = SladMode::kThesis;
  const auto thesis = DecideOnField(frames, of_thesis);
  const std::vector<LandingSite>& sites = thesis->selection.sites;
  std::vector<PeerPlace> places = {{"thesis", std::nullopt}};
  if (!sites.empty()) {
    places.front().place_m = sites.front().p_WS.head<2>();
  }
  for (PeerPlace& place : PlacesOfPeers(frames, *decision.elevation, settings.slad)) {
    places.push_back(std::move(place));
  }
  return places;
}

TrialRow RowOfOther(const Field& field, const World& world, const PeerPlace& other,
                    const Lander& lander, const TruthLimits& limits) {
  if (!other.place_m) {
    return RowOfNone(field, other.rule, "none");
  }
  const SiteTruth truth = TruthOfSite(world, *other.place_m, lander, limits, kHoverEnd_s);
  TrialRow row = {
      "1",   "place", SiteVerdictName(truth.verdict()), CsvNumber(truth.worst_of_limit), truth.what,
      "nan", "nan",   CsvNumber(other.place_m->x()),    CsvNumber(other.place_m->y()),   "none"};
  row.resize(kSiteColumns, "nan");
  return field.Row(std::move(row), other.rule);
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
    rows.push_back(RowOfNone(field, kByPalace, selection.none_reason));
  }
  for (const PeerPlace& other : OthersPlaces(*frames, *decision, settings)) {
    rows.push_back(RowOfOther(field, *world, other, settings.slad.lander, limits));
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
                 family.c_str(), of_field->front()[8].c_str());
  }
  return rows;
}

}  // namespace

Experiment GroundExperiment() {
  auto options = std::make_shared<GroundOptions>();
  Experiment experiment;
  experiment.name = "ground";
  experiment.purpose = "Sites on every family of worlds, held against their truth";
  experiment.default_trials = 8;
  experiment.columns = {
      "by",      "family", "height_m", "tilt_deg", "fov_deg", "safe_in_view", "easy_in_view",
      "rank",    "kind",   "verdict",  "of_limit", "limit",   "probability",  "safe_distance_m",
      "north_m", "east_m", "why",      "hidden",   "sigma_m"};
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
  experiment.report = ReportOfGround;
  return experiment;
}

}  // namespace palace
