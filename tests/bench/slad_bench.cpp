// SLAD: maps and sites from an elevation map, both modes, and what a moved limit costs.
#include <benchmark/benchmark.h>

#include "engine/slad/plane_fit.h"
#include "engine/slad/slad.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

/// Ground of 2 cm noise with boxes of 0.15 to 0.8 m on it, one for each 600 cells.
ElevationMap Field(int side) {
  constexpr double kCell_m = 0.15;
  ElevationMap map =
      testing::MakeMap(side, side, kCell_m, testing::Slope(0.05, 1), /*sigma_m=*/0.02);
  RandomStream random(3, "boxes");
  for (int boxes = side * side / 600; boxes > 0; --boxes) {
    const int size = 1 + random.Index(5);
    const float height_m = static_cast<float>(random.Uniform(0.15, 0.8));
    const Cell corner{random.Index(side), random.Index(side)};
    for (int k = 0; k < size * size; ++k) {
      const Cell cell{corner.row + k / size, corner.col + k % size};
      if (map.geometry.Contains(cell)) {
        map.height_m.at(cell) += height_m;
      }
    }
  }
  return map;
}

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
  const ElevationMap map = Field(static_cast<int>(state.range(0)));
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
  const ElevationMap map = Field(static_cast<int>(state.range(0)));
  SladSettings settings = SettingsOf(mode);
  const SiteContext context = Approach(map);
  const TerrainFigures figures = MeasureTerrain(map, settings);
  for (auto _ : state) {
    settings.max_slope_deg = settings.max_slope_deg > 11 ? 8 : settings.max_slope_deg + 0.5;
    const HazardMaps hazards = JudgeTerrain(map.geometry, figures, settings);
    SiteSelection selection = SelectSites(map, hazards, settings, context);
    benchmark::DoNotOptimize(selection);
  }
}
void SladThesisLimitMoved(benchmark::State& state) { LimitMoved(state, SladMode::kThesis); }
void SladModernLimitMoved(benchmark::State& state) { LimitMoved(state, SladMode::kModern); }

/// Exact LMedS and least squares at every cell of 3x3 neighbours, what PCL's is asked for too.
void PlanesLmeds(benchmark::State& state) {
  const ElevationMap map = Field(static_cast<int>(state.range(0)));
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
