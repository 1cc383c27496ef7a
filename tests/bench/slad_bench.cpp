// SLAD: maps and sites from an elevation map, both modes, and what a moved limit costs.
#include <benchmark/benchmark.h>

#include "engine/slad/hazards/plane_fit.h"
#include "engine/slad/slad.h"
#include "tests/bench/slad_field.h"

namespace palace {
namespace {

using testing::BoxField;

SladSettings SettingsOf(SladMode mode) {
  SladSettings settings;
  settings.mode = mode;
  return settings;
}

/// The vehicle stands south of the map: every site has an approach corridor to look along.
SiteContext Approach(const ElevationMap& map) {
  SiteContext context;
  context.p_WB = {map.geometry.north_min_m, 0, -30};
  return context;
}

void MapsAndSite(benchmark::State& state, SladMode mode) {
  const ElevationMap map = BoxField(static_cast<int>(state.range(0)));
  const SladSettings settings = SettingsOf(mode);
  const SiteContext context = Approach(map);
  for (auto _ : state) {
    const HazardMaps hazards = EvaluateHazards(map, settings);
    SiteSelection selection = SelectSites(map, hazards, settings, context);
    benchmark::DoNotOptimize(selection);
  }
}
void SladThesis(benchmark::State& state) { MapsAndSite(state, SladMode::kThesis); }
void SladModern(benchmark::State& state) { MapsAndSite(state, SladMode::kModern); }

void LimitMoved(benchmark::State& state, SladMode mode) {
  const ElevationMap map = BoxField(static_cast<int>(state.range(0)));
  SladSettings settings = SettingsOf(mode);
  const SiteContext context = Approach(map);
  const TerrainFigures figures = MeasureTerrain(map, settings);
  for (auto _ : state) {
    settings.limits.max_slope_deg =
        settings.limits.max_slope_deg > 11 ? 8 : settings.limits.max_slope_deg + 0.5;
    const HazardMaps hazards = JudgeTerrain(map.geometry, figures, settings);
    SiteSelection selection = SelectSites(map, hazards, settings, context);
    benchmark::DoNotOptimize(selection);
  }
}
void SladThesisLimitMoved(benchmark::State& state) { LimitMoved(state, SladMode::kThesis); }
void SladModernLimitMoved(benchmark::State& state) { LimitMoved(state, SladMode::kModern); }

/// Exact LMedS and least squares at every cell of 3x3 neighbours, what PCL's is asked for too.
void PlanesLmeds(benchmark::State& state) {
  const ElevationMap map = BoxField(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    PlaneMaps planes = FitThesisPlanes(map.height_m, map.geometry.cell_m, 1);
    benchmark::DoNotOptimize(planes);
  }
}

constexpr auto kMs = benchmark::kMillisecond;
BENCHMARK(SladThesis)->Arg(100)->Arg(512)->Arg(2048)->Unit(kMs)->UseRealTime();
BENCHMARK(SladThesisLimitMoved)->Arg(100)->Arg(512)->Arg(2048)->Unit(kMs)->UseRealTime();
BENCHMARK(SladModern)->Arg(100)->Arg(512)->Arg(2048)->Unit(kMs)->UseRealTime();
BENCHMARK(SladModernLimitMoved)->Arg(100)->Arg(512)->Arg(2048)->Unit(kMs)->UseRealTime();
BENCHMARK(PlanesLmeds)->Arg(100)->Arg(512)->Unit(kMs)->UseRealTime();

}  // namespace
}  // namespace palace
