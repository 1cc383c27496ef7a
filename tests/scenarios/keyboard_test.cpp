// Tune, Review and Fly without a mouse, from the start to an approved landing.
#include <set>
#include <sstream>

#include "gui/app/script.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr const char* kFlight = R"(wait state PROPOSED 60
# Tune: tighten a limit fine and coarse, look, take it back as one step.
key F3
wait seconds 0.3
key Tab
expect text focus limits/search
key Tab
key Tab
down_to limit/slad.max_slope_deg
key Left
key Shift+Left
wait seconds 0.3
expect text limit/slad.max_slope_deg 8.9
tab_to undo
key Enter
wait seconds 0.3
expect text limit/slad.max_slope_deg 10.0
# Review: the timeline, the view, a bookmark.
key F4
wait seconds 0.3
tab_to bookmark
key Space
tab_to timeline
key Up
tab_to view/Above
key Enter
tab_to view_3d
key Left
# Diagnose, and back by the tabs.
key F5
wait seconds 0.3
tab_to events
key Down
tab_to tab/Fly
key Enter
# Fly: look at a cell, arm the first site, approve, land.
wait state PROPOSED 30
wait seconds 1.5
tab_to map/slope
key Up
wait seconds 0.2
expect text why Slope
key Escape
key Escape
key Tab
expect text focus site/
key Enter
wait state ARMED 5
wait seconds 0.2
expect text focus approve
wait item approve 20
hold_key Enter 0.5
wait seconds 0.3
expect state ARMED
hold_key Enter 1.3
wait state APPROVED|DESCENDING 5
wait state DESCENDING 60
tab_to hold_here
wait state LANDED 90
expect state LANDED
quit
)";

using Keyboard = Scenario;

TEST_F(Keyboard, FliesTheWholeMissionToAnApprovedLanding) {
  const auto script = ParseScript(kFlight, "flight");
  ASSERT_TRUE(script) << script.error().message;
  const std::set<std::string> keys_only = {"wait",   "expect",  "key", "hold_key",
                                           "tab_to", "down_to", "quit"};
  for (const ScriptLine& line : *script) {
    EXPECT_EQ(keys_only.count(line.verb), 1U) << line.text;
  }
  WriteFile("flight.script", kFlight);
  const ProcessResult result =
      RunProcess(Palace({"--headless", "--record", "rec", "--script", "flight.script"}), 500);
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  const auto flights = FlightsIn(folder_ / "rec");
  ASSERT_EQ(flights.size(), 1U);
  const auto source = OpenLog(flights[0] / "flight.lcm");
  ASSERT_NE(source, nullptr);
  EXPECT_EQ(StatesOf(*source->recorded()).back(), MissionState::kLanded);
  bool bookmarked = false;
  for (const Event& event : source->recorded()->events) {
    bookmarked = bookmarked || event.kind == EventKind::kBookmark;
  }
  EXPECT_TRUE(bookmarked);
}

}  // namespace
}  // namespace palace
