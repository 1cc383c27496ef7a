// Commands and the words in which they are told.
#include <gtest/gtest.h>

#include "engine/model/mission/approve_offer.h"
#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

// What only a preview shows has no letter, and no command takes it.
TEST(UnnamedPlaces, AreNeitherSelectedNorRefused) {
  MissionRig rig;
  rig.AddSite(kFirstUnnamedSite + 1, '+', {0, 0, 0});
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  EXPECT_FALSE(rig.mission.status().MaySelect(kFirstUnnamedSite + 1));
  EXPECT_TRUE(rig.mission.status().MaySelect(101));
  EXPECT_FALSE(rig.Do(SelectSite{kFirstUnnamedSite + 1}).ok());
  EXPECT_FALSE(rig.Do(RefuseSite{kFirstUnnamedSite + 1}).ok());
  EXPECT_EQ(rig.state(), MissionState::kProposed);
  EXPECT_FALSE(rig.mission.status().armed.has_value());
}

// The words of the screen, never the name that the wire has.
TEST(Acknowledging, IsToldInTheWordsOfTheAlarm) {
  MissionRig rig;
  rig.Arm();
  rig.recorder_ok = false;
  rig.Run(1);
  ASSERT_TRUE(rig.Do(AcknowledgeAlarm{AlarmName(AlarmId::kRecorder)}).ok());
  EXPECT_EQ(rig.mission.events().back().text, "Acknowledged: Recording is not running");
  rig.recorder_ok = true;
  rig.Run(1);
  EXPECT_EQ(rig.Do(AcknowledgeAlarm{AlarmName(AlarmId::kRecorder)}).error().message,
            "\"Recording is not running\" does not stand any more");
  EXPECT_EQ(rig.Do(AcknowledgeAlarm{AlarmName(AlarmId::kClock)}).error().message,
            "No such alarm stands");
  for (const Event& event : rig.mission.events()) {
    EXPECT_EQ(event.text.find(AlarmName(AlarmId::kRecorder) + std::string("'")), std::string::npos);
  }
}

// One word for one thing: the button says the same.
TEST(Approving, TheEventNamesTheStandingOfTheSite) {
  const struct {
    bool confirmed;
    double noise_m;
    bool confirmed_since;
    const char* mark;
  } table[] = {{true, 0.01, false, ""},
               {false, 0.01, false, ", provisional"},
               {false, 0.2, false, ", not seen enough"},
               {false, 0.2, true, ""}};
  for (const auto& row : table) {
    SCOPED_TRACE(row.mark);
    MissionRig rig;
    rig.Site(101)->confirmed = row.confirmed;
    rig.Site(101)->height_m.three_sigma = row.noise_m;
    rig.Arm();
    if (row.confirmed_since) {
      rig.Site(101)->confirmed = true;
      rig.Run(0.5);
    }
    EXPECT_EQ(StandingMark(rig.mission.status(), rig.settings.slad), row.mark);
    ASSERT_TRUE(rig.ApproveNow().ok());
    int told = 0;
    for (const Event& event : rig.mission.events()) {
      told += event.text.ends_with("A" + std::string(row.mark) + " given") ? 1 : 0;
    }
    EXPECT_EQ(told, 1);
  }
}

// What later maps do not confirm any more is not approved as confirmed.
TEST(Approving, WhatTheListCallsConfirmedNoLongerIsProvisional) {
  MissionRig rig;
  rig.Site(101)->confirmed = true;
  rig.Arm();
  EXPECT_TRUE(rig.mission.status().armed_confirmed);
  rig.Site(101)->confirmed = false;
  rig.Run(0.3);
  EXPECT_FALSE(rig.mission.status().armed_confirmed);
  EXPECT_EQ(StandingMark(rig.mission.status(), rig.settings.slad), ", provisional");
  ASSERT_TRUE(rig.ApproveNow().ok());
  EXPECT_TRUE(rig.mission.status().approval->provisional);
  // In flight one map that confirms it is enough, and stays so.
  rig.Site(101)->confirmed = true;
  rig.Run(0.3);
  rig.Site(101)->confirmed = false;
  rig.Run(0.3);
  EXPECT_TRUE(rig.mission.status().armed_confirmed);
}

}  // namespace
}  // namespace palace
