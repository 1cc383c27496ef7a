// The state machine as a pure function: one memory, one input, one row of the transition table.
#include "engine/mission/step.h"

#include <functional>

#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

std::string Told(const MissionEffects& effects) {
  std::string text;
  for (const Event& event : effects.events) {
    text += std::to_string(event.time.us) + " " + event.text + "\n";
  }
  for (const VehicleMessage& message : effects.messages) {
    text += std::to_string(message.index()) + "\n";
  }
  return text;
}

/// A rig in one state of the machine.
MissionRig In(MissionState state) {
  MissionRig rig;
  if (state >= MissionState::kArmed) {
    rig.Arm();
  }
  if (state >= MissionState::kApproved) {
    EXPECT_TRUE(rig.ApproveNow().ok());
  }
  EXPECT_TRUE(rig.RunUntil(state, 10));
  return rig;
}

struct Row {
  const char* name;
  MissionState from;
  std::function<void(MissionRig&)> change;  ///< of what the next bundle brings
  MissionState to;
  const char* why;
  std::size_t message;  ///< index of the first message sent; npos when none is
};
constexpr std::size_t kNothing = std::variant_npos;
constexpr std::size_t kHold = 2, kAbort = 3;  // of VehicleMessage

class Transition : public testing::TestWithParam<Row> {};

TEST_P(Transition, TakesOneStepAndChangesNothingElse) {
  const Row& row = GetParam();
  MissionRig rig = In(row.from);
  row.change(rig);
  rig.Wait();
  const MissionMemory before = rig.mission.memory();
  const MissionInputs in = rig.Inputs();
  const MissionStep step = Step(rig.options, before, in);
  EXPECT_EQ(step.memory.status.state, row.to);
  EXPECT_EQ(step.memory.status.why, row.why);
  const auto& sent = step.effects.messages;
  EXPECT_EQ(sent.empty() ? kNothing : sent[0].index(), row.message);
  // The argument stands, and the same again gives the same.
  EXPECT_EQ(before.status.state, row.from);
  const MissionStep again = Step(rig.options, before, in);
  EXPECT_EQ(Told(step.effects), Told(again.effects));
  EXPECT_EQ(again.memory.status.why, step.memory.status.why);
}

using S = MissionState;
INSTANTIATE_TEST_SUITE_P(
    , Transition,
    testing::Values(
        Row{"SearchOnNoCameras", S::kSearch,
            [](MissionRig& r) {
              r.cameras_up = false;
              r.now = AddSeconds(r.now, 6);
            },
            S::kNoLive, "Left camera stale, 6.1 s", kNothing},
        Row{"ProposedOnNoSite", S::kProposed, [](MissionRig& r) { r.sites.clear(); }, S::kSearch,
            "No site stands on the newest map", kNothing},
        Row{"ArmedOnLimits", S::kArmed, [](MissionRig& r) { r.settings_hash ^= 1; }, S::kProposed,
            "Limits changed", kNothing},
        Row{"ArmedOnCalibration", S::kArmed, [](MissionRig& r) { r.calibration_hash ^= 1; },
            S::kProposed, "Calibration changed", kNothing},
        Row{"ArmedOnReboot", S::kArmed, [](MissionRig& r) { ++r.vehicle.boot_id; }, S::kProposed,
            "Vehicle restarted", kNothing},
        Row{"ArmedOnClock", S::kArmed, [](MissionRig& r) { r.clock_offset_us += 3'000'000; },
            S::kProposed, "Vehicle clock stepped ahead 3.0 s", kNothing},
        Row{"ArmedStays", S::kArmed, [](MissionRig&) {}, S::kArmed, "Site A selected", kNothing},
        Row{"ApprovedOnLimits", S::kApproved, [](MissionRig& r) { r.settings_hash ^= 1; }, S::kHold,
            "Limits changed", kHold},
        Row{"ApprovedUnansweredOnLimits", S::kApproved,
            [](MissionRig& r) {
              r.link_up = false;
              r.settings_hash ^= 1;
            },
            S::kProposed, "Limits changed", kHold},
        Row{"ApprovedOnAbort", S::kApproved,
            [](MissionRig& r) {
              r.Step();  // the approval is with the vehicle
              r.vehicle.Set(VehicleMode::kAbort);
            },
            S::kAborting, "Vehicle aborts by itself", kAbort},
        Row{"DescendingOnHold", S::kDescending,
            [](MissionRig& r) { r.vehicle.Set(VehicleMode::kHold); }, S::kHold,
            "Vehicle holds by itself", kHold},
        Row{"DescendingOnHover", S::kDescending,
            [](MissionRig& r) { r.vehicle.Set(VehicleMode::kHover); }, S::kHold,
            "Vehicle left the descent", kHold},
        Row{"DescendingOnForeign", S::kDescending, [](MissionRig& r) { ++r.vehicle.approval_id; },
            S::kHold, "Vehicle left the descent", kHold},
        Row{"DescendingOnAbort", S::kDescending,
            [](MissionRig& r) { r.vehicle.Set(VehicleMode::kAbort); }, S::kAborting,
            "Vehicle aborts by itself", kAbort},
        Row{"DescendingOnAbortWithAReason", S::kDescending,
            [](MissionRig& r) {
              r.vehicle.acks.push_back({r.now, r.vehicle.approval_id, AckResult::kRefused,
                                        "no position from vision for 2.0 s"});
              r.vehicle.Set(VehicleMode::kAbort);
            },
            S::kAborting, "Vehicle aborts by itself: no position from vision for 2.0 s", kAbort},
        Row{"DescendingOnNoHeight", S::kDescending, [](MissionRig& r) { r.vehicle.height_m = NAN; },
            S::kHold, "Height above the site is unknown", kHold},
        Row{"DescendingOnGround", S::kDescending,
            [](MissionRig& r) { r.vehicle.Set(VehicleMode::kLanded); }, S::kLanded,
            "Vehicle is on the ground at site A", kNothing}),
    [](const auto& row) { return row.param.name; });

