// A hostile bus: station and vehicle live through it, the picture goes on, memory stays bounded and
// a wave-off leaves at once. PALACE_FULL_STORM=1 runs the numbers of the acceptance, minutes long.
#include <signal.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/scenarios/private_network.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

struct Storm {
  const char* name;
  const char* kind;
  int seeds, count, rate_hz;
};

bool Full() { return std::getenv("PALACE_FULL_STORM") != nullptr; }

/// Peak resident memory so far, MB.
double PeakMegabytes(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("VmHWM:", 0) == 0) {
      return std::stod(line.substr(6)) / 1024;
    }
  }
  return NAN;
}

class BusStormTest : public Scenario {
 protected:
  void SetUp() override {
    std::string why_not;
    network_ = PrivateNetwork::Create(why_not);
    if (!network_) {
      GTEST_SKIP() << why_not;
    }
  }
  ProcessOptions StormProgram(std::vector<std::string> words) const {
    ProcessOptions options;
    options.command = {BUS_STORM_PROGRAM, kUrl};
    options.command.insert(options.command.end(), words.begin(), words.end());
    return network_->Inside(options);
  }
  /// When messages of the channel were heard, monotonic seconds.
  static std::vector<double> Heard(const Process& listener, const std::string& channel) {
    std::istringstream lines(listener.Out());
    std::vector<double> times;
    std::string name;
    for (double time_s = 0; lines >> time_s >> name;) {
      if (name == channel) {
        times.push_back(time_s);
      }
    }
    return times;
  }
  static double Now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  static void Sleep(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  }
  static constexpr std::string_view kReady = "ready\n";  // it hears a vehicle and may order
  static bool SaysReady(Process& station) {
    for (const double start_s = Now_s(); station.Out().empty() && Now_s() - start_s < 40;) {
      Sleep(0.02);
    }
    return station.Out() == kReady;
  }
  std::unique_ptr<PrivateNetwork> network_;
};

TEST_F(BusStormTest, StationAndVehicleLiveThroughItAndThePictureGoesOn) {
  const bool full = Full();
  const std::vector<Storm> storms = {
      {"the two that killed", "killing", 1, 1, 0},
      {"claims of 63 MB", "claims", 1, full ? 10000 : 2000, 1000},
      {"random datagrams", "random", full ? 20 : 4, full ? 5000 : 1000, full ? 5000 : 2000},
      {"hostile payloads", "payloads", full ? 10 : 2, full ? 10000 : 1500, full ? 10000 : 1500},
  };
  WriteFile("look.script", "wait state PROPOSED 90\nwait seconds 500\nquit\n");
  Process vehicle(network_->Inside(Palacectl(
      {"simulate", "--scenario", "runway", "--url", kUrl, "--realtime", "--duration-s", "500"})));
  Process station(network_->Inside(
      Palace({"--headless", "--connect", kUrl, "--script", "look.script", "--record", "rec"})));
  Process listener(StormProgram({"listen", "500"}));
  // Each map makes a proposal: what shows that pictures are looked at.
  const auto frames = [&] { return Heard(listener, "SITE_PROPOSAL"); };
  for (const double start_s = Now_s(); frames().size() < 20 && Now_s() - start_s < 60;) {
    Sleep(0.2);
  }
  ASSERT_GE(frames().size(), 20u) << station.Err() << vehicle.Err();
  const double station_mb = PeakMegabytes(station.pid());
  const double vehicle_mb = PeakMegabytes(vehicle.pid());
  for (const Storm& storm : storms) {
    for (int seed = 1; seed <= storm.seeds; ++seed) {
      SCOPED_TRACE(std::string(storm.name) + ", seed " + std::to_string(seed));
      const std::size_t before = frames().size();
      const double start_s = Now_s();
      const ProcessResult sent =
          RunProcess(StormProgram({"flood", storm.kind, std::to_string(seed),
                                   std::to_string(storm.count), std::to_string(storm.rate_hz)}),
                     120);
      ASSERT_EQ(sent.exit_code, 0) << sent.err;
      const double end_s = Now_s();
      const std::size_t during = frames().size() - before;
      Sleep(1.5);
      const std::vector<double> times = frames();
      const auto next = std::upper_bound(times.begin(), times.end(), end_s);
      ASSERT_TRUE(station.Running() && vehicle.Running());
      ASSERT_NE(next, times.end()) << "no frame after the storm";
      EXPECT_LE(*next - end_s, 1.0);
      std::printf("%s, seed %d: %.1f s, %.1f frames/s during, next after %.2f s\n", storm.name,
                  seed, end_s - start_s, static_cast<double>(during) / (end_s - start_s),
                  *next - end_s);
      if (end_s - start_s > 1.5) {
        EXPECT_GT(during, 0u) << "the picture stood still";
      }
    }
  }
  const double station_more = PeakMegabytes(station.pid()) - station_mb;
  const double vehicle_more = PeakMegabytes(vehicle.pid()) - vehicle_mb;
  std::printf("peak memory: station %.0f MB + %.1f, vehicle %.0f MB + %.1f\n", station_mb,
              station_more, vehicle_mb, vehicle_more);
  EXPECT_LE(station_more, 64);
  EXPECT_LE(vehicle_more, 64);
}

// The whole station but its window, its own wave-off told from the storm's by its number.
TEST_F(BusStormTest, AWaveOffIsOnTheWireWithin50ms) {
  for (const char* kind : {"claims", "random", "payloads"}) {
    SCOPED_TRACE(kind);
    Process vehicle(
        network_->Inside(Palacectl({"simulate", "--scenario", "runway", "--url", kUrl, "--realtime",
                                    "--no-pictures", "--duration-s", "300"})));
    Process station(StormProgram({"wave-off", Full() ? "100" : "10", "2"}));
    ASSERT_TRUE(SaysReady(station)) << station.Err() << vehicle.Err();
    Process storm(StormProgram({"flood", kind, "1", "1000000", "1000"}));
    const ProcessResult result = station.Wait(90);
    EXPECT_TRUE(storm.Running());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string slowest_ms = result.out.substr(kReady.size());
    std::printf("%s: slowest %.2f ms\n", kind, std::stod(slowest_ms));
    EXPECT_LE(std::stod(slowest_ms), 50);
  }
}

TEST_F(BusStormTest, AStationThatWasStartedAnewWavesOffWithin50ms) {
  Process vehicle(
      network_->Inside(Palacectl({"simulate", "--scenario", "runway", "--url", kUrl, "--realtime",
                                  "--no-pictures", "--duration-s", "120"})));
  for (int start = 1; start <= 3; ++start) {
    Process station(StormProgram({"wave-off", "500", "0"}));
    ASSERT_TRUE(SaysReady(station)) << station.Err() << vehicle.Err();
    station.Signal(SIGKILL);
    station.Wait(10);
    const ProcessResult anew = RunProcess(StormProgram({"wave-off", "1", "0"}), 60);
    ASSERT_EQ(anew.exit_code, 0) << anew.err;
    const std::string first_ms = anew.out.substr(kReady.size());
    std::printf("restart %d: %.2f ms\n", start, std::stod(first_ms));
    EXPECT_LE(std::stod(first_ms), 50);
  }
}

}  // namespace
}  // namespace palace
