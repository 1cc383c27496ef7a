// A plan of faults in a flight: one seed and one plan are one log to the bit, it replays to the
// same decisions without the plan, and what was injected is told in it.
#include "engine/faults/fault_plan.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "engine/faults/faulted_source.h"
#include "engine/journal/flight_recorder.h"
#include "engine/runtime/engine.h"
#include "engine/runtime/scripted_operator.h"
#include "engine/simulation/session.h"
#include "gui/platform/offscreen_scene_camera.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kFlown_s = 9;
const std::vector<std::string> kPlan = {
    "gps_canyon=2:1-4", "camera_dirt=8@CAMERA_LEFT:2-6", "camera_repeated=20@CAMERA_RIGHT:3-5",
    "lost=10:4-7",      "imu_gyro_bias=1:1-3",           "laser_spikes:2-"};

using FaultPlanFlights = Scenario;

std::string Bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Flies a scripted mission under the plan into folder/name; the decisions of its passes.
std::vector<std::uint64_t> Fly(const std::filesystem::path& folder, const std::string& name) {
  const SimulatedSession session =
      OpenSimulatedSession({.seed = 3, .wind_mps = 3}, MakeOffscreenSceneCamera).value();
  const auto source = std::make_shared<FaultedSource>(session.simulator, session.simulator, 3);
  EXPECT_TRUE(source->faults().Add(ReadFaultPlan("", kPlan).value()));
  EngineParts parts;
  parts.mission.session_id = session.id;
  parts.source = source;
  parts.link = source;
  auto recorder = FlightRecorder::Open(folder, name);
  EXPECT_TRUE(recorder.ok());
  parts.sink = std::move(*recorder);
  Engine engine(std::move(parts), /*threaded=*/false);
  ScriptedOperator pilot;
  std::vector<std::uint64_t> hashes;
  while (source->now_s() < kFlown_s && engine.Step()) {
    const auto snapshot = engine.Latest();
    hashes.push_back(snapshot->decision_hash);
    for (const EngineCommand& command : pilot.Decide(*snapshot)) {
      engine.Post(command);
    }
  }
  EXPECT_EQ(engine.Latest()->session->injected_faults,
            std::vector<std::string>{"laser spikes 20 m"});
  EXPECT_TRUE(engine.Stop().ok());
  return hashes;
}

TEST_F(FaultPlanFlights, AreOneFlightToTheBitAndReplayWithoutThePlan) {
  const std::vector<std::uint64_t> flown = Fly(folder_, "a");
  EXPECT_EQ(Fly(folder_, "b"), flown);
  const std::filesystem::path log = folder_ / "a" / "flight.lcm";
  EXPECT_TRUE(Bytes(log) == Bytes(folder_ / "b" / "flight.lcm")) << "the logs differ";

  EngineParts parts;
  auto replay = OpenLog(log);
  const auto record = replay->recorded();
  parts.settings = record->settings_at_start;
  parts.record = record;
  parts.source = std::move(replay);
  Engine engine(std::move(parts), /*threaded=*/false);
  bool acting = false;
  for (std::size_t i = 0; i < flown.size(); ++i) {
    ASSERT_TRUE(engine.Step()) << i << " " << engine.error();
    ASSERT_EQ(engine.Latest()->decision_hash, flown[i]) << i;
    const auto& faults = engine.Latest()->session->injected_faults;
    acting = acting || std::find(faults.begin(), faults.end(), "GPS canyon 2 m") != faults.end();
  }
  EXPECT_TRUE(acting) << "the replay says what acted";

  std::vector<std::string> told;
  for (const Event& event : record->events) {
    if (event.kind == EventKind::kFault) {
      told.push_back(event.text);
    }
  }
  EXPECT_THAT(
      told, ElementsAre("Fault injected: GPS canyon 2 m", "Fault injected: IMU gyro bias 1°/s",
                        "Fault injected: camera dirt 8 % on camera left",
                        "Fault injected: laser spikes 20 m", "Fault ended: IMU gyro bias 1°/s",
                        "Fault injected: camera repeated 20 % on camera right",
                        "Fault ended: GPS canyon 2 m", "Fault injected: lost 10 % on every channel",
                        "Fault ended: camera repeated 20 % on camera right",
                        "Fault ended: camera dirt 8 % on camera left",
                        "Fault ended: lost 10 % on every channel"));
  const ProcessResult info = RunProcess(Palacectl({"log", "info", log.string()}), 60);
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_THAT(info.out, HasSubstr("Fault ended: GPS canyon 2 m"));
}

// Between a vehicle and its bus: the terminal and the log tell; and the log is the plan's to the
// bit.
TEST_F(FaultPlanFlights, OfASimulatedVehicleAreToldByItsOwnTerminalAndLog) {
  const auto fly = [&](const char* name, std::vector<std::string> faults) {
    std::vector<std::string> command = {
        "simulate", "--log", name, "--fast", "--no-pictures", "--duration-s", "6", "--seed", "4"};
    for (std::string& fault : faults) {
      command.insert(command.end(), {"--fault", std::move(fault)});
    }
    return RunProcess(Palacectl(command), 60);
  };
  const ProcessResult told = fly("a.lcm", {"gps_jump=3:1-2", "lost=20@IMU:3-"});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("1.0 s  Fault injected: GPS jump 3 m"));
  EXPECT_THAT(told.out, HasSubstr("2.0 s  Fault ended: GPS jump 3 m"));
  EXPECT_THAT(told.out, HasSubstr("3.0 s  Fault injected: lost 20 % on IMU"));
  (void)fly("b.lcm", {"gps_jump=3:1-2", "lost=20@IMU:3-"});
  (void)fly("c.lcm", {});
  EXPECT_TRUE(Bytes(folder_ / "a.lcm") == Bytes(folder_ / "b.lcm"));
  EXPECT_LT(Bytes(folder_ / "a.lcm").size(), Bytes(folder_ / "c.lcm").size()) << "some were lost";
  const ProcessResult info = RunProcess(Palacectl({"log", "info", "a.lcm"}), 60);
  EXPECT_THAT(info.out, HasSubstr("Fault injected: lost 20 % on IMU"));
  EXPECT_EQ(fly("d.lcm", {"gps_jump=1e9"}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "d.lcm"));
}

}  // namespace
}  // namespace palace
