#include "engine/tools/evaluate_command.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/mission/approval_verifier.h"
#include "engine/runtime/engine.h"
#include "engine/runtime/flight_summary.h"
#include "engine/runtime/scripted_operator.h"
#include "engine/runtime/settings_io.h"

namespace palace {
namespace {

constexpr double kMissionLimit_s = 180;
constexpr double kGustPerMean = 1.5;  // W20 of the turbulence beside the mean wind
constexpr double kZ95 = 1.959963984540054;

struct LandingOptions {
  std::string scenario = "runway";
  int trials = 10;
  std::uint64_t seed = 1;
  double wind_mps = 0;
  std::vector<std::string> set;
  std::filesystem::path out;
};

/// 95 % score interval of a proportion (Wilson 1927).
std::pair<double, double> Wilson(int hits, int trials) {
  const double n = trials, p = hits / n, z2 = kZ95 * kZ95;
  const double centre = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kZ95 * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n)) / (1 + z2 / n);
  return {centre - half, centre + half};
}

Result<FlightSummary> FlyOne(const LandingOptions& options, const Settings& settings,
                             std::uint64_t seed, const SceneCameraFactory& camera) {
  Result<Scene> scene = MakeScene(options.scenario, seed);
  if (!scene) {
    return scene.error();
  }
  EngineParts parts;
  parts.settings = settings;
  parts.mission.session_id = seed;
  parts.mission.signer = ApprovalSigner::FromSeed(seed);
  SimulatorOptions simulation;
  simulation.scene = *scene;
  simulation.seed = seed;
  simulation.wind.mean_mps = options.wind_mps;
  simulation.wind.gust_w20_mps = kGustPerMean * options.wind_mps;
  simulation.verify = MakeApprovalVerifier(parts.mission.signer.public_key());
  auto simulator = std::make_shared<Simulator>(std::move(simulation), camera);
  parts.source = simulator;
  parts.link = simulator;
  Engine engine(std::move(parts), /*threaded=*/false);
  FlightSummarizer summarizer(*scene);
  ScriptedOperator pilot;
  while (engine.Step()) {
    const auto snapshot = engine.Latest();
    summarizer.Add(*snapshot);
    for (const EngineCommand& command : pilot.Decide(*snapshot)) {
      engine.Post(command);
    }
    if (pilot.finished() || summarizer.summary().duration_s > kMissionLimit_s) {
      return summarizer.summary();
    }
  }
  if (!engine.error().empty()) {
    return UnavailableError(engine.error());
  }
  return summarizer.summary();
}

struct LandingTally {
  int trials = 0, landed = 0, within = 0, clear = 0;
  SeriesStats miss_m, mean_error_m, max_error_m;
};

void Count(const FlightSummary& s, LandingTally& tally) {
  ++tally.trials;
  const bool landed = s.final_state == MissionState::kLanded;
  tally.landed += landed ? 1 : 0;
  tally.within += landed && s.touchdown_miss_m && *s.touchdown_miss_m <= 0.5 ? 1 : 0;
  tally.clear +=
      s.site_obstacle_distance_m && *s.site_obstacle_distance_m >= s.lander_radius_m ? 1 : 0;
  tally.miss_m.Add(s.touchdown_miss_m.value_or(NAN));
  tally.mean_error_m.Add(s.estimate_error_m.count ? s.estimate_error_m.mean : NAN);
  tally.max_error_m.Add(s.estimate_error_m.count ? s.estimate_error_m.max : NAN);
}

void PrintShare(const char* what, int hits, int trials) {
  const auto [low, high] = Wilson(hits, trials);
  std::printf("%s: %d of %d (95 %% interval %.1f to %.1f %%)\n", what, hits, trials, 100 * low,
              100 * high);
}

int RunLanding(const LandingOptions& options, const SceneCameraFactory& camera) {
  Settings settings;
  for (const std::string& assignment : options.set) {
    const Result<Settings> changed = ApplySettingText(settings, assignment);
    if (!changed) {
      std::cerr << "palacectl: " << changed.error().message << "\n";
      return 2;
    }
    settings = *changed;
  }
  std::ofstream csv;
  if (!options.out.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    csv.open(options.out / "landing.csv");
    csv << "seed,final_state,duration_s,touchdown_miss_m,site_obstacle_distance_m,"
           "vision_error_mean_m,vision_error_max_m,gps_error_mean_m\n";
    if (!csv) {
      std::cerr << "palacectl: cannot write " << (options.out / "landing.csv").string()
                << "; choose a folder you may write to\n";
      return 1;
    }
  }
  LandingTally tally;
  for (int i = 0; i < options.trials; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    const Result<FlightSummary> flown = FlyOne(options, settings, seed, camera);
    if (!flown) {
      std::cerr << "palacectl: " << flown.error().message << "\n";
      return flown.error().code == ErrorCode::kUsage ? 2 : 1;
    }
    Count(*flown, tally);
    const double miss = flown->touchdown_miss_m.value_or(NAN);
    const double obstacle = flown->site_obstacle_distance_m.value_or(NAN);
    std::printf(
        "seed %3llu: %-10s %5.1f s, miss %.3f m, nearest obstacle %.2f m, vision error mean "
        "%.3f m max %.3f m\n",
        static_cast<unsigned long long>(seed), MissionStateName(flown->final_state),
        flown->duration_s, miss, obstacle, flown->estimate_error_m.mean,
        flown->estimate_error_m.max);
    std::fflush(stdout);
    if (csv.is_open()) {
      csv << seed << ',' << MissionStateName(flown->final_state) << ',' << flown->duration_s << ','
          << miss << ',' << obstacle << ',' << flown->estimate_error_m.mean << ','
          << flown->estimate_error_m.max << ',' << flown->gps_error_m.mean << '\n';
    }
  }
  PrintShare("Landed", tally.landed, tally.trials);
  PrintShare("Touchdown within 0.5 m", tally.within, tally.trials);
  PrintShare("Site clear of every true obstacle by the lander radius", tally.clear, tally.trials);
  std::printf("Touchdown miss: mean %.3f m, max %.3f m\n", tally.miss_m.mean, tally.miss_m.max);
  std::printf("Vision estimate against truth: mean %.3f m, max %.3f m\n", tally.mean_error_m.mean,
              tally.max_error_m.max);
  return tally.landed == tally.trials ? 0 : 1;
}

}  // namespace

void AddEvaluateCommand(CLI::App& app, int& exit_code, SceneCameraFactory camera) {
  CLI::App* evaluate = app.add_subcommand("evaluate", "Experiments with seeds and intervals");
  evaluate->require_subcommand(1);
  CLI::App* landing = evaluate->add_subcommand(
      "landing", "Whole missions, one a seed, flown by a scripted operator");
  auto options = std::make_shared<LandingOptions>();
  landing->add_option("--scenario", options->scenario, "Scene")->capture_default_str();
  landing->add_option("--trials", options->trials, "Missions")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  landing->add_option("--seed", options->seed, "First seed")->capture_default_str();
  landing->add_option("--wind", options->wind_mps, "Mean wind, m/s")
      ->check(CLI::Range(0.0, 15.0))
      ->capture_default_str();
  landing->add_option("--set", options->set, "One setting, e.g. slad.max_slope_deg=8");
  landing->add_option("--out", options->out, "Folder for landing.csv");
  landing->callback([options, camera, &exit_code] { exit_code = RunLanding(*options, camera); });
}

}  // namespace palace
