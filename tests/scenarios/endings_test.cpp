// However the station ends, the log is whole, the report is there, and the exit code says how.
#include <signal.h>
#include <sys/resource.h>

#include "engine/journal/log_index.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

class Endings : public Scenario {
 protected:
  std::filesystem::path Flight() const {
    const auto flights = FlightsIn(folder_ / "rec");
    return flights.empty() ? std::filesystem::path() : flights[0];
  }
  /// Seconds of flight in the log as far as it is written.
  double Recorded() const {
    const auto file = LogFile::Open(Flight() / "flight.lcm");
    const auto index = file ? BuildIndex(*file) : Result<LogIndex>(file.error());
    return index ? SecondsBetween(index->entries.front().time, index->entries.back().time) : 0;
  }
  template <typename Condition>
  static bool Until(double seconds, Condition&& condition) {
    for (int i = 0; i < seconds * 20 && !condition(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return condition();
  }
  ProcessResult Verify() const {
    return RunProcess(Palacectl({"log", "verify", (Flight() / "flight.lcm").string()}), 60);
  }
};

TEST_F(Endings, ASignalEndsTheStationInOrder) {
  WriteFile("hover.script", "wait seconds 500\nquit\n");
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    SCOPED_TRACE(strsignal(number));
    std::filesystem::remove_all(folder_ / "rec");
    Process station(Palace({"--headless", "--record", "rec", "--script", "hover.script"}));
    ASSERT_TRUE(Until(60, [&] { return Recorded() > 2; })) << station.Err();
    station.Signal(number);
    const ProcessResult ended = station.Wait(30);
    EXPECT_EQ(ended.signal, 0);
    EXPECT_EQ(ended.exit_code, 128 + number) << ended.err;
    EXPECT_TRUE(std::filesystem::exists(Flight() / "report.html"));
    const ProcessResult verified = Verify();
    EXPECT_EQ(verified.exit_code, 0) << verified.out;
    EXPECT_NE(verified.out.find("whole"), std::string::npos);
  }
}

TEST_F(Endings, AKillTearsNoMoreThanThePassInHand) {
  WriteFile("hover.script", "wait seconds 500\nquit\n");
  for (int kill = 0; kill < 3; ++kill) {
    std::filesystem::remove_all(folder_ / "rec");
    Process station(Palace({"--headless", "--record", "rec", "--script", "hover.script"}));
    ASSERT_TRUE(Until(60, [&] { return Recorded() > 1 + kill; })) << station.Err();
    station.Signal(SIGKILL);
    EXPECT_EQ(station.Wait(10).signal, SIGKILL);
    const auto index = VerifyLog(*LogFile::Open(Flight() / "flight.lcm"));
    ASSERT_TRUE(index.ok());
    EXPECT_EQ(index->report.checksum_errors, 0u);
    EXPECT_LE(index->report.skipped_bytes, 700'000u) << "more than a pass with its pictures";
    EXPECT_TRUE(std::filesystem::directory_iterator(Flight()) !=
                std::filesystem::directory_iterator());
    EXPECT_FALSE(std::filesystem::exists(Flight() / "reserve.tmp"));
  }
}

TEST_F(Endings, CtrlQInTheAirAsksAndTheWaveOffWorksMeanwhile) {
  WriteFile("leave.script",
            "wait state PROPOSED 30\n"
            "key Ctrl+Q\n"
            "wait seconds 0.5\n"
            "expect text leave hovers where it is\n"
            "key Escape\n"
            "wait seconds 0.5\n"
            "click site/best\n"
            "wait item approve 20\n"
            "hold approve 1.2\n"
            "wait state DESCENDING 60\n"
            "key Ctrl+Q\n"
            "wait seconds 0.5\n"
            "expect text leave climbs away by itself after\n"
            "key Shift+Escape\n"
            "wait state ABORTING 5\n"
            "expect item leave/stay\n"
            "expect text leave goes on by itself and then hovers\n"
            "click leave/leave\n"
            "wait seconds 60\n");
  const ProcessResult flown =
      RunProcess(Palace({"--headless", "--record", "rec", "--script", "leave.script"}), 200);
  EXPECT_EQ(flown.exit_code, 0) << flown.err;
  EXPECT_NE(flown.out.find("Final state: ABORTING"), std::string::npos) << flown.out;
  // The report holds the approval with its pictures, and no heading over nothing.
  std::ifstream file(Flight() / "report.html");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const char* words : {"Approval 1", "approval-1.png", "approval-1-map.png", "accepted after",
                            "Evidence", "by a script"}) {
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
  EXPECT_EQ(page.find("Screenshots"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(Flight() / "approval-1.png"));
  EXPECT_TRUE(std::filesystem::exists(Flight() / "approval-1-map.png"));
}

TEST_F(Endings, TooLittleMemoryIsSaidInOneSentence) {
  for (const std::size_t mebibytes : {400u, 700u}) {
    SCOPED_TRACE(mebibytes);
    ProcessOptions station = Palace({"--headless", "--no-record"});
    station.prepare = [mebibytes] {
      const rlimit limit{mebibytes << 20, mebibytes << 20};
      return setrlimit(RLIMIT_AS, &limit) == 0;
    };
    const ProcessResult ended = RunProcess(station, 30);
    EXPECT_EQ(ended.exit_code, 1) << ended.signal;
    EXPECT_EQ(ended.err.find("palace: out of memory"), 0u) << ended.err;
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  }
}

/// Wires that throw shadows on each other take minutes to draw. Nothing was flown: nothing stays.
TEST_F(Endings, AWorldThatTakesMinutesIsGivenUpInTwoSeconds) {
  std::string world = "name = \"wires\"\n[ground]\nmaterial = \"grass\"\n";
  for (int i = 0; i < 2000; ++i) {
    world += "[[rod]]\nfrom = [" + std::to_string(i % 83 - 41) + ", -40, 2]\nto = [" +
             std::to_string(i % 79 - 39) + ", 40, 3]\ndiameter_m = 0.1\n";
  }
  WriteFile("wires.toml", world);
  for (const char* what : {"--log", "--export"}) {
    Process vehicle(Palacectl({"simulate", "--scenario", "wires.toml", what, "out"}));
    ASSERT_TRUE(Until(60, [&] { return std::filesystem::exists(folder_ / "out"); }))
        << vehicle.Err();
    vehicle.Signal(SIGTERM);
    EXPECT_TRUE(Until(2.5, [&] { return !vehicle.Running(); })) << what;
    const ProcessResult ended = vehicle.Wait(1);
    EXPECT_EQ(ended.exit_code, 128 + SIGTERM) << ended.err;
    EXPECT_NE(ended.err.find("nothing was written"), std::string::npos) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "mav0"));
    EXPECT_FALSE(std::filesystem::is_regular_file(folder_ / "out"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.idx"));
  }
}

/// Its rows are there, whenever it was killed: each is of a picture that is whole.
TEST_F(Endings, AKilledExportListsItsPairs) {
  Process vehicle(Palacectl({"simulate", "--export", "out", "--duration-s", "600"}));
  const std::filesystem::path camera = folder_ / "out" / "mav0" / "cam0";
  ASSERT_TRUE(Until(60, [&] {
    return std::filesystem::exists(camera / "data") &&
           std::distance(std::filesystem::directory_iterator(camera / "data"), {}) > 4;
  })) << vehicle.Err();
  vehicle.Signal(SIGKILL);
  vehicle.Wait(10);
  for (const char* side : {"cam0", "cam1"}) {
    std::ifstream table(camera.parent_path() / side / "data.csv");
    std::string line;
    int rows = -1;  // the heading is none
    for (; std::getline(table, line); ++rows) {
      const std::string name = line.substr(line.find(',') + 1);
      EXPECT_TRUE(rows < 0 || std::filesystem::exists(camera.parent_path() / side / "data" / name))
          << line;
    }
    EXPECT_GE(rows, 3) << side;
  }
}

TEST_F(Endings, TheVehicleAndExperimentsEndInOrderToo) {
  Process vehicle(Palacectl({"simulate", "--log", "vehicle.lcm", "--realtime"}));
  ASSERT_TRUE(Until(30, [&] {
    std::error_code none;
    return std::filesystem::file_size(folder_ / "vehicle.lcm", none) > 2'000'000 && !none;
  })) << vehicle.Err();
  vehicle.Signal(SIGTERM);
  EXPECT_EQ(vehicle.Wait(10).exit_code, 0) << vehicle.Err();
  EXPECT_EQ(RunProcess(Palacectl({"log", "verify", "vehicle.lcm"}), 30).exit_code, 0);

  Process experiment(Palacectl({"evaluate", "probability", "--trials", "100000", "--out", "out"}));
  ASSERT_TRUE(Until(60, [&] { return experiment.Err().find("trial 2 ") != std::string::npos; }));
  experiment.Signal(SIGTERM);
  const ProcessResult ended = experiment.Wait(60);
  EXPECT_EQ(ended.exit_code, 128 + SIGTERM) << ended.err;
  EXPECT_NE(ended.err.find("the trial in hand is given up"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("ended after trial"), std::string::npos) << ended.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "probability.csv"));

  // Trials of this one take minutes.
  Process ground(Palacectl({"evaluate", "ground", "--trials", "3", "--out", "ground"}));
  ASSERT_TRUE(Until(60, [&] { return std::filesystem::exists(folder_ / "ground"); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  ground.Signal(SIGTERM);
  EXPECT_TRUE(Until(2, [&] { return !ground.Running(); }));
  const ProcessResult none = ground.Wait(1);
  EXPECT_EQ(none.exit_code, 128 + SIGTERM) << none.err;
  EXPECT_NE(none.err.find("--resume goes on from here"), std::string::npos) << none.err;
  EXPECT_NE(none.err.find("before its first trial was done"), std::string::npos) << none.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "ground" / "ground.csv"));

  Process shard(Palacectl(
      {"evaluate", "probability", "--trials", "100000", "--shard", "1/2", "--out", "shard"}));
  ASSERT_TRUE(Until(60, [&] { return shard.Err().find("trial 3 ") != std::string::npos; }));
  shard.Signal(SIGTERM);
  const ProcessResult given_up = shard.Wait(60);
  EXPECT_EQ(given_up.exit_code, 128 + SIGTERM) << given_up.err;
  EXPECT_NE(given_up.err.find("a part of a shard cannot be merged"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "shard" / "probability.csv"));
}

/// Killed without a word, gone on with, and to the byte what one run writes.
TEST_F(Endings, AKilledExperimentGoesOnWhereItEnded) {
  std::vector<std::string> words = {"evaluate", "probability", "--trials",
                                    "100000",   "--out",       "killed"};
  {
    Process experiment(Palacectl(words));
    ASSERT_TRUE(Until(60, [&] { return experiment.Err().find("trial 3 ") != std::string::npos; }));
    experiment.Signal(SIGKILL);
    (void)experiment.Wait(60);
  }
  const std::filesystem::path record = folder_ / "killed" / "probability.trials";
  ASSERT_TRUE(std::filesystem::exists(record));
  const auto text = [&](const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  const std::string kept = text(record);
  const auto done = std::count(kept.begin(), kept.end(), '#') - 1;  // beside the first line
  ASSERT_GE(done, 2);
  std::ofstream(record, std::ios::app) << "a row that was cut o";
  words[3] = std::to_string(done + 3);
  words.emplace_back("--resume");
  const ProcessResult resumed = RunProcess(Palacectl(words), 120);
  EXPECT_NE(resumed.err.find("trials were done before"), std::string::npos) << resumed.err;
  EXPECT_FALSE(std::filesystem::exists(record));
  words[5] = "whole";
  words.pop_back();
  const ProcessResult whole = RunProcess(Palacectl(words), 120);
  EXPECT_EQ(resumed.exit_code, whole.exit_code) << resumed.err << whole.err;
  for (const char* name : {"probability.csv", "report.html"}) {
    const std::string whole_text = text(folder_ / "whole" / name);
    EXPECT_GT(whole_text.size(), 100u) << name;
    EXPECT_TRUE(text(folder_ / "killed" / name) == whole_text) << name;
  }
}

/// One byte of the last message differs; the sidecar fits, so nothing else tells.
TEST_F(Endings, WhatIsMadeOfADamagedLogExitsWithThree) {
  const std::filesystem::path log = folder_ / "vehicle.lcm";
  ASSERT_EQ(RunProcess(Palacectl({"simulate", "--log", log.string(), "--fast", "--no-pictures",
                                  "--duration-s", "2"}),
                       60)
                .exit_code,
            0);
  std::fstream file(log, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(-2, std::ios::end);
  file.put('\x5A');
  file.close();
  for (const char* verb : {"export", "repair", "cut"}) {
    SCOPED_TRACE(verb);
    const ProcessResult made =
        RunProcess(Palacectl({"log", verb, log.string(), "--out", std::string(verb) + ".out"}), 60);
    EXPECT_EQ(made.exit_code, 3) << made.out << made.err;
    EXPECT_NE(made.out.find("1 events are damaged"), std::string::npos) << made.out;
  }
}

}  // namespace
}  // namespace palace
