// Scripts are checked before they run, act by item name, and say which line failed.
#include "gui/app/script.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

struct BadScript {
  const char* name;
  const char* text;
  const char* message;
};
class BadScripts : public testing::TestWithParam<BadScript> {};

TEST_P(BadScripts, AreRefusedNamingTheLine) {
  const auto lines = ParseScript(GetParam().text, "s.txt");
  ASSERT_FALSE(lines);
  EXPECT_EQ(lines.error().code, ErrorCode::kUsage);
  EXPECT_NE(lines.error().message.find(GetParam().message), std::string::npos)
      << lines.error().message;
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadScripts,
    testing::Values(
        BadScript{"verb", "quit\nfly away\n", "s.txt:2: unknown action 'fly'"},
        BadScript{"count", "click\n", "s.txt:1: 'click' takes"},
        BadScript{"number", "hold approve long\n", "'long' is not a number"},
        BadScript{"setting", "set slad.nothing 3\n", "unknown setting 'slad.nothing'"},
        BadScript{"what", "wait weather 3\n", "not 'weather'"},
        BadScript{"no_seconds_to_expect", "expect seconds 3\n", "not 'seconds'"},
        BadScript{"no_text_to_wait_for", "wait text go Go\n", "not 'text'"},
        BadScript{"bare_wait", "wait\n", "takes one of state, seconds, item, height"},
        BadScript{"height", "wait height low\n", "s.txt:1: wait: HEIGHT 'low' is not"},
        BadScript{"expect_height", "expect height nan\n", "'nan' is not a number"},
        BadScript{"item_limit", "wait item go soon\n", "WITHIN 'soon' is not"},
        BadScript{"negative", "wait seconds -1\n", "SECONDS = -1 must lie between 0 and 3600 s"},
        BadScript{"hold", "hold go 90\n", "SECONDS = 90 must lie between 0 and 60 s"},
        BadScript{"size", "resize 10 720\n", "WIDTH = 10 must lie between 640 and 7680 px"},
        BadScript{"speed", "speed -2\n", "SPEED = -2 must lie between 0 and 100"},
        BadScript{"surplus", "click go now\n", "nothing after it: 'now'"},
        BadScript{"no_words", "expect text go\n", "takes text NAME WORDS"},
        BadScript{"key", "key Tabb\n", "unknown key 'Tabb'"},
        BadScript{"held_key", "hold_key Entr 1\n", "unknown key 'Entr'"},
        BadScript{"picture", "screenshot ../a.png\n", "without a folder"},
        BadScript{"picture_kind", "screenshot a.bmp\n", "ends in .png"},
        BadScript{"state", "wait state PROPOSED|\nwait state NOWHERE\n",
                  "unknown state 'NOWHERE'"}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(Script, DefaultMissionParses) {
  const auto lines = ParseScript(DefaultMissionScript(), "default");
  ASSERT_TRUE(lines) << lines.error().message;
  EXPECT_GT(lines->size(), 20u);
}

/// Runs a script over a screen with one enabled and one disabled item.
class Runner {
 public:
  explicit Runner(const char* text) : script_(*ParseScript(text, "s.txt"), "s.txt") {
    items_.Add("go", {100, 100, 40, 20}, true, "Go now");
    items_.Add("off", {200, 100, 40, 20}, false, "Not yet");
    snapshot_.flight.Edit().mission.state = MissionState::kSearch;
  }
  ScriptInput Tick() {
    time_s_ += 0.1;
    return script_.Tick(items_, &snapshot_, time_s_);
  }
  void RunOut() {
    for (int i = 0; i < 2000 && !script_.done(); ++i) {
      Tick();
    }
  }
  ScriptRunner script_;
  ItemRecord items_;
  EngineSnapshot snapshot_;
  double time_s_ = 0;
};

TEST(Script, ClickMovesThenPressesThenReleasesAtTheItemsCentre) {
  Runner run("click go\n");
  ScriptInput arrive = run.Tick(), press = run.Tick(), release = run.Tick();
  EXPECT_EQ(arrive.mouse.x, 120);
  EXPECT_EQ(arrive.mouse.y, 110);
  EXPECT_FALSE(arrive.mouse_down);
  EXPECT_TRUE(press.mouse_down);
  EXPECT_FALSE(release.mouse_down);
}

TEST(Script, ANewFlightGoesOnWithTheLinesThatAreLeft) {
  Runner run("new_flight rocks 3 multirotor\nexpect item go\n");
  const ScriptInput input = run.Tick();
  ASSERT_EQ(input.intents.size(), 1u);
  const auto next = std::get<NextFlight>(std::get<UiAction>(input.intents[0]));
  ASSERT_TRUE(next.choice);
  EXPECT_EQ(next.choice->scenario, "rocks");
  EXPECT_EQ(next.choice->seed, 3u);
  EXPECT_EQ(next.choice->vehicle, "multirotor");
  ASSERT_EQ(run.script_.Left().size(), 1u);
  EXPECT_EQ(run.script_.Left()[0].number, 2) << "messages name the line of the file";
  for (const char* bad :
       {"new_flight", "new_flight atlantis", "new_flight rocks -1", "new_flight rocks 1 balloon"}) {
    EXPECT_FALSE(ParseScript(bad, "s.txt")) << bad;
  }
}

TEST(Script, HoldKeepsTheButtonDownForItsTime) {
  Runner run("hold go 1.2\n");
  int down = 0;
  for (int i = 0; i < 40; ++i) {
    down += run.Tick().mouse_down ? 1 : 0;
  }
  EXPECT_GE(down, 12);
  EXPECT_LE(down, 14);
}

TEST(Script, WaitEndsWithTheStateOrFailsAfterItsTime) {
  Runner met("wait state PROPOSED 5\n");
  met.Tick();
  met.snapshot_.flight.Edit().mission.state = MissionState::kProposed;
  met.RunOut();
  EXPECT_EQ(met.script_.error(), "");
  Runner late("wait state PROPOSED 5\n");
  late.RunOut();
  EXPECT_EQ(late.script_.error(),
            "s.txt:1: 'wait state PROPOSED 5' failed: the state is SEARCH after 5 s");
}

TEST(Script, DisabledAndMissingItemsFail) {
  Runner disabled("click off\n");
  disabled.RunOut();
  EXPECT_NE(disabled.script_.error().find("it is disabled: Not yet"), std::string::npos);
  Runner missing("click nowhere\n");
  missing.RunOut();
  EXPECT_NE(missing.script_.error().find("nothing of that name"), std::string::npos);
}

TEST(Script, WhatAClickOpensMayBeDrawnAFrameLater) {
  Runner run("click go\nclick late\nexpect item later\nquit\n");
  for (int frame = 0; frame < 40 && !run.script_.done(); ++frame) {
    run.Tick();
    if (frame == 4) {  // a frame after the press of the first is over
      run.items_.Add("late", {100, 140, 40, 20}, true, "Late");
    }
    if (frame == 9) {
      run.items_.Add("later", {100, 180, 40, 20}, true, "Later");
    }
  }
  EXPECT_TRUE(run.script_.done());
  EXPECT_EQ(run.script_.error(), "");
}

TEST(Script, EveryKeyOfTheTableMayBePressed) {
  for (const char* keys : {"Tab", "Shift+Tab", "F12", "Ctrl+Z", "Ctrl+Shift+Z", "Ctrl++", "[", "B",
                           "Shift+Escape", "Space"}) {
    EXPECT_TRUE(ParseScript(std::string("key ") + keys, "s.txt").ok()) << keys;
  }
}

TEST(Script, ExpectHeightHoldsTheHeightAboveTheSite) {
  Runner low("expect height 4\n");
  low.snapshot_.flight.Edit().mission.height_above_site_m = 3.5;
  low.RunOut();
  EXPECT_EQ(low.script_.error(), "");
  Runner high("expect height 4\n");
  high.snapshot_.flight.Edit().mission.height_above_site_m = 12;
  high.RunOut();
  EXPECT_EQ(high.script_.error(),
            "s.txt:1: 'expect height 4' failed: the height above the site is 12.0 m");
  Runner unknown("expect height 4\n");
  unknown.snapshot_.flight.Edit().mission.height_above_site_m = NAN;
  unknown.RunOut();
  EXPECT_NE(unknown.script_.error().find("not known"), std::string::npos);
}

TEST(Script, ExpectItemHoldsThatItMayBeUsed) {
  Runner on("expect item go\n");
  on.RunOut();
  EXPECT_EQ(on.script_.error(), "");
  Runner off("expect item off\n");
  off.RunOut();
  EXPECT_NE(off.script_.error().find("it is disabled"), std::string::npos);
}

TEST(Script, ExpectReadsTheTextOfAnItem) {
  Runner right("expect text go Go now\n");
  right.RunOut();
  EXPECT_EQ(right.script_.error(), "");
  Runner wrong("expect text go Stop\n");
  wrong.RunOut();
  EXPECT_NE(wrong.script_.error().find("it reads 'Go now'"), std::string::npos);
}

}  // namespace
}  // namespace palace
