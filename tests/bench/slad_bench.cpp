// SLAD: maps and sites from an elevation map, both modes.
#include <benchmark/benchmark.h>

#include "engine/slad/slad.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

ElevationMap Field(int side, double noise_m) {
  return testing::MakeMap(side, side, 0.15, testing::WithBox(testing::Flat(), 1, 1, 0.8, 0.7), noise_m);
}

void Evaluate(benchmark::State& state, SladMode mode) {
  const ElevationMap map = Field(static_cast<int>(state.range(0)), 0.02);
  SladSettings settings;
  settings.mode = mode;
  settings.grid_rows = settings.grid_cols = static_cast<int>(state.range(0));
  for (auto _ : state) {
    auto hazards = EvaluateHazards(map, settings);
    benchmark::DoNotOptimize(hazards);
  }
}
void SladModern(benchmark::State& state) { Evaluate(state, SladMode::kModern); }
void SladThesis(benchmark::State& state) { Evaluate(state, SladMode::kThesis); }
BENCHMARK(SladModern)->Arg(100)->Arg(512)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(SladThesis)->Arg(100)->Arg(512)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace palace
