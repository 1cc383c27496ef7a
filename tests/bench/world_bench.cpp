// A pair of each family by ray casting, 640x480, four rays a pixel: what experiments on drawn
// ground spend most of their time on. The first pair works out the ground's light that it shows.
#include <benchmark/benchmark.h>

#include <string>

#include "engine/core/units.h"
#include "engine/world/families/families.h"
#include "engine/world/ray_scene.h"

namespace palace {
namespace {

constexpr PinholeCamera kCamera{640, 480, 640, 640, 319.5, 239.5};
constexpr double kHeight_m = 12, kBaseline_m = 1, kTexel_m = 0.02;
constexpr int kSamples = 2;

void CastPair(const RayScene& scene) {
  RigidTransform X_WC{CameraRotationFromTilt(Rad(-50)), {0, 0, -kHeight_m}};
  benchmark::DoNotOptimize(scene.Grey(kCamera, X_WC, kSamples));
  X_WC.p += kBaseline_m * X_WC.R.col(0);
  benchmark::DoNotOptimize(scene.Grey(kCamera, X_WC, kSamples));
}

void FirstPair(benchmark::State& state, const std::string& family) {
  const Result<World> world = MakeFamily(family, 2);
  for (auto _ : state) {
    CastPair(RayScene(*world, kTexel_m));
  }
}

void LaterPair(benchmark::State& state, const std::string& family) {
  const RayScene scene(*MakeFamily(family, 2), kTexel_m);
  CastPair(scene);
  for (auto _ : state) {
    CastPair(scene);
  }
}

void WholeGround(benchmark::State& state, const std::string& family) {
  const Result<World> world = MakeFamily(family, 2);
  for (auto _ : state) {
    benchmark::DoNotOptimize(RayScene(*world, kTexel_m).ground().Texels());
  }
}

const bool kRegistered = [] {
  for (const std::string_view view : FamilyNames()) {
    const std::string family(view);
    const auto add = [&](const std::string& what, auto run) {
      benchmark::RegisterBenchmark((what + " " + family).c_str(),
                                   [run, family](benchmark::State& state) { run(state, family); })
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime()
          ->UseRealTime();
    };
    add("cast first pair", FirstPair);
    add("cast later pair", LaterPair);
    add("light whole ground", WholeGround);
  }
  return true;
}();

}  // namespace
}  // namespace palace
