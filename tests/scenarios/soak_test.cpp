// Memory over time: an hour of hover and ten flights, recorded, in one process. The suite flies a
// short part of it; PALACE_FULL_SOAK=1 all of it, which takes an hour of two cores.
#include <malloc.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

#include "engine/journal/flight_recorder.h"
#include "engine/runtime/engine.h"
#include "engine/runtime/scripted_operator.h"
#include "engine/simulation/session.h"
#include "gui/platform/offscreen_scene_camera.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr double kAllowed_MBph = 1;
constexpr double kShortGrowth_MB = 16;  ///< of ten seconds, while buffers fill
constexpr double kSettles_s = 660;      ///< the plots keep ten minutes

bool Full() { return std::getenv("PALACE_FULL_SOAK") != nullptr; }

/// Memory of this process that is its own, MB: what an allocation without end makes grow.
double OwnMegabytes() {
  std::ifstream file("/proc/self/smaps_rollup");
  double sum_kB = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("Private_Dirty:", 0) == 0 || line.rfind("Swap:", 0) == 0) {
      sum_kB += std::stod(line.substr(line.find(':') + 1));
    }
  }
  return sum_kB / 1024;
}

/// Of the heap, what nobody has given back, MB: over flights of seconds the pages that the
/// allocator keeps for the next one would say more than what grows.
double HeapMegabytes() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd) / (1024 * 1024);
}

/// Memory at a time; slope of the straight line through all of them, MB per hour.
class Slope {
 public:
  void Add(double time_s, double megabytes) {
    const double h = time_s / 3600;
    n_ += 1, t_ += h, m_ += megabytes, tt_ += h * h, tm_ += h * megabytes;
  }
  double MegabytesPerHour() const { return (n_ * tm_ - t_ * m_) / (n_ * tt_ - t_ * t_); }

 private:
  double n_ = 0, t_ = 0, m_ = 0, tt_ = 0, tm_ = 0;
};

class Soak : public Scenario {
 protected:
  std::unique_ptr<Engine> Open(const SessionSpec& spec, const std::string& name) {
    const SimulatedSession session = OpenSimulatedSession(spec, MakeOffscreenSceneCamera).value();
    EngineParts parts;
    parts.mission.session_id = session.id;
    parts.source = session.simulator;
    parts.link = session.simulator;
    auto recorder = FlightRecorder::Open(folder_ / name, "flight");
    EXPECT_TRUE(recorder.ok());
    parts.sink = std::move(*recorder);
    return std::make_unique<Engine>(std::move(parts), /*threaded=*/false);
  }
};

TEST_F(Soak, AHoverKeepsNoMemory) {
  const double hover_s = Full() ? 3600 : 20;
  const auto engine = Open({.seed = 1, .duration_limit_s = hover_s}, "hover");
  Slope slope;
  std::optional<Timestamp> start;
  double told_s = 0, first_MB = NAN, last_MB = NAN;
  while (engine->Step()) {
    start = start ? *start : engine->Latest()->time;
    const double now_s = SecondsBetween(*start, engine->Latest()->time);
    if (now_s - told_s < 10) {
      continue;
    }
    told_s = now_s;
    last_MB = OwnMegabytes();
    if (Full() && now_s < kSettles_s) {
      continue;
    }
    first_MB = std::isnan(first_MB) ? last_MB : first_MB;
    slope.Add(now_s, last_MB);
    std::error_code ignored;
    std::filesystem::resize_file(folder_ / "hover" / "flight.lcm", 0, ignored);
    if (Full() && std::fmod(now_s, 300) < 10) {
      std::printf("[ measured ] %.0f s: %.2f MB\n", now_s, last_MB);
      std::fflush(stdout);
    }
  }
  EXPECT_EQ(engine->error(), "");
  ASSERT_FALSE(std::isnan(last_MB));
  if (!Full()) {
    EXPECT_LT(last_MB - first_MB, kShortGrowth_MB);
    return;
  }
  std::printf("[ measured ] %.2f MB an hour\n", slope.MegabytesPerHour());
  EXPECT_LT(slope.MegabytesPerHour(), kAllowed_MBph);
}

TEST_F(Soak, FlightsInOneProcessKeepNoMemory) {
  if (!Full()) {
    GTEST_SKIP() << "runs with PALACE_FULL_SOAK=1: ten missions take many minutes";
  }
  Slope slope;
  double flown_s = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    {
      const auto engine = Open({.seed = seed}, "flight_" + std::to_string(seed));
      ScriptedOperator pilot;
      MissionState state = MissionState::kNoLive;
      std::optional<Timestamp> start;
      double now_s = 0;
      while (engine->Step() && !pilot.finished() && now_s < 120) {
        const auto snapshot = engine->Latest();
        start = start ? *start : snapshot->time;
        now_s = SecondsBetween(*start, snapshot->time);
        state = snapshot->flight->mission.state;
        for (const EngineCommand& command : pilot.Decide(*snapshot)) {
          engine->Post(command);
        }
      }
      EXPECT_EQ(state, MissionState::kLanded) << seed;
      flown_s += now_s;
    }
    std::filesystem::remove_all(folder_ / ("flight_" + std::to_string(seed)));
    const double megabytes = HeapMegabytes();
    std::printf("[ measured ] flight %d, %.0f s flown: %.3f MB of heap in use, %.2f MB in all\n",
                static_cast<int>(seed), flown_s, megabytes, OwnMegabytes());
    std::fflush(stdout);
    if (seed > 2) {
      slope.Add(flown_s, megabytes);
    }
  }
  std::printf("[ measured ] %.2f MB an hour\n", slope.MegabytesPerHour());
  EXPECT_LT(slope.MegabytesPerHour(), kAllowed_MBph);
}

}  // namespace
}  // namespace palace