// A memory is a value: two copies fed alike go on alike, and one that is kept can go on later.
TEST(Step, CopiesOfAMemoryGoOnAlike) {
  MissionRig rig = In(MissionState::kArmed);
  rig.Wait();
  const MissionMemory kept = rig.mission.memory();
  const EngineCommand select{CommandOrigin::kOperator, SelectSite{102}};
  const MissionAnswer one = Apply(rig.options, kept, select, rig.Session());
  ASSERT_TRUE(one.status.ok());
  EXPECT_EQ(one.memory.status.armed->id, 102U);
  EXPECT_EQ(kept.status.armed->id, 101U);
  const EngineCommand disarm{CommandOrigin::kOperator, DisarmSite{}};
  const MissionAnswer other = Apply(rig.options, kept, disarm, rig.Session());
  ASSERT_TRUE(other.status.ok());
  EXPECT_FALSE(other.memory.status.armed.has_value());
  EXPECT_EQ(Told(Apply(rig.options, kept, select, rig.Session()).effects), Told(one.effects));
}

// What is refused leaves no trace but the reason (I22).
TEST(Step, ARefusedCommandChangesOnlyTheEvents) {
  MissionRig rig = In(MissionState::kProposed);
  const MissionMemory before = rig.mission.memory();
  for (const CommandAction& action :
       {CommandAction(ApproveSite{101, 1}), CommandAction(HoldHere{}), CommandAction(DisarmSite{}),
        CommandAction(SelectSite{999}), CommandAction(AcknowledgeWaveOff{}),
        CommandAction(AcknowledgeAlarm{"no such alarm"})}) {
    const MissionAnswer answer =
        Apply(rig.options, before, {CommandOrigin::kOperator, action}, rig.Session());
    ASSERT_FALSE(answer.status.ok());
    ASSERT_EQ(answer.effects.events.size(), 1U);
    EXPECT_NE(answer.effects.events[0].text.find(answer.status.error().message), std::string::npos);
    EXPECT_TRUE(answer.effects.messages.empty());
    EXPECT_EQ(answer.memory.status.state, before.status.state);
  }
}

/// A list that forgets its oldest half is no new list.
TEST(MissionEvents, KeepTheirNumbersWhenTheOldestAreForgotten) {
  Mission mission({.events_before = 5});
  for (int i = 0; i < 20'001; ++i) {
    mission.AddEvent({i}, EventKind::kState, "x");
  }
  EXPECT_EQ(mission.events().size(), 10'001u);
  EXPECT_EQ(mission.events().back().number, 20'006u);
  EXPECT_EQ(mission.events().front().number, 10'006u);
  EXPECT_EQ(mission.OptionsToGoOn().events_before, 20'006u);
  Mission next(mission.OptionsToGoOn());
  next.GoOnAfter(mission.events());
  next.AddEvent({7}, EventKind::kState, "y");
  EXPECT_EQ(next.events().back().number, 20'007u);
}

}  // namespace
}  // namespace palace
