// The operator of experiments: what it does where a descent was stopped, snapshot by snapshot.
#include "engine/runtime/scripted_operator.h"

#include <memory>
#include <utility>

#include <gtest/gtest.h>

namespace palace {
namespace {

/// A station's screen, made by hand.
class Desk {
 public:
  explicit Desk(int looks_again, bool looks_closer = false) : pilot(looks_again, looks_closer) {
    snapshot.flight.Edit().mission.height_above_site_m = 15;
    auto seen = std::make_shared<TerrainDecision>();
    for (const std::uint64_t id : {1, 2}) {
      LandingSite site;
      site.id = id;
      seen->selection.sites.push_back(site);
    }
    map = std::move(seen);
  }
  /// Half a second in a state; what the operator did in it.
  std::vector<EngineCommand> See(MissionState state) {
    MissionStatus& mission = snapshot.flight.Edit().mission;
    mission.state = state;
    mission.can_approve = state == MissionState::kArmed && approvable;
    snapshot.terrain.Edit().applied = map;
    snapshot.time = AddSeconds(snapshot.time, 0.5);
    ++snapshot.sequence;
    return pilot.Decide(snapshot);
  }
  template <typename T>
  const T* Watch(MissionState state, double seconds) {
    for (double t_s = 0; t_s < seconds; t_s += 0.5) {
      done = See(state);
      for (const EngineCommand& command : done) {
        if (const T* found = std::get_if<T>(&command.action)) {
          return found;
        }
      }
    }
    return nullptr;
  }
  /// Which site it selects after its wave-off is over; 0: none.
  std::uint64_t SelectedAfterWaveOff() {
    snapshot.flight.Edit().mission.wave_off.over = true;
    if (Watch<AcknowledgeWaveOff>(MissionState::kAborting, 1) == nullptr) {
      return 0;
    }
    const SelectSite* next = Watch<SelectSite>(MissionState::kProposed, 5);
    return next != nullptr ? next->site_id : 0;
  }
  void Arm(std::uint64_t id) {
    LandingSite site;
    site.id = id;
    snapshot.flight.Edit().mission.armed = site;
  }

