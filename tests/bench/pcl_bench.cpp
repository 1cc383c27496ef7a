// The peer for robust planes: PCL's least median of squares with 20 random tries, 3x3 points a
// cell.
#include <benchmark/benchmark.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/lmeds.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include <memory>

#include "tests/bench/slad_field.h"

namespace palace {
namespace {

constexpr double kThreshold_m = 0.05;
constexpr int kTries = 20;

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr Window(const ElevationMap& map, int row, int col) {
  auto cloud = std::make_shared<Cloud>();
  for (int r = row - 1; r <= row + 1; ++r) {
    for (int c = col - 1; c <= col + 1; ++c) {
      cloud->push_back({static_cast<float>(map.geometry.NorthOfRow(r)),
                        static_cast<float>(map.geometry.EastOfCol(c)), map.height_m.at(r, c)});
    }
  }
  return cloud;
}

void PeerPclLmeds(benchmark::State& state) {
  const ElevationMap map = testing::BoxField(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    double sum = 0;
    for (int r = 1; r + 1 < map.geometry.rows; ++r) {
      for (int c = 1; c + 1 < map.geometry.cols; ++c) {
        const auto model =
            std::make_shared<pcl::SampleConsensusModelPlane<pcl::PointXYZ>>(Window(map, r, c));
        pcl::LeastMedianSquares<pcl::PointXYZ> lmeds(model, kThreshold_m);
        lmeds.setMaxIterations(kTries);
        if (!lmeds.computeModel()) {
          continue;
        }
        pcl::Indices inliers;
        Eigen::VectorXf plane, refined;
        lmeds.getModelCoefficients(plane);
        lmeds.getInliers(inliers);
        model->optimizeModelCoefficients(inliers, plane, refined);
        sum += static_cast<double>(refined[2]);
      }
    }
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(PeerPclLmeds)->Arg(100)->Arg(512)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace palace
