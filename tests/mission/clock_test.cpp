// Clocks in the mission: steps, stalls, restarts, and figures that nobody measured for long.
#include <algorithm>
#include <cmath>

#include "engine/mission/alarms/alarms.h"
#include "engine/mission/wording.h"
#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

const Alarm* Find(const MissionRig& rig, AlarmId id) {
  for (const Alarm& alarm : rig.mission.status().alarms) {
    if (alarm.kind == id) {
      return &alarm;
    }
  }
  return nullptr;
}

/// The source found that the vehicle's clock stepped: time jumps with it.
void StepClock(MissionRig& rig, double step_s) {
  rig.arrival.clock = ClockReading{.estimating = true, .stepped_s = step_s};
  rig.jumped = true;
  rig.now = AddSeconds(rig.now, step_s);
}

TEST(Clock, AStepIsNamedWithItsSizeAndDropsWhatWasSelected) {
  for (const double step_s : {5.0, -5.0, 86400.0}) {
    for (const bool approve : {false, true}) {
      SCOPED_TRACE(step_s);
      MissionRig rig;
      rig.Arm();
      if (approve) {
        ASSERT_TRUE(rig.ApproveNow().ok());
      }
      StepClock(rig, step_s);
      rig.Step();
      EXPECT_FALSE(rig.mission.status().armed);
      EXPECT_FALSE(rig.mission.status().approval);
      const Alarm* alarm = Find(rig, AlarmId::kClock);
      ASSERT_NE(alarm, nullptr);
      char size[32];
      std::snprintf(size, sizeof size, step_s < 0 ? "back %.1f s" : "ahead %.1f s",
                    std::abs(step_s));
      EXPECT_NE(alarm->text.find(size), std::string::npos) << alarm->text;
      EXPECT_TRUE(std::any_of(
          rig.mission.events().begin(), rig.mission.events().end(),
          [&](const Event& event) { return event.text.find(size) != std::string::npos; }));
    }
  }
}

// What our own machine missed is no fault of the vehicle's: named as ours, nothing falls.
TEST(Clock, AStallOfThisMachineDropsNothing) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  rig.arrival.clock = ClockReading{.estimating = false, .stalled_s = 0.8};
  rig.now = AddSeconds(rig.now, 0.8);  // and all that queued comes with the next bundle
  rig.Step();
  EXPECT_EQ(rig.state(), MissionState::kDescending) << rig.mission.status().why;
  EXPECT_EQ(Find(rig, AlarmId::kClock), nullptr);
  ASSERT_NE(Find(rig, AlarmId::kStalled), nullptr);
  EXPECT_EQ(Find(rig, AlarmId::kStalled)->level, AlarmLevel::kAdvisory);
  EXPECT_NE(Find(rig, AlarmId::kStalled)->text.find("This computer stood still for 0.8 s"),
            std::string::npos);
  rig.Run(11);
  EXPECT_EQ(Find(rig, AlarmId::kStalled), nullptr);
}

// ... but nothing is kept either that is stale by the true clock: maps of four seconds ago.
TEST(Clock, WhatIsStaleAfterAStallFalls) {
  MissionRig rig;
  rig.Arm();
  rig.maps_up = false;
  rig.arrival.clock = ClockReading{.estimating = false, .stalled_s = 4};
  rig.now = AddSeconds(rig.now, 4);
  rig.Step();
  EXPECT_FALSE(rig.mission.status().armed);
}

// I18: after a step three consistent statuses, and a clock that is known again.
TEST(Clock, NoApprovalUntilTheClockIsKnownAgain) {
  MissionRig rig;
  rig.Arm();
  StepClock(rig, 5);
  rig.Step();
  ASSERT_TRUE(rig.Do(AcknowledgeAlarm{"clock"}).ok());
  rig.Arm();
  EXPECT_FALSE(rig.mission.status().can_approve);
  EXPECT_FALSE(FindGuard(rig.mission.status().guards, GuardId::kVehicle)->pass);
  rig.arrival.clock->estimating = false;
  rig.Run(0.2);
  EXPECT_TRUE(rig.mission.status().can_approve) << rig.mission.status().cannot_approve_reason;
}

TEST(Clock, IsNamedBeforeASiteIsSelectedToo) {
  MissionRig rig;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  EXPECT_EQ(rig.mission.status().cannot_approve_reason, words::kSelectFirst);
  StepClock(rig, 5);
  rig.Step();
  ASSERT_TRUE(rig.Do(AcknowledgeAlarm{"clock"}).ok());
  rig.Run(0.3);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason,
            "Vehicle clock stepped or is not yet known");
  rig.arrival.clock->estimating = false;
  rig.Run(1);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason, words::kSelectFirst);
}

