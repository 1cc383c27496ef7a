// The receiver's own work for a 640x480 grey picture, from its five datagrams to the whole message.
#include <benchmark/benchmark.h>

#include "engine/wire/receiver/lcm_reassembler.h"
#include "tests/support/lcm_datagrams.h"

namespace palace {
namespace {

void ReassemblePicture(benchmark::State& state) {
  LcmReassembler receiver;
  receiver.Allow("CAMERA_LEFT", 8u << 20);
  std::vector<Bytes> parts = FragmentDatagrams(0, "CAMERA_LEFT", Bytes(640 * 480 + 44, 7), 65487);
  std::uint32_t number = 0;
  for (auto _ : state) {
    ++number;
    for (Bytes& part : parts) {
      for (int i = 0; i < 4; ++i) {
        part[static_cast<std::size_t>(4 + i)] = static_cast<std::uint8_t>(number >> (24 - 8 * i));
      }
      benchmark::DoNotOptimize(receiver.Take({1, 1}, part.data(), part.size(), 1));
    }
  }
  state.counters["pictures"] = static_cast<double>(receiver.total().messages);
}
BENCHMARK(ReassemblePicture)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace palace
