// Stereo: a pair to a range map with sigmas, beside OpenCV's own matchers in the same run.
#include <benchmark/benchmark.h>
#include <opencv2/calib3d.hpp>

#include "engine/stereo/stereo.h"
#include "tests/support/synthetic_stereo.h"

namespace palace {
namespace {

const synthetic::Pair& ScenePair() {
  static const synthetic::Pair pair =
      synthetic::MakePair(synthetic::World{}, 15.24, -std::numbers::pi / 4);
  return pair;
}

void RangeMapWithSigmas(benchmark::State& state) {
  const auto& pair = ScenePair();
  const DisparityWindow window{16, static_cast<int>(state.range(0))};
  StereoMatcher matcher;
  for (auto _ : state) {
    auto result = matcher.Match(pair.left, pair.right, pair.camera, pair.baseline_m, window,
                                StereoSettings{}, Timestamp{});
    benchmark::DoNotOptimize(result);
  }
}
BENCHMARK(RangeMapWithSigmas)->Arg(64)->Arg(96)->Unit(benchmark::kMillisecond)->UseRealTime();

cv::Mat View(const ImageU8& image) {
  return cv::Mat(image.height(), image.width(), CV_8U,
                 const_cast<std::uint8_t*>(image.pixels().data()));
}

void OpenCvSgbm3Way(benchmark::State& state) {
  const auto& pair = ScenePair();
  const auto sgbm = cv::StereoSGBM::create(16, static_cast<int>(state.range(0)), 5, 200, 800, 1, 0,
                                           5, 100, 2, cv::StereoSGBM::MODE_SGBM_3WAY);
  cv::Mat disparity;
  for (auto _ : state) {
    sgbm->compute(View(pair.left), View(pair.right), disparity);
  }
}
BENCHMARK(OpenCvSgbm3Way)->Arg(64)->Arg(96)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace palace
