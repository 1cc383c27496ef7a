// The Simulate workspace by a script, without a window: time, views and changes; and what was flown
// so replays.
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

class Simulate : public Scenario {};

TEST_F(Simulate, AScriptRunsStepsChangesAndLooks) {
  const auto script = WriteFile("look.txt", R"(
wait state PROPOSED 60
click tab/Simulate
wait seconds 0.2
expect text sim/state Runs
run_to 4
wait time 4
expect text sim/time 4.0 s
expect text sim/state Paused
click sim/step
wait seconds 0.2
expect text sim/time 4.1 s
set simulation.wind_mps 6
set simulation.field_of_view_deg 60
wait seconds 0.2
expect text in_force/simulation.field_of_view_deg 45
key .
wait seconds 0.2
expect text in_force/simulation.field_of_view_deg 60
expect text in_force/simulation.wind_mps 6.0 m/s
key 3
wait seconds 0.2
expect item swap/birds_eye
screenshot chase.png
click world_view/above
wait seconds 0.2
expect item swap/chase
run_to 6
wait time 6
expect item paused
click tab/Fly
click tab/Simulate
wait seconds 0.2
click sim/play
click tab/Fly
wait state PROPOSED 60
click site/best
wait state ARMED 10
click tab/Simulate
wait seconds 0.2
set simulation.tilt_deg -60
wait seconds 0.2
expect text toast deselect it
set simulation.wind_mps 2
wait seconds 0.3
expect text in_force/simulation.wind_mps 2.0 m/s
expect state ARMED
fault gps_jump=3
wait seconds 0.3
expect text fault/1 GPS jump 3 m, until ended
end_fault 1
wait seconds 0.3
)");
  const ProcessResult run = RunProcess(Palace({"--headless", "--script", script, "--seed", "3"}), 120);
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(Simulate, AScriptGoesOnInTheFlightThatItBegins) {
  const auto script = WriteFile("next.txt", R"(
wait time 2
click tab/Simulate
new_flight empty 5 multirotor
wait time 1
expect item sim/play
click tab/Fly
wait seconds 0.3
expect text readout/Energy %
click tab/Simulate
wait seconds 0.2
click scenario/slope
wait seconds 0.2
click fly_world
wait time 1
expect item sim/play
expect item nothing_of_that_name
)");
  const ProcessResult run = RunProcess(Palace({"--headless", "--script", script}), 120);
  EXPECT_EQ(run.exit_code, 1) << "the last line fails";
  EXPECT_NE(run.err.find("next.txt:17: 'expect item nothing_of_that_name'"), std::string::npos)
      << run.err;
  EXPECT_EQ(FlightsIn(folder_ / "logs").size(), 3u);
}

TEST_F(Simulate, AnUnknownFaultIsRefusedBeforeAnythingRuns) {
  const auto script = WriteFile("bad.txt", "fault gps_jumps=3\n");
  EXPECT_EQ(RunProcess(Palace({"--headless", "--script", script}), 60).exit_code, 2);
}

TEST_F(Simulate, AValueOutOfRangeIsRefusedBeforeAnythingRuns) {
  const auto script = WriteFile("bad.txt", "set simulation.baseline_m 9\n");
  const ProcessResult run = RunProcess(Palace({"--headless", "--script", script}), 60);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("must lie between 0.1 and 3 m"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace palace
