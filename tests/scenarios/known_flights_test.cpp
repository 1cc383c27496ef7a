// Whole flights whose decisions are known to the last digit. That a flight is the same twice on one
// machine is proved elsewhere; here it is the same for every compiler and every version of the
// libraries that we build with (g++ 12 and OpenCV 4.6, g++ 14 and OpenCV 4.10, clang), on every
// processor with FMA. Without it the C library's sines and exponentials end in other digits: chosen
// by the processor, not by us. Whether what was decided is good is not asked here.
//
// When a step changes decisions on purpose, say so in its commit and take over the hashes that the
// failure prints.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "engine/core/hash.h"
#include "engine/runtime/engine.h"
#include "engine/runtime/scripted_operator.h"
#include "engine/simulation/session.h"
#include "tests/support/ray_cast_camera.h"

namespace palace {
namespace {

struct KnownFlight {
  const char* scene;
  std::uint64_t seed;
  double wind_mps;
  MissionState until;
  std::uint64_t hash;  ///< of every pass's decisions, and of the touchdown
};

void PrintTo(const KnownFlight& flight, std::ostream* out) {
  *out << flight.scene << " " << flight.seed << ", wind " << flight.wind_mps << " m/s";
}

constexpr KnownFlight kKnownFlights[] = {
    {"runway", 101, 0, MissionState::kLanded, 0x1eb77dd34d975dbd},
    {"slope", 7, 3, MissionState::kDescending, 0x9ad745327ad33a3e},
};
constexpr double kLimit_s = 120;

struct Flown {
  MissionState state = MissionState::kNoLive;
  std::string why;
  int passes = 0;
  std::uint64_t hash = 0;
};

Flown Fly(const KnownFlight& flight) {
  const SimulatedSession session = OpenSimulatedSession({.scenario = flight.scene,
                                                         .seed = flight.seed,
                                                         .wind_mps = flight.wind_mps,
                                                         .duration_limit_s = kLimit_s},
                                                        MakeRayCastCamera)
                                       .value();
  const std::shared_ptr<Simulator>& simulator = session.simulator;
  EngineParts parts;
  parts.mission.session_id = session.id;
  parts.source = simulator;
  parts.link = simulator;
  Engine engine(std::move(parts), /*threaded=*/false);
  // On the slope the straight way is blocked, and no other is approved before it was looked at.
  ScriptedOperator pilot(/*looks_again=*/0, /*looks_closer=*/false, /*searches=*/true);
  ContentHash hash;
  Flown flown;
  while (flown.state != flight.until && engine.Step()) {
    const auto snapshot = engine.Latest();
    hash.Add(snapshot->decision_hash);
    flown.state = snapshot->flight->mission.state;
    flown.why = snapshot->flight->mission.why;
    ++flown.passes;
    for (const EngineCommand& command : pilot.Decide(*snapshot)) {
      engine.Post(command);
    }
  }
  EXPECT_EQ(engine.error(), "");
  if (const Touchdown* touchdown = simulator->touchdown()) {
    for (const double value : touchdown->p_W_skid) {
      hash.Add(value);
    }
  }
  flown.hash = hash.value();
  return flown;
}

bool HasFusedMultiplyAdd() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

class KnownFlights : public testing::TestWithParam<KnownFlight> {};

TEST_P(KnownFlights, DecideAsRecorded) {
  if (!HasFusedMultiplyAdd()) {
    GTEST_SKIP() << "runs on x86-64 with AVX2 and FMA, whose hashes are known";
  }
  const KnownFlight& flight = GetParam();
  const Flown flown = Fly(flight);
  ASSERT_EQ(flown.state, flight.until) << "after " << flown.passes << " passes: " << flown.why;
  char found[32];
  std::snprintf(found, sizeof found, "0x%016llx", static_cast<unsigned long long>(flown.hash));
  EXPECT_EQ(flown.hash, flight.hash) << flown.passes << " passes hash to " << found;
}

INSTANTIATE_TEST_SUITE_P(Seeds, KnownFlights, testing::ValuesIn(kKnownFlights),
                         [](const auto& flight) {
                           return std::string(flight.param.scene) +
                                  std::to_string(flight.param.seed);
                         });

}  // namespace
}  // namespace palace
