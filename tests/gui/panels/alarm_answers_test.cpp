// An alarm that waits for an answer can be answered, and is read in full.
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

/// An advisory stands, and behind it a warning that is over waits for its acknowledgement.
EngineSnapshot WarningBehindAnAdvisory() {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  auto& alarms = snap.flight.Edit().mission.alarms;
  alarms = {{AlarmId::kExposure, AlarmLevel::kAdvisory, "Site B lies half in shadow."},
            {AlarmId::kImageTime, AlarmLevel::kWarning,
             "Pictures 62 ms late, limit 35 ms. Check the trigger."}};
  alarms[1].active = false;
  return snap;
}

TEST(AlarmStrip, TheWarningThatBlocksApproveCanBeAnsweredWhereverItStands) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    FlyWindow window(size.x, size.y, WarningBehindAnAdvisory());
    ASSERT_NE(window.ui.items.Find("acknowledge"), nullptr);
    EXPECT_EQ(window.ui.items.Find("acknowledge")->text, "Acknowledge: Pictures 62 ms late");
    window.ui.Click("acknowledge", window.draw);
    ASSERT_EQ(window.ui.CountCommands<AcknowledgeAlarm>(), 1);
    EXPECT_EQ(window.ui.LastCommand<AcknowledgeAlarm>().alarm, AlarmName(AlarmId::kImageTime));
    ExpectTextsInPanels(window.ui.items);
  }
}

TEST(AlarmStrip, TheCountOfTheOthersOpensTheListToo) {
  FlyWindow window(1280, 720, WarningBehindAnAdvisory());
  EXPECT_FALSE(window.bar.history_open);
  window.ui.Click("alarm_count", window.draw);
  EXPECT_TRUE(window.bar.history_open);
}

TEST(AlarmList, TellsEachAlarmInFullAndAnswersItThere) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    EngineSnapshot snap = WarningBehindAnAdvisory();
    auto& alarms = snap.flight.Edit().mission.alarms;
    alarms[0].text =
        "The vehicle's laser reads 3.2 m less than stereo, limit 1.0 m, for 12 s: one of the two "
        "is wrong, or the ground below is not the ground in the picture. Look at both pictures "
        "and at the range, and wave off when they do not agree.";
    FlyWindow window(size.x, size.y, snap);
    window.ui.Click("alarm", window.draw);
    window.ui.Frame(window.draw);
    std::string all;
    for (const Item& item : window.ui.items.items()) {
      all += item.name == "text" ? item.text + " " : "";
    }
    EXPECT_NE(all.find("wave off when they do not agree."), std::string::npos);
    EXPECT_NE(all.find("Over now: Pictures 62 ms late"), std::string::npos);
    const std::string answer = std::string("acknowledge/") + AlarmName(AlarmId::kImageTime);
    ASSERT_NE(window.ui.items.Find(answer), nullptr);
    window.ui.Click(answer, window.draw);
    EXPECT_EQ(window.ui.CountCommands<AcknowledgeAlarm>(), 1);
    EXPECT_NE(window.ui.items.Find("alarm_history"), nullptr) << "it stays open";
  }
}

}  // namespace
}  // namespace palace
