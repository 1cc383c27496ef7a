// Trust between two programs: the stock log player against palacectl simulate, a key on both sides
// and none, and the keys' files.
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "engine/trust/key_file.h"
#include "engine/wire/convert.h"
#include "tests/scenarios/private_network.h"
#include "tests/scenarios/scenario.h"
#include "tests/support/expected.h"

namespace palace {
namespace {

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

class TrustOnTheNetwork : public Scenario {
 protected:
  void SetUp() override {
    std::string why_not;
    network_ = PrivateNetwork::Create(why_not);
    if (!network_) {
      GTEST_SKIP() << why_not;
    }
  }
  std::string Key(const std::string& name) {
    return MakeKeyFile(name, folder_ / "keys").value().file.string();
  }
  std::unique_ptr<PrivateNetwork> network_;
};

// F33: a whole approved and landed flight, played into the bus of a vehicle that waits for commands
// of the very same key: it hovers on.
TEST_F(TrustOnTheNetwork, ARecordedFlightInTheStockPlayerMovesNothing) {
  if (FindProgram("lcm-logplayer").empty()) {
    ASSERT_FALSE(InCi());
    GTEST_SKIP() << "runs with lcm-logplayer (liblcm-bin) installed";
  }
  const ProcessResult flown =
      RunProcess(Palace({"--headless", "--scenario", "runway", "--record", "rec"}), 300);
  ASSERT_EQ(flown.exit_code, 0) << flown.err;
  const auto flights = FlightsIn(folder_ / "rec");
  ASSERT_EQ(flights.size(), 1u);
  ProcessOptions player;
  player.command = {"lcm-logplayer", "--speed=8", std::string("--lcm-url=") + kUrl,
                    flights[0] / "flight.lcm"};
  Process vehicle(network_->Inside(
      Palacectl({"simulate", "--scenario", "runway", "--url", kUrl, "--key", Key("heli-1"),
                 "--no-pictures", "--log", "vehicle.lcm", "--duration-s", "120"})));
  // What is played before it listens proves nothing.
  for (int turn = 0; turn < 1000 && vehicle.Out().find("fingerprint ") == std::string::npos;
       ++turn) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const ProcessResult played = RunProcess(network_->Inside(player), 120);
  EXPECT_EQ(played.exit_code, 0) << played.err;
  vehicle.Signal(SIGINT);
  const ProcessResult ended = vehicle.Wait(20);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("fingerprint "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("did not touch down"), std::string::npos) << ended.out;
  int statuses = 0, refused = 0;
  const auto log = OpenLog(folder_ / "vehicle.lcm");
  for (auto bundle = log->Next({}); bundle; bundle = log->Next({})) {
    if ((*bundle)->status) {
      ++statuses;
      ASSERT_EQ((*bundle)->status->mode, VehicleMode::kHover);
    }
    for (const CommandAck& ack : (*bundle)->acks) {
      EXPECT_EQ(ack.result, AckResult::kRefused);
      ++refused;
    }
  }
  EXPECT_GT(statuses, 20);
  EXPECT_GT(refused, 0) << "the recorded approval was heard";
}

// Two processes, one key: the station is granted command and says so with the fingerprint, which
// the simulator prints as well; without a key it may only look.
TEST_F(TrustOnTheNetwork, AKeyOnBothSidesGivesCommandAndNoneGivesAView) {
  const std::string key = Key("heli-1");
  Process vehicle(
      network_->Inside(Palacectl({"simulate", "--scenario", "runway", "--url", kUrl, "--key", key,
                                  "--no-pictures", "--duration-s", "100"})));
  WriteFile("look.script", "wait seconds 3\nscreenshot a.png\nquit\n");
  const auto station = [&](std::vector<std::string> more, const std::string& record) {
    std::vector<std::string> words = {"--headless",  "--connect", kUrl,  "--script",
                                      "look.script", "--record",  record};
    words.insert(words.end(), more.begin(), more.end());
    ProcessOptions options = Palace(words);
    options.environment = {{"XDG_CONFIG_HOME", (folder_ / "none").string()}};
    const ProcessResult result = RunProcess(network_->Inside(options), 90);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::string events;
    for (const auto& flight : FlightsIn(folder_ / record)) {
      std::ifstream report(flight / "report.html");
      events.append(std::istreambuf_iterator<char>(report), {});
    }
    return events;
  };
  const std::string with = station({"--key", key}, "with"), without = station({}, "without");
  const std::string print = FingerprintText(LoadKeyFile(key)->key.id());
  EXPECT_NE(with.find("This station commands the vehicle, key " + print), std::string::npos);
  EXPECT_EQ(without.find("This station commands"), std::string::npos);
  EXPECT_NE(without.find("palacectl trust make NAME"), std::string::npos);
  vehicle.Signal(SIGINT);
  EXPECT_NE(vehicle.Wait(20).out.find(print), std::string::npos);
}

TEST_F(TrustOnTheNetwork, KeysAreMadeShownListedAndRemoved) {
  const auto trust = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "trust");
    words.insert(words.end(), {"--keys", (folder_ / "k").string()});
    return RunProcess(Palacectl(words), 20);
  };
  EXPECT_EQ(trust({"make", "heli-1"}).exit_code, 0);
  EXPECT_EQ(trust({"make", "heli-1"}).exit_code, 2);
  const ProcessResult shown = trust({"show", "heli-1"});
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_EQ(trust({"list"}).out, shown.out);
  std::ifstream file(folder_ / "k" / "heli-1.key");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string digits = text.substr(text.find("\nkey ") + 5, 64);
  EXPECT_EQ(shown.out.find(digits), std::string::npos) << "the key itself is never shown";
  chmod((folder_ / "k" / "heli-1.key").c_str(), 0644);
  EXPECT_NE(trust({"show", "heli-1"}).err.find("chmod 600"), std::string::npos);
  EXPECT_EQ(trust({"list"}).exit_code, 1);
  EXPECT_EQ(trust({"remove", "heli-1"}).exit_code, 0);
  EXPECT_EQ(trust({"show", "heli-1"}).exit_code, 1);
}

}  // namespace

}  // namespace palace
