// Ways to another hover flown from the program: one press, an arrival, a hold on the way, and a
// log that says so and lives it again.
#include "engine/runtime/engine.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

using Ways = Scenario;

/// What was told of them, in order.
std::vector<std::string> ToldOfWays(const std::vector<Event>& events) {
  std::vector<std::string> told;
  for (const Event& event : events) {
    for (const char* begin : {"Sent ", "Vehicle hovers where", "Held by the operator"}) {
      if (event.text.rfind(begin, 0) == 0) {
        told.push_back(event.text);
      }
    }
  }
  return told;
}

TEST_F(Ways, AreFlownHeldAndLivedAgain) {
  WriteFile("ways.script",
            "wait item climb 20\n"
            "wait seconds 1\n"
            "click climb\n"
            "wait item hold_here 3\n"
            "wait item climb 40\n"
            "wait seconds 2\n"
            "click turn_right\n"
            "wait item hold_here 3\n"
            "wait seconds 1\n"
            "click hold_here\n"
            "wait item turn_left 5\n"
            "wait seconds 1\n"
            "quit\n");
  const ProcessResult result =
      RunProcess(Palace({"--headless", "--scenario", "runway", "--seed", "1", "--record", "logs",
                         "--script", "ways.script"}),
                 300);
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const auto flights = FlightsIn(folder_ / "logs");
  ASSERT_EQ(flights.size(), 1u);
  const std::filesystem::path log = flights[0] / "flight.lcm";
  const std::vector<std::string> told = ToldOfWays(OpenLog(log)->recorded()->events);
  ASSERT_EQ(told.size(), 4u) << ::testing::PrintToString(told);
  EXPECT_EQ(told[0].rfind("Sent 5.0 m up, to look along ", 0), 0u) << told[0];
  EXPECT_EQ(told[0].find("-"), std::string::npos) << told[0];
  EXPECT_EQ(told[1], "Vehicle hovers where it was sent");
  EXPECT_EQ(told[2].rfind("Sent to look along 04", 0), 0u) << told[2];
  EXPECT_EQ(told[3], "Held by the operator on the way to another hover");
  EngineParts parts;
  auto source = OpenLog(log);
  parts.settings = source->recorded()->settings_at_start;
  parts.source = std::move(source);
  Engine engine(std::move(parts), /*threaded=*/false);
  int ways = 0;
  bool goes = false;
  while (engine.Step()) {
    const bool now = engine.Latest()->flight->mission.going.has_value();
    ways += now && !goes ? 1 : 0;
    goes = now;
  }
  EXPECT_EQ(ways, 2) << "a replay follows them as the flight did";
  EXPECT_FALSE(goes);
}

}  // namespace
}  // namespace palace
