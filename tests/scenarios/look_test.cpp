// A look flown from the program: one press, a hover nearer to the site, no landing, and a log that
// says so and decides the same again.
#include "engine/runtime/engine.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

using Look = Scenario;

/// The states that a replay of the log goes through, in order, without repetition.
std::vector<MissionState> ReplayedStates(const std::filesystem::path& log) {
  EngineParts parts;
  auto source = OpenLog(log);
  parts.settings = source->recorded()->settings_at_start;
  parts.source = std::move(source);
  Engine engine(std::move(parts), /*threaded=*/false);
  std::vector<MissionState> states;
  while (engine.Step()) {
    const MissionState state = engine.Latest()->flight->mission.state;
    if (states.empty() || states.back() != state) {
      states.push_back(state);
    }
  }
  return states;
}

TEST_F(Look, OnePressHoversNearerAndProposesAnew) {
  WriteFile("look.script",
            "wait state PROPOSED 30\n"
            "wait seconds 1\n"
            "hover site/best\n"
            "wait seconds 0.3\n"
            "click site/best\n"
            "wait state ARMED 5\n"
            "wait item look 5\n"
            "wait item approve 20\n"
            "click look\n"
            "wait state DESCENDING 60\n"
            "wait state SEARCH 60\n"
            "wait state PROPOSED 20\n"
            "quit\n");
  const ProcessResult result =
      RunProcess(Palace({"--headless", "--scenario", "shadows", "--seed", "1", "--record", "logs",
                         "--script", "look.script"}),
                 300);
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const auto flights = FlightsIn(folder_ / "logs");
  ASSERT_EQ(flights.size(), 1u);
  const auto record = OpenLog(flights[0] / "flight.lcm")->recorded();
  using S = MissionState;
  const std::vector<S> flown = {S::kNoLive,   S::kSearch,     S::kProposed, S::kArmed,
                                S::kApproved, S::kDescending, S::kSearch,   S::kProposed};
  std::vector<S> states = StatesOf(*record);
  if (states.front() != S::kNoLive) {
    states.insert(states.begin(), S::kNoLive);
  }
  EXPECT_EQ(states, flown);
  bool told = false;
  for (const Event& event : record->events) {
    told = told || event.text.find(" was looked at from ") != std::string::npos;
  }
  EXPECT_TRUE(told);
  std::vector<S> again = ReplayedStates(flights[0] / "flight.lcm");
  if (again.front() != S::kNoLive) {
    again.insert(again.begin(), S::kNoLive);
  }
  EXPECT_EQ(again, flown);
}

}  // namespace
}  // namespace palace
