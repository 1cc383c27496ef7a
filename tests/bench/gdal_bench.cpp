// The peer for a plain pass over a map: GDAL's slope and roughness, in process, memory to memory.
#include <benchmark/benchmark.h>
#include <gdal.h>
#include <gdal_utils.h>

#include <cstdlib>
#include <vector>

#include "tests/bench/slad_field.h"

namespace palace {
namespace {

GDALDatasetH InMemory(ElevationMap& map) {
  GDALAllRegister();
  const int side = map.geometry.rows;
  GDALDatasetH data =
      GDALCreate(GDALGetDriverByName("MEM"), "", side, side, 1, GDT_Float32, nullptr);
  double transform[] = {0, map.geometry.cell_m, 0, 0, 0, -map.geometry.cell_m};
  GDALSetGeoTransform(data, transform);
  const CPLErr written = GDALRasterIO(GDALGetRasterBand(data, 1), GF_Write, 0, 0, side, side,
                                      map.height_m.cells().data(), side, side, GDT_Float32, 0, 0);
  PALACE_CHECK(written == CE_None);
  return data;
}

void Process(benchmark::State& state, std::vector<const char*> what) {
  ElevationMap map = testing::BoxField(static_cast<int>(state.range(0)));
  GDALDatasetH data = InMemory(map);
  const char* arguments[] = {"-of", "MEM", "-compute_edges", nullptr};
  GDALDEMProcessingOptions* options =
      GDALDEMProcessingOptionsNew(const_cast<char**>(arguments), nullptr);
  for (auto _ : state) {
    for (const char* pass : what) {
      int failed = 0;
      GDALDatasetH out = GDALDEMProcessing("", data, pass, nullptr, options, &failed);
      PALACE_CHECK(out != nullptr && failed == 0);
      GDALClose(out);
    }
  }
  GDALDEMProcessingOptionsFree(options);
  GDALClose(data);
}

void PeerGdalSlopeAndRoughness(benchmark::State& state) { Process(state, {"slope", "roughness"}); }
BENCHMARK(PeerGdalSlopeAndRoughness)
    ->Arg(100)
    ->Arg(512)
    ->Arg(2048)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace palace
