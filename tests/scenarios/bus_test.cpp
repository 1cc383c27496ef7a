// A vehicle on an LCM bus: palacectl simulate, or a log in the stock player, into palace --connect.
#include <signal.h>

#include <thread>

#include "engine/journal/log_index.h"
#include "tests/scenarios/private_network.h"
#include "tests/scenarios/scenario.h"
#include "tests/support/expected.h"

namespace palace {
namespace {

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

class LiveBus : public Scenario {
 protected:
  void SetUp() override {
    std::string why_not;
    network_ = PrivateNetwork::Create(why_not);
    if (!network_) {
      GTEST_SKIP() << why_not;
    }
  }
  /// The station inside the network, driven by a script.
  ProcessResult Station(const std::string& record) {
    return RunProcess(network_->Inside(Palace({"--headless", "--connect", kUrl, "--script",
                                               "look.script", "--record", record})),
                      60);
  }
  std::unique_ptr<PrivateNetwork> network_;
};

/// Pictures and poses of a recorded flight.
struct Heard {
  int pictures = 0;
  int poses = 0;
};

Heard HeardIn(const std::filesystem::path& log) {
  Heard heard;
  const auto source = OpenLog(log);
  for (auto bundle = source->Next({}); bundle; bundle = source->Next({})) {
    heard.pictures += (*bundle)->stereo ? 1 : 0;
    heard.poses += static_cast<int>((*bundle)->poses.size());
  }
  return heard;
}

bool Reaches(const FlightRecord& record, MissionState state) {
  for (const FlightRecordSample& sample : record.samples) {
    if (sample.state == state) {
      return true;
    }
  }
  return false;
}

/// Of the last event of a log as far as it is written; 0 while there is none.
Timestamp EndOf(const std::filesystem::path& log) {
  const auto file = LogFile::Open(log);
  const auto index = file ? BuildIndex(*file) : Result<LogIndex>(file.error());
  return index ? index->entries.back().time : Timestamp{};
}

/// The vehicle's own log says what there was to hear at the moment of the kill.
TEST_F(LiveBus, AKilledStationLosesLessThanASecond) {
  WriteFile("look.script", "wait seconds 500\nquit\n");
  const std::filesystem::path vehicle_log = folder_ / "vehicle.lcm";
  Process vehicle(network_->Inside(Palacectl(
      {"simulate", "--url", kUrl, "--realtime", "--no-pictures", "--log", vehicle_log.string()})));
  Process station(network_->Inside(
      Palace({"--headless", "--connect", kUrl, "--script", "look.script", "--record", "rec"})));
  const auto recorded = [&] {
    const auto flights = FlightsIn(folder_ / "rec");
    return flights.empty() ? Timestamp{} : EndOf(flights[0] / "flight.lcm");
  };
  Timestamp first;
  for (int i = 0; i < 1200; ++i) {
    const Timestamp now = recorded();
    first = first == Timestamp{} ? now : first;
    if (SecondsBetween(first, now) >= 3) {
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const Timestamp heard = EndOf(vehicle_log);
  station.Signal(SIGKILL);
  EXPECT_EQ(station.Wait(10).signal, SIGKILL);
  vehicle.Signal(SIGINT);
  (void)vehicle.Wait(10);
  ASSERT_NE(first, Timestamp{}) << station.Err() << vehicle.Err();
  const double lost_s = SecondsBetween(recorded(), heard);
  std::printf("the log of the killed station ends %.2f s before the kill\n", lost_s);
  EXPECT_LT(lost_s, 1);
}

TEST_F(LiveBus, TheSimulatedVehicleAppearsLive) {
  WriteFile("look.script",
            "wait state PROPOSED 60\n"
            "expect text mode LIVE\n"
            "wait seconds 1\n"
            "screenshot live.png\n"
            "quit\n");
  Process vehicle(network_->Inside(Palacectl(
      {"simulate", "--scenario", "runway", "--url", kUrl, "--realtime", "--duration-s", "60"})));
  const ProcessResult station = Station("rec");
  EXPECT_EQ(station.exit_code, 0) << station.err;
  vehicle.Signal(SIGINT);
  const ProcessResult flown = vehicle.Wait(10);
  EXPECT_EQ(flown.exit_code, 0) << flown.err;
  // It has no key, so it only looks.
  EXPECT_NE(flown.out.find(" 0 messages from stations"), std::string::npos) << flown.out;

  const auto flights = FlightsIn(folder_ / "rec");
  ASSERT_EQ(flights.size(), 1u) << station.err << vehicle.Out();
  EXPECT_TRUE(std::filesystem::exists(flights[0] / "live.png"));
  const std::filesystem::path log = flights[0] / "flight.lcm";
  const Heard heard = HeardIn(log);
  EXPECT_GE(heard.pictures, 10);
  EXPECT_GE(heard.poses, 50);
  const auto record = OpenLog(log)->recorded();
  EXPECT_TRUE(Reaches(*record, MissionState::kProposed));
  EXPECT_LT(record->duration_s, 60) << "the time before the first message is in the log";
}

/// A log, as a vehicle's own computer leaves it.
TEST_F(LiveBus, ALogInTheStockPlayerAppearsLive) {
  if (FindProgram("lcm-logplayer").empty()) {
    ASSERT_FALSE(InCi());
    GTEST_SKIP() << "runs with lcm-logplayer (liblcm-bin) installed";
  }
  const std::filesystem::path log = folder_ / "vehicle.lcm";
  const ProcessResult flown = RunProcess(Palacectl({"simulate", "--scenario", "runway", "--log",
                                                    log.string(), "--fast", "--duration-s", "8"}),
                                         60);
  ASSERT_EQ(flown.exit_code, 0) << flown.err;
  WriteFile("look.script",
            "wait state SEARCH|PROPOSED 30\n"
            "expect text mode LIVE\n"
            "screenshot played.png\n"
            "quit\n");
  ProcessOptions player;
  player.command = {"lcm-logplayer", "--speed=0.5", std::string("--lcm-url=") + kUrl, log};
  player.prepare = [] {
    usleep(1'500'000);  // the station listens before the log begins
    return true;
  };
  const auto wait = player.prepare;
  player = network_->Inside(player);
  player.prepare = [wait, enter = player.prepare] { return enter() && wait(); };
  Process playing(player);
  const ProcessResult replayed = Station("rec");
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err << playing.Err();
  const auto flights = FlightsIn(folder_ / "rec");
  ASSERT_EQ(flights.size(), 1u) << replayed.err;
  EXPECT_TRUE(std::filesystem::exists(flights[0] / "played.png"));
  const Heard heard = HeardIn(flights[0] / "flight.lcm");
  EXPECT_GE(heard.pictures, 1);
  EXPECT_GE(heard.poses, 5);
}

TEST_F(LiveBus, RenamedChannelsAreHeardByWhoIsToldTheirNames) {
  const std::string names = WriteFile("names.toml",
                                      "[channels]\ncamera_left = \"HELI_LEFT\"\n"
                                      "camera_rig = \"HELI_RIG\"\nvehicle_pose = \"HELI_POSE\"\n");
  WriteFile("look.script", "wait state SEARCH|PROPOSED 30\nquit\n");
  Process vehicle(
      network_->Inside(Palacectl({"simulate", "--scenario", "runway", "--url", kUrl, "--realtime",
                                  "--duration-s", "40", "--channels", names})));
  const ProcessResult told =
      RunProcess(network_->Inside(Palace({"--headless", "--no-record", "--connect", kUrl,
                                          "--channels", names, "--script", "look.script"})),
                 60);
  EXPECT_EQ(told.exit_code, 0) << told.err;
  WriteFile("look.script", "wait seconds 1\nexpect state NO_LIVE\nquit\n");
  const ProcessResult untold = Station("rec");
  EXPECT_EQ(untold.exit_code, 0) << untold.err;
  vehicle.Signal(SIGINT);
  EXPECT_EQ(vehicle.Wait(10).exit_code, 0);
}

TEST_F(LiveBus, ASilentBusIsWaitedForAndLeavesNoFlight) {
  WriteFile("look.script",
            "wait seconds 0.5\n"
            "expect state NO_LIVE\n"
            "quit\n");
  const ProcessResult station = Station("rec");
  EXPECT_EQ(station.exit_code, 0) << station.err;
  for (const auto& flight : FlightsIn(folder_ / "rec")) {
    EXPECT_FALSE(std::filesystem::exists(flight / "flight.lcm"));
  }
}

}  // namespace
}  // namespace palace
