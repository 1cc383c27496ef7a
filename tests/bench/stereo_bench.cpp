// Stereo: a pair to a range map with sigmas, beside OpenCV's own matchers in the same run.
//
// Arguments are width, height and disparities. Times depend on how many cores are free: the ratio
// to a peer in the same run says more than milliseconds. Budget: 40 ms at 640x480, 96 disparities,
// 2 cores.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/camera/pinhole.h"
#include "engine/core/units.h"
#include "engine/stereo/disparity.h"
#include "engine/stereo/opencv_matchers.h"
#include "engine/stereo/semi_global.h"
#include "engine/stereo/stereo.h"
#include "engine/stereo/subpixel.h"
#include "engine/world/ray_pictures.h"
#include "tests/support/synthetic_stereo.h"

namespace palace {
namespace {

using synthetic::Pair;

const Pair& PairOf(const benchmark::State& state) {
  static std::map<std::pair<int, int>, Pair> pairs;
  const std::pair<int, int> size{static_cast<int>(state.range(0)),
                                 static_cast<int>(state.range(1))};
  auto found = pairs.find(size);
  if (found == pairs.end()) {
    const Pair pair = synthetic::MakePair({}, 15.24, -0.785398, 2, 1, 0, size.first, size.second);
    found = pairs.emplace(size, pair).first;
  }
  return found->second;
}

DisparityWindow WindowOf(const benchmark::State& state) {
  return {16, static_cast<int>(state.range(2))};
}

/// Sizes at 96 disparities, then disparities at 640x480.
void Loads(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"w", "h", "d"})->Unit(benchmark::kMillisecond)->UseRealTime();
  for (const auto& [width, height] : {std::pair{320, 240}, {640, 480}, {960, 720}, {1280, 960}}) {
    bench->Args({width, height, 96});
  }
  for (const int disparities : {32, 64, 128, 256}) {
    bench->Args({640, 480, disparities});
  }
}

void RangeMapWithSigmas(benchmark::State& state) {
  const Pair& pair = PairOf(state);
  StereoMatcher matcher;
  for (auto _ : state) {
    auto result = matcher.Match(pair.left, pair.right, pair.camera, pair.baseline_m,
                                WindowOf(state), StereoSettings{}, Timestamp{});
    benchmark::DoNotOptimize(result);
  }
}
BENCHMARK(RangeMapWithSigmas)->Apply(Loads);

/// Snow under noise: nearly all of it is measured at half the size as well (faint_ground.h).
void RangeMapOfFaintGround(benchmark::State& state) {
  World world;
  world.ground.texture = GroundTexture::kSnow;
  const StereoView view = ViewFrom(world, PinholeFromFov(640, 480, Rad(45)), 15.24, Rad(-45), 3);
  const ImageU8 left = Expose(view.left_grey, {2.5}, 1), right = Expose(view.right_grey, {2.5}, 2);
  StereoMatcher matcher;
  for (auto _ : state) {
    auto result = matcher.Match(left, right, view.camera, view.baseline_m, WindowOf(state),
                                StereoSettings{}, Timestamp{});
    benchmark::DoNotOptimize(result);
  }
}
BENCHMARK(RangeMapOfFaintGround)
    ->ArgNames({"w", "h", "d"})
    ->Args({640, 480, 96})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void RangeMapHalfSizeSearch(benchmark::State& state) {
  const Pair& pair = PairOf(state);
  StereoSettings settings;
  settings.pyramid_levels = 1;
  StereoMatcher matcher;
  for (auto _ : state) {
    auto result = matcher.Match(pair.left, pair.right, pair.camera, pair.baseline_m,
                                WindowOf(state), settings, Timestamp{});
    benchmark::DoNotOptimize(result);
  }
}
BENCHMARK(RangeMapHalfSizeSearch)
    ->ArgNames({"w", "h", "d"})
    ->Args({640, 480, 96})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void SemiGlobalWholePixels(benchmark::State& state) {
  const Pair& pair = PairOf(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(MatchSemiGlobal(pair.left, pair.right, WindowOf(state), {}));
  }
}
BENCHMARK(SemiGlobalWholePixels)->Apply(Loads);

void SemiGlobalWithoutAvx2(benchmark::State& state) {
  const Pair& pair = PairOf(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        MatchSemiGlobal(pair.left, pair.right, WindowOf(state), {}, PortableLoops()));
  }
}
BENCHMARK(SemiGlobalWithoutAvx2)
    ->ArgNames({"w", "h", "d"})
    ->Args({640, 480, 96})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void Refinement(benchmark::State& state) {
  const Pair& pair = PairOf(state);
  const ImageF coarse = MatchSemiGlobal(pair.left, pair.right, WindowOf(state), {});
  for (auto _ : state) {
    benchmark::DoNotOptimize(RefineDisparity(pair.left, pair.right, coarse, {}));
  }
}
BENCHMARK(Refinement)
    ->ArgNames({"w", "h", "d"})
    ->Args({640, 480, 96})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

template <OpenCvMatcher kMatcher>
void OpenCv(benchmark::State& state) {
  const Pair& pair = PairOf(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        MatchWithOpenCv(kMatcher, pair.left, pair.right, WindowOf(state), StereoSettings{}));
  }
}
BENCHMARK_TEMPLATE(OpenCv, OpenCvMatcher::kBm)->Apply(Loads);
BENCHMARK_TEMPLATE(OpenCv, OpenCvMatcher::kSgbm3Way)->Apply(Loads);
BENCHMARK_TEMPLATE(OpenCv, OpenCvMatcher::kSgbm)->Apply(Loads);
BENCHMARK_TEMPLATE(OpenCv, OpenCvMatcher::kSgbmHh)->Apply(Loads);

/// Medians of seven rounds in turn, so that what else the machine does meets all alike.
void RatiosToOpenCv(benchmark::State& state) {
  const Pair& pair = PairOf(state);
  const DisparityWindow window = WindowOf(state);
  const auto now = [] { return std::chrono::steady_clock::now(); };
  StereoMatcher matcher;
  std::map<std::string, std::vector<double>> times_ms;
  const auto time = [&](const char* name, const auto& work) {
    const auto start = now();
    work();
    times_ms[name].push_back(std::chrono::duration<double, std::milli>(now() - start).count());
  };
  for (auto _ : state) {
    time("PALACE", [&] {
      auto result = matcher.Match(pair.left, pair.right, pair.camera, pair.baseline_m, window,
                                  StereoSettings{}, Timestamp{});
      benchmark::DoNotOptimize(result);
    });
    for (const OpenCvMatcher peer : {OpenCvMatcher::kBm, OpenCvMatcher::kSgbm3Way,
                                     OpenCvMatcher::kSgbm, OpenCvMatcher::kSgbmHh}) {
      time(NameOf(peer), [&] {
        benchmark::DoNotOptimize(
            MatchWithOpenCv(peer, pair.left, pair.right, window, StereoSettings{}));
      });
    }
  }
  const auto median = [&](const std::string& name) {
    std::vector<double>& times = times_ms[name];
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
  };
  const double ours_ms = median("PALACE");
  state.counters["ours_ms"] = ours_ms;
  for (const auto& [name, times] : times_ms) {
    if (name != "PALACE") {
      state.counters["ours/" + name] = ours_ms / median(name);
    }
  }
}
BENCHMARK(RatiosToOpenCv)
    ->ArgNames({"w", "h", "d"})
    ->Args({640, 480, 96})
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace palace
