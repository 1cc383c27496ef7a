// Alarms put aside: what the strip then says, and what brings them back.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gui/panels/fly_panels.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

/// A station with one caution, which is shelved.
struct Shelved : FlyWindow {
  Shelved() : FlyWindow(1920, 1080, fake::Snapshot(MissionState::kArmed)) {
    snap.flight.Edit().mission.alarms.resize(1);
    ui.Frame(draw);
    ui.Click("shelve", draw);
  }
  Alarm& alarm() { return snap.flight.Edit().mission.alarms[0]; }
  std::string Strip() {
    ui.Frame(draw);
    ui.Frame(draw);
    return ui.items.Find("alarm")->text;
  }
};

TEST(AlarmShelf, SaysWhatItHoldsAndAClickBringsItBack) {
  Shelved window;
  EXPECT_EQ(window.Strip(), "No alarm but what is shelved");
  EXPECT_EQ(window.ui.items.Find("unshelve")->text, "1 shelved");
  window.ui.Click("unshelve", window.draw);
  EXPECT_EQ(window.Strip(), window.alarm().text);
  EXPECT_EQ(window.ui.items.Find("unshelve"), nullptr);
}

TEST(AlarmShelf, ItsWordsStandBesideTheOthers) {
  FlyWindow window(1280, 720, fake::Snapshot(MissionState::kArmed));
  window.ui.Click("shelve", window.draw);
  window.ui.Frame(window.draw);
  ASSERT_NE(window.ui.items.Find("unshelve"), nullptr);
  const Rect strip = window.ui.items.Find("panel/Alarm strip")->rect;
  std::vector<Item> texts;
  for (const Item& item : window.ui.items.items()) {
    if (item.name == "text" && strip.Contains(item.rect.centre())) {
      EXPECT_TRUE(Inside(item.rect, strip, 1.5f)) << item.text;
      for (const Item& other : texts) {
        EXPECT_FALSE(Touch(item.rect, other.rect)) << item.text << " touches " << other.text;
      }
      texts.push_back(item);
    }
  }
  EXPECT_GE(texts.size(), 4U);
}

TEST(AlarmShelf, TheKeyboardBringsItBackToo) {
  Shelved window;
  for (int i = 0; i < 60 && window.ui.focus.shown() != "unshelve"; ++i) {
    window.ui.Tap(ImGuiKey_Tab, window.draw);
  }
  ASSERT_EQ(window.ui.focus.shown(), "unshelve");
  window.ui.Tap(ImGuiKey_Enter, window.draw);
  EXPECT_EQ(window.Strip(), window.alarm().text);
}

TEST(AlarmShelf, HoldsTheAlarmThatStoodAndNoOther) {
  {
    Shelved raised_anew;
    raised_anew.alarm().since = AddSeconds(raised_anew.alarm().since, 5);
    EXPECT_EQ(raised_anew.Strip(), raised_anew.alarm().text);
  }
  {
    Shelved worse;
    worse.alarm().level = AlarmLevel::kWarning;
    EXPECT_EQ(worse.Strip(), worse.alarm().text);
  }
  {
    Shelved cleared;
    const Alarm alarm = cleared.alarm();
    cleared.alarm().active = false;  // over, and not acknowledged
    EXPECT_EQ(cleared.Strip(), alarm.text);
    cleared.snap.flight.Edit().mission.alarms.clear();
    EXPECT_EQ(cleared.Strip(), "No alarms");
    cleared.snap.flight.Edit().mission.alarms_in_record = 2;  // not judged again
    EXPECT_EQ(cleared.Strip(), "In the flight: 2 alarms, told in its events");
    cleared.snap.flight.Edit().mission.alarms = {alarm};
    EXPECT_EQ(cleared.Strip(), alarm.text);
  }
}

}  // namespace
}  // namespace palace
