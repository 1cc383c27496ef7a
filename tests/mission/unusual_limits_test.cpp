// Limits that a person moved further than is usual, and sizes that do not go together.
#include "engine/mission/guards.h"
#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

const Alarm* Standing(const MissionRig& rig) {
  for (const Alarm& alarm : rig.mission.status().alarms) {
    if (alarm.kind == AlarmId::kUnusualLimits && alarm.active) {
      return &alarm;
    }
  }
  return nullptr;
}

TEST(UnusualLimits, AreACautionThatBlocksNothing) {
  MissionRig rig;
  rig.Run(0.5);
  EXPECT_EQ(Standing(rig), nullptr);
  rig.settings.slad.limits.max_deviation_m = 1;
  ++rig.settings_hash;
  rig.Run(0.5);
  rig.Arm();
  const Alarm* alarm = Standing(rig);
  ASSERT_NE(alarm, nullptr);
  EXPECT_EQ(alarm->level, AlarmLevel::kCaution);
  EXPECT_EQ(alarm->text,
            "Max roughness 100.0 cm (usually 2.0 cm to 30.0 cm). What is offered rests on it: see "
            "Tune.");
  EXPECT_TRUE(rig.mission.status().can_approve) << rig.mission.status().cannot_approve_reason;
}

TEST(UnusualLimits, ABaseThatDoesNotHoldItsGearIsNotApprovedOn) {
  MissionRig rig;
  rig.settings.slad.lander.base_size_m = 0.2;
  rig.Arm();
  const GuardResult* guard = FindGuard(rig.mission.status().guards, GuardId::kUnchanged);
  ASSERT_NE(guard, nullptr);
  EXPECT_FALSE(guard->pass);
  EXPECT_EQ(guard->reason, "Base size 0.20 m, min 1.50 m: its circle holds the gear");
  EXPECT_FALSE(rig.mission.status().can_approve);
}

}  // namespace
}  // namespace palace