  ScriptedOperator pilot;
  EngineSnapshot snapshot;
  std::shared_ptr<TerrainDecision> map;
  std::vector<EngineCommand> done;
  bool approvable = true;
};

TEST(ScriptedOperator, OneThatDoesNotLookAgainWaitsOnHold) {
  Desk desk(0);
  desk.Arm(1);
  desk.See(MissionState::kDescending);
  EXPECT_EQ(desk.Watch<WaveOff>(MissionState::kHold, 120), nullptr);
}

TEST(ScriptedOperator, WavesOffWhereNothingCanBeApprovedAndGoesOnElsewhere) {
  Desk desk(1);
  ASSERT_NE(desk.Watch<SelectSite>(MissionState::kProposed, 5), nullptr);
  desk.Arm(1);
  ASSERT_NE(desk.Watch<ApproveSite>(MissionState::kArmed, 5), nullptr);
  desk.See(MissionState::kDescending);
  EXPECT_EQ(desk.Watch<WaveOff>(MissionState::kHold, 14), nullptr);
  ASSERT_NE(desk.Watch<WaveOff>(MissionState::kHold, 3), nullptr);
  EXPECT_EQ(desk.Watch<AcknowledgeWaveOff>(MissionState::kAborting, 20), nullptr);
  ASSERT_EQ(desk.SelectedAfterWaveOff(), 2u) << "the first failed it";
  desk.Arm(2);
  desk.See(MissionState::kDescending);
  EXPECT_EQ(desk.Watch<WaveOff>(MissionState::kHold, 60), nullptr) << "once was all";
}

TEST(ScriptedOperator, NothingIsWavedOffOnTheGroundOrBeforeADescent) {
  Desk desk(3);
  EXPECT_EQ(desk.Watch<WaveOff>(MissionState::kSearch, 60), nullptr);
  desk.Arm(1);
  desk.See(MissionState::kDescending);
  desk.snapshot.flight.Edit().mission.why_no_wave_off = "Vehicle on the ground";
  EXPECT_EQ(desk.Watch<WaveOff>(MissionState::kHold, 60), nullptr);
  desk.snapshot.flight.Edit().mission.why_no_wave_off.clear();
  EXPECT_EQ(desk.Watch<WaveOff>(MissionState::kLanded, 60), nullptr);
}

// From there neither what hangs above nor much else is seen: nothing is selected before a climb.
TEST(ScriptedOperator, StoppedNearTheGroundItWavesOffAtOnce) {
  Desk desk(1);
  desk.Arm(1);
  desk.snapshot.flight.Edit().mission.height_above_site_m = 6;
  desk.See(MissionState::kDescending);
  ASSERT_NE(desk.Watch<WaveOff>(MissionState::kHold, 4), nullptr);
  Desk tired(1);
  tired.Arm(1);
  for (int descent = 0; descent < 2; ++descent) {
    tired.snapshot.flight.Edit().mission.height_above_site_m = 6;
    tired.See(MissionState::kDescending);
    tired.Watch<WaveOff>(MissionState::kHold, 4);
    if (descent == 0) {
      tired.See(MissionState::kAborting);
    }
  }
  EXPECT_EQ(tired.Watch<SelectSite>(MissionState::kProposed, 20), nullptr);
}

TEST(ScriptedOperator, LooksCloserOnceAtASiteWhereALookIsOffered) {
  Desk plain(1), desk(1, /*looks_closer=*/true);
  for (Desk* one : {&plain, &desk}) {
    one->Arm(1);
    one->snapshot.flight.Edit().mission.look_from_m = 12;
  }
  EXPECT_EQ(plain.Watch<LookAtSite>(MissionState::kArmed, 5), nullptr);
  const LookAtSite* look = desk.Watch<LookAtSite>(MissionState::kArmed, 5);
  ASSERT_NE(look, nullptr);
  EXPECT_EQ(look->site_id, 1u);
  EXPECT_EQ(look->snapshot_sequence, desk.snapshot.sequence);
  EXPECT_EQ(look->stop_height_m, 12);
  desk.snapshot.flight.Edit().mission.stop_height_m = 12;
  desk.See(MissionState::kDescending);
  desk.snapshot.flight.Edit().mission.stop_height_m = 0;
  const SelectSite* again = desk.Watch<SelectSite>(MissionState::kProposed, 5);
  ASSERT_NE(again, nullptr);
  EXPECT_EQ(again->site_id, 1u) << "a look that ended is no failure";
  ASSERT_NE(desk.Watch<ApproveSite>(MissionState::kArmed, 5), nullptr) << "once was enough";
}

TEST(ScriptedOperator, WhereALookSettledNothingItWavesOffAndCountsIt) {
  Desk desk(1, /*looks_closer=*/true);
  desk.Arm(1);
  desk.snapshot.flight.Edit().mission.stop_height_m = 12;
  desk.See(MissionState::kDescending);
  desk.snapshot.flight.Edit().mission.stop_height_m = 0;
  EXPECT_EQ(desk.Watch<WaveOff>(MissionState::kSearch, 29), nullptr);
  ASSERT_NE(desk.Watch<WaveOff>(MissionState::kSearch, 3), nullptr);
  EXPECT_EQ(desk.SelectedAfterWaveOff(), 2u);
}

TEST(ScriptedOperator, AWarningThatIsOverIsAcknowledged) {
  Desk desk(1);
  Alarm alarm{.kind = AlarmId::kVisionLost, .level = AlarmLevel::kWarning};
  desk.snapshot.flight.Edit().mission.alarms = {alarm};
  EXPECT_EQ(desk.Watch<AcknowledgeAlarm>(MissionState::kHold, 5), nullptr) << "it stands";
  desk.snapshot.flight.Edit().mission.alarms[0].active = false;
  const AcknowledgeAlarm* done = desk.Watch<AcknowledgeAlarm>(MissionState::kHold, 1);
  ASSERT_NE(done, nullptr);
  EXPECT_EQ(done->alarm, alarm.id);
}

TEST(ScriptedOperator, WhatStaysBlockedOrLeftTheViewIsNotInsistedOn) {
  Desk desk(1);
  desk.approvable = false;
  desk.Arm(1);
  ASSERT_NE(desk.Watch<DisarmSite>(MissionState::kArmed, 12), nullptr);
  const SelectSite* next = desk.Watch<SelectSite>(MissionState::kProposed, 5);
  ASSERT_NE(next, nullptr);
  EXPECT_EQ(next->site_id, 2u);
  for (LandingSite& site : desk.map->selection.sites) {
    site.age_s = 30;
  }
  EXPECT_EQ(desk.Watch<SelectSite>(MissionState::kProposed, 20), nullptr);
}

}  // namespace
}  // namespace palace
