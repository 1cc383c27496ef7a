// An alarm that waits for an answer can be answered, and is read in full.
#include "gui/panels/alarm_look.h"
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

TEST(AlarmStrip, ASentenceIsNotCutWhileThereIsRoomBesideIt) {
  const struct {
    const char* text;
    bool whole;
  } table[] = {
      {"Laser silent 2.0 s. The height above ground is that of the map, and the descent is checked "
       "against it.",
       true},
      {"GPS lost. The vehicle goes on by what vision tells of the ground below it for as long as "
       "the pictures are sharp, the tracker holds, and the map below it is not older than what the "
       "descent allows, and it holds where one of these ends",
       false}};
  for (const auto& row : table) {
    SCOPED_TRACE(row.text);
    EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
    snap.flight.Edit().mission.alarms = {{AlarmId::kLaserLost, AlarmLevel::kAdvisory, row.text}};
    FlyWindow window(1280, 720, snap);
    const Rect& strip = window.ui.items.Find("panel/Alarm strip")->rect;
    const Item* sentence = nullptr;
    for (const Item& item : window.ui.items.items()) {
      const bool starts = item.name == "text" && item.text.size() > 4 &&
                          std::string(row.text).rfind(item.text.substr(0, 5), 0) == 0;
      sentence = starts && strip.Contains(item.rect.centre()) ? &item : sentence;
    }
    ASSERT_NE(sentence, nullptr);
    EXPECT_EQ(sentence->text == row.text, row.whole) << sentence->text;
    EXPECT_GT(sentence->rect.right(), strip.x + (row.whole ? 0.3F : 0.7F) * strip.w);
    ExpectTextsInPanels(window.ui.items);
  }
}

TEST(AlarmStrip, TheCountOfTheOthersOpensTheListToo) {
  FlyWindow window(1280, 720, WarningBehindAnAdvisory());
  EXPECT_FALSE(window.bar.history_open);
  window.ui.Click("alarm_count", window.draw);
  EXPECT_TRUE(window.bar.history_open);
}

// One count, in the same words, in the strip and in the status bar.
TEST(AlarmStrip, CountsAsTheStatusBarDoes) {
  EngineSnapshot snap = WarningBehindAnAdvisory();
  auto& alarms = snap.flight.Edit().mission.alarms;
  alarms.insert(alarms.begin(), {AlarmId::kWind, AlarmLevel::kCaution, "Wind 9.0 m/s."});
  alarms.front().acknowledged = true;
  FlyWindow window(1920, 1080, snap);
  const std::string words = "1 caution, 1 advisory stand, 1 ended";
  EXPECT_EQ(window.ui.items.Find("alarm_count")->text, words);
  int told = 0;
  for (const Item& item : window.ui.items.items()) {
    told += item.name == "text" && item.text == words ? 1 : 0;
  }
  EXPECT_EQ(told, 2);
}

TEST(AlarmList, KeepsTheWorstOfWhatIsOver) {
  EngineSnapshot snap = WarningBehindAnAdvisory();
  auto& alarms = snap.flight.Edit().mission.alarms;
  alarms[1].worst = "62 ms";
  FlyWindow window(1920, 1080, snap);
  window.ui.Click("alarm", window.draw);
  window.ui.Frame(window.draw);
  EXPECT_TRUE(HasText(window.ui.items, "Ended, worst 62 ms: Pictures 62 ms late"));
  alarms = {{AlarmId::kGpsError, AlarmLevel::kCaution, "GPS horizontal error 2.1 m, limit 2.0 m."}};
  alarms[0].worst = "2.6 m";
  window.snap = snap;
  window.ui.Frame(window.draw);
  EXPECT_TRUE(HasText(window.ui.items, "GPS horizontal error 2.1 m, limit 2.0 m. At worst 2.6 m."));
}

// One press for all that ended and is listed in full; what stands is answered by itself.
TEST(AlarmList, WhatIsOverIsAnsweredTogether) {
  for (const int over : {1, 3}) {
    EngineSnapshot snap = WarningBehindAnAdvisory();
    auto& alarms = snap.flight.Edit().mission.alarms;
    alarms = {{AlarmId::kWind, AlarmLevel::kCaution, "Wind 9.0 m/s."}};
    for (const AlarmId id : {AlarmId::kImageTime, AlarmId::kGpsError, AlarmId::kGpsJump}) {
      alarms.push_back({id, AlarmLevel::kWarning, "Over."});
      alarms.back().active = false;
      alarms.back().acknowledged = static_cast<int>(alarms.size()) > over + 1;
    }
    for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
      FlyWindow window(size.x, size.y, snap);
      window.ui.Click("alarm", window.draw);
      window.ui.Frame(window.draw);
      ASSERT_EQ(window.ui.items.Find("acknowledge_over") != nullptr, over > 1);
      if (over > 1) {
        EXPECT_TRUE(HasText(window.ui.items, "Acknowledge the 3 that are over"));
        window.ui.Click("acknowledge_over", window.draw);
        EXPECT_EQ(window.ui.CountCommands<AcknowledgeAlarm>(), over);
      }
    }
  }
}