// A real restart takes the clock along: it is named all the same (found-by-attack, defect 15).
TEST(Clock, ARestartIsNamedThoughTheClockRestartsToo) {
  MissionRig rig;
  rig.Arm();
  StepClock(rig, -900);
  rig.vehicle.boot_id = 78;
  rig.Run(0.3);
  EXPECT_NE(Find(rig, AlarmId::kReboot), nullptr);
  EXPECT_FALSE(rig.mission.status().armed);
}

TEST(Clock, TheSameBootAfterAStepIsNoRestart) {
  MissionRig rig;
  rig.Arm();
  StepClock(rig, -5);
  rig.Run(0.5);
  EXPECT_EQ(Find(rig, AlarmId::kReboot), nullptr);
  EXPECT_NE(Find(rig, AlarmId::kClock), nullptr);
}

// An estimate that inertia alone carried for 5 s is unknown, not wrong: no height, no distance.
TEST(Estimate, IsUnknownOnceItCoastedForTooLong) {
  MissionRig rig;
  rig.Arm();
  for (const auto& [coasting_s, known] : {std::pair{4.9, true}, std::pair{5.1, false}}) {
    rig.navigation.gps.coasting_s = coasting_s;
    rig.Step();
    EXPECT_EQ(std::isfinite(rig.mission.status().height_above_site_m), known) << coasting_s;
    EXPECT_EQ(std::isfinite(rig.mission.status().distance_to_site_m), known) << coasting_s;
    EXPECT_EQ(FindGuard(rig.mission.status().guards, GuardId::kPosition)->pass, known);
  }
}

// The armed site that gets worse is an alarm before it is approved, not an event alone.
TEST(Site, AnArmedSiteThatDegradesIsAnAlarm) {
  MissionRig rig;
  rig.Arm();
  EXPECT_EQ(Find(rig, AlarmId::kSiteDegraded), nullptr);
  rig.ground_age_s = 2.4;
  rig.Run(0.6);
  ASSERT_NE(Find(rig, AlarmId::kSiteDegraded), nullptr);
  EXPECT_NE(Find(rig, AlarmId::kSiteDegraded)->text.find("before you approve"), std::string::npos);
}

ChannelHealth Channel(ChannelId id, double rate_hz, double lost_share) {
  ChannelHealth health;
  health.id = id;
  health.rate_hz = rate_hz;
  health.lost_share = lost_share;
  return health;
}

// A channel that loses most of its messages weighs by what was sent on it, not by what came.
TEST(Loss, WeighsByWhatWasSent) {
  EXPECT_NEAR(
      LostShare({Channel(ChannelId::kVehiclePose, 20, 0.6), Channel(ChannelId::kImu, 100, 0),
                 Channel(ChannelId::kGps, 5, 0), Channel(ChannelId::kLaserRange, 20, 0)}),
      30.0 / 175, 1e-9);
  EXPECT_NEAR(LostShare({Channel(ChannelId::kVehiclePose, 35, 0.3)}), 0.3, 1e-9);
}

// Of the channel that loses them, not of "the vehicle's messages": one of several may do so alone.
TEST(Loss, IsToldOfTheChannelsThatLose) {
  using C = ChannelId;
  struct Row {
    std::vector<ChannelHealth> channels;
    const char* words;
  };
  for (const Row& row :
       {Row{{Channel(C::kVehiclePose, 50, 0), Channel(C::kImu, 20, 0.8),
             Channel(C::kGps, 5, 0.002)},
            "IMU 80 %"},
        Row{{Channel(C::kVehiclePose, 70, 0.3), Channel(C::kImu, 60, 0.4)},
            "IMU 40 %, Vehicle pose 30 %"},
        Row{{Channel(C::kVehiclePose, 35, 0.3), Channel(C::kImu, 100, NAN),
             Channel(C::kCameraLeft, 5, 0.5)},
            "Vehicle pose 30 %"},
        Row{{Channel(C::kVehiclePose, 50, 0.001), Channel(C::kImu, 100, 0)}, ""}}) {
    EXPECT_EQ(LosersWords(row.channels), row.words);
  }
}

TEST(Loss, IsSaidInPercentByChannel) {
  MissionRig rig;
  rig.Arm();
  rig.channels[2].lost_share = 0.31;
  rig.Run(0.5);
  const Alarm* alarm = Find(rig, AlarmId::kMessageLoss);
  ASSERT_NE(alarm, nullptr);
  EXPECT_EQ(alarm->level, AlarmLevel::kCaution);
  EXPECT_EQ(alarm->text,
            "31 % of messages lost in 5 s, limit 10 %: Vehicle pose 31 %. Check the link; beyond "
            "50 % approve is blocked.");
  EXPECT_TRUE(rig.mission.status().can_approve) << "below the limit of the guard";
}

}  // namespace
}  // namespace palace
