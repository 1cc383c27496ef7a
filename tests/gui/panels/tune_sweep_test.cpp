// The sweep of Tune: what it tells of the limit that was moved last, and its press on the plot.
#include <string>
#include <vector>

#include "gui/panels/tune/tune.h"
#include "tests/gui/panels/panel_checks.h"
#include "tests/gui/panels/previewing.h"
#include "tests/support/fake_sweep.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

Rect Body() { return BodyOf(1920, 1080); }

TEST(TuneSweep, TellsWhereTheBestPlaceChangesForTheLimitMovedLast) {
  UiHarness ui(1920, 1080);
  const EngineSnapshot snap = Previewing(MissionState::kProposed);  // 6 cm
  TuneState state;
  const auto draw = [&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); };
  ui.Frame(draw);
  EXPECT_EQ(state.swept.limit, "slad.max_slope_deg");
  EXPECT_TRUE(HasText(ui.items, "Being worked out"));
  MoveTwoLimits(state.history);
  state.sweep = fake::RoughnessSweep(snap);
  ui.Frame(draw);
  EXPECT_EQ(state.swept.limit, "slad.max_deviation_m");
  EXPECT_TRUE(HasText(ui.items, "Below 5.0 cm the best is a new place, not B."));
  EXPECT_TRUE(HasText(ui.items, "Map 1.5 s old"));
  EXPECT_TRUE(HasText(ui.items, "preview 6.0 cm"));
  EXPECT_TRUE(HasText(ui.items, "applied 10.0 cm"));
  std::vector<std::string> best;
  for (const Item& item : ui.items.items()) {
    if (item.name.starts_with("sweep/best/")) {
      best.push_back(item.text);
    }
  }
  EXPECT_EQ(best, (std::vector<std::string>{"no site", "new", "B", "A"}));
}

TEST(TuneSweep, SaysThatAnotherAnswerIsOnItsWay) {
  UiHarness ui(1920, 1080);
  const EngineSnapshot snap = Previewing(MissionState::kProposed);
  TuneState state;
  state.swept.limit = "slad.max_deviation_m";
  auto older = std::make_shared<LimitSweep>(*fake::RoughnessSweep(snap));
  older->others.slad.limits.max_slope_deg = 11;
  state.sweep = older;
  ui.Frame([&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); });
  EXPECT_TRUE(HasText(ui.items, "Being worked out anew"));
  older->others.slad.limits.max_slope_deg = 6;
  older->others.slad.limits.max_deviation_m = 0.3;  // its own value means nothing
  ui.Frame([&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); });
  EXPECT_TRUE(HasText(ui.items, "Map 1.5 s old"));
}

TEST(TuneSweep, APressOnThePlotMovesTheLimitAndChevronsChooseAnother) {
  UiHarness ui(1920, 1080);
  const EngineSnapshot snap = Previewing(MissionState::kProposed);
  TuneState state;
  state.swept.limit = "slad.max_deviation_m";
  state.sweep = fake::RoughnessSweep(snap);
  const auto draw = [&](UiFrame& f) { DrawTuneWorkspace(snap, Body(), state, f); };
  ui.Frame(draw);
  const Rect plot = ui.items.Find("sweep/plot")->rect;
  ui.MoveTo(ImVec2(plot.x + plot.w * 7 / 11, plot.centre().y));  // 1 to 12 cm
  ui.Frame(draw);
  ui.Button(true);
  ui.Frame(draw);
  EXPECT_TRUE(HasText(ui.items, "At 8.0 cm: 80 m², best B, 3.4 m clear."));
  ui.Button(false);
  ui.Frame(draw);
  const auto set = ui.LastCommand<SetSetting>();
  EXPECT_EQ(set.name, "slad.max_deviation_m");
  EXPECT_NEAR(set.value, 0.08, 0.001);
  ui.Click("sweep/next", draw);
  EXPECT_EQ(state.swept.limit, "slad.max_step_m");
  ui.Click("sweep/previous", draw);
  ui.Click("sweep/previous", draw);
  EXPECT_EQ(state.swept.limit, "slad.max_slope_deg");
  ui.Click("sweep/previous", draw);
  EXPECT_TRUE(MaySweep(*FindSetting(state.swept.limit))) << state.swept.limit;
}

}  // namespace
}  // namespace palace