// A pointer on its way to a button meets that button, or nothing.
TEST(AlarmStrip, ButtonsEndWhereTheyAlwaysEnd) {
  EngineSnapshot snap = WarningBehindAnAdvisory();
  auto& alarms = snap.flight.Edit().mission.alarms;
  const Alarm wind{AlarmId::kWind, AlarmLevel::kCaution, "Wind 9.0 m/s."};
  FlyWindow window(1280, 720, snap);
  const auto end = [&](const char* name) {
    const Item* item = window.ui.items.Find(name);
    return item != nullptr ? item->rect.right() : NAN;
  };
  const float answer = end("acknowledge");
  const Rect strip = window.ui.items.Find("panel/Alarm strip")->rect;
  alarms = {wind};
  window.snap = snap;
  window.ui.Frame(window.draw);
  EXPECT_FLOAT_EQ(end("acknowledge"), answer);
  const float shelve = end("shelve");
  EXPECT_GT(shelve, answer);
  alarms[0].acknowledged = true;
  alarms.push_back({AlarmId::kExposure, AlarmLevel::kAdvisory, "Site B lies half in shadow."});
  window.snap = snap;
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.ui.items.Find("acknowledge"), nullptr);
  EXPECT_FLOAT_EQ(end("shelve"), shelve);
  EXPECT_LE(end("alarm_count"), answer - 112) << "nothing else comes there";
  EXPECT_GT(shelve, strip.right() - 40);
}

// What ends or comes while the list is open moves no row; only the operator opens and closes it.
TEST(AlarmList, RowsKeepTheirPlacesWhileItIsOpen) {
  EngineSnapshot snap = WarningBehindAnAdvisory();
  auto& alarms = snap.flight.Edit().mission.alarms;
  const Alarm wind{AlarmId::kWind, AlarmLevel::kCaution, "Wind 9.0 m/s."};
  alarms.push_back(wind);
  FlyWindow window(1280, 720, snap);
  window.ui.Click("alarm", window.draw);
  window.ui.Frame(window.draw);
  const auto place = [&](AlarmId id) {
    return window.ui.items.Find(std::string("acknowledge/") + AlarmName(id))->rect.y;
  };
  const float of_wind = place(AlarmId::kWind);
  alarms = {{AlarmId::kGpsError, AlarmLevel::kWarning, "GPS horizontal error 2.6 m."}, wind};
  window.snap = snap;
  window.ui.Frame(window.draw);
  EXPECT_FLOAT_EQ(place(AlarmId::kWind), of_wind);
  EXPECT_GT(place(AlarmId::kGpsError), of_wind);
  EXPECT_TRUE(HasText(window.ui.items, "Ended: Site B lies half in shadow"));
  alarms.clear();
  window.snap = snap;
  window.ui.Frame(window.draw);
  EXPECT_TRUE(window.bar.history_open);
  EXPECT_TRUE(HasText(window.ui.items, "Ended: Wind 9.0 m/s"));
  EXPECT_EQ(window.ui.items.Find(std::string("acknowledge/") + AlarmName(AlarmId::kWind)), nullptr);
}

// Three holds may have had three causes: the words are of one.
TEST(AlarmStrip, OfWhatEndedMoreThanOnceTheWordsAreOfTheLast) {
  Alarm alarm{AlarmId::kHold, AlarmLevel::kCaution, "Descent on hold: Held by the operator. Wait."};
  alarm.active = false;
  EXPECT_EQ(AlarmWords(alarm, false), "Ended: Descent on hold: Held by the operator.");
  alarm.count = 3;
  EXPECT_EQ(AlarmWords(alarm, false), "Ended, last of 3: Descent on hold: Held by the operator.");
  alarm.worst = "0.62 m";
  EXPECT_EQ(AlarmWords(alarm, false),
            "Ended, worst 0.62 m: Descent on hold: Held by the operator. ×3");
  alarm.active = true;
  EXPECT_NE(AlarmWords(alarm, false).find("×3"), std::string::npos);
}

// Where the words have no room whole clauses stand, and the pointer tells the rest.
TEST(AlarmStrip, CutsNoClauseInTwo) {
  EngineSnapshot snap = WarningBehindAnAdvisory();
  auto& alarms = snap.flight.Edit().mission.alarms;
  alarms[0].text =
      "Ground of site A not measured for 2.4 s, limit 2.0 s. Descent holds and the vehicle waits "
      "for the operator, who looks at both pictures and then decides again what is to be done.";
  FlyWindow window(1280, 720, snap);
  EXPECT_TRUE(HasText(window.ui.items, "not measured for 2.4 s"));
  for (const Item& item : window.ui.items.items()) {
    EXPECT_FALSE(item.name == "text" && item.text.find("Descent holds and") != std::string::npos)
        << item.text;
  }
  window.ui.MoveTo("alarm");
  window.Run(1.5);
  ASSERT_NE(window.ui.items.Find("tooltip"), nullptr);
  EXPECT_NE(window.ui.items.Find("tooltip")->text.find("Descent holds and"), std::string::npos);
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
    EXPECT_NE(all.find("Ended: Pictures 62 ms late"), std::string::npos);
    const std::string answer = std::string("acknowledge/") + AlarmName(AlarmId::kImageTime);
    ASSERT_NE(window.ui.items.Find(answer), nullptr);
    window.ui.Click(answer, window.draw);
    EXPECT_EQ(window.ui.CountCommands<AcknowledgeAlarm>(), 1);
    EXPECT_NE(window.ui.items.Find("alarm_history"), nullptr) << "it stays open";
  }
}

}  // namespace
}  // namespace palace
