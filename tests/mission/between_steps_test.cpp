// What is published after a command and before the next step: of the new state, not of the old one.
#include "engine/mission/wording.h"
#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

TEST(BetweenSteps, ASelectionIsToldWithItsOwnFiguresAndGuards) {
  MissionRig rig;
  rig.Arm(101);
  ASSERT_TRUE(rig.mission.status().can_approve) << rig.mission.status().cannot_approve_reason;
  const double of_a_m = rig.mission.status().distance_to_site_m;
  ASSERT_TRUE(rig.Do(SelectSite{102}).ok());
  const MissionStatus& status = rig.mission.status();
  const Eigen::Vector2d to_b = (rig.Site(102)->p_WS - rig.p_WB()).head<2>();
  EXPECT_NEAR(status.distance_to_site_m, to_b.norm(), 1e-9);
  EXPECT_NE(status.distance_to_site_m, of_a_m);
  // B was on no screen yet, and no map was asked about it.
  EXPECT_FALSE(status.can_approve);
  EXPECT_FALSE(FindGuard(status.guards, GuardId::kSite)->pass);
  EXPECT_FALSE(status.cannot_approve_reason.empty());
}

TEST(BetweenSteps, AfterADisarmNothingMayBeApproved) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.mission.status().can_approve);
  ASSERT_NE(FindLimit(rig.mission.status().limits, LimitId::kSlope), nullptr);
  ASSERT_TRUE(rig.Do(DisarmSite{}).ok());
  EXPECT_EQ(rig.state(), MissionState::kProposed);
  EXPECT_FALSE(rig.mission.status().can_approve);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason, words::kSelectFirst);
  EXPECT_EQ(FindLimit(rig.mission.status().limits, LimitId::kSlope), nullptr);
}

// What stands against any site is said before that none is selected.
TEST(BetweenSteps, WithoutASelectionApproveSaysWhatWouldStopItWithOne) {
  MissionRig rig;
  rig.Run(3);
  ASSERT_EQ(rig.state(), MissionState::kProposed);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason, words::kSelectFirst);
  rig.cameras_up = false;
  rig.Run(1.5);
  ASSERT_FALSE(rig.mission.status().armed);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason.rfind("Left camera ", 0), 0U)
      << rig.mission.status().cannot_approve_reason;
}

TEST(BetweenSteps, AppliedLimitsEndTheSelectionAtOnce) {
  MissionRig rig;
  rig.Arm();
  rig.mission.DropApproval("limits applied");
  EXPECT_EQ(rig.state(), MissionState::kProposed);
  EXPECT_FALSE(rig.mission.status().can_approve);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason, words::kSelectFirst);
}

TEST(BetweenSteps, AnAcknowledgedAlarmIsShownSo) {
  MissionRig rig;
  rig.recorder_ok = false;
  rig.Arm();
  ASSERT_TRUE(rig.Do(AcknowledgeAlarm{"recorder"}).ok());
  for (const Alarm& alarm : rig.mission.status().alarms) {
    EXPECT_TRUE(alarm.kind != AlarmId::kRecorder || alarm.acknowledged);
  }
  EXPECT_TRUE(rig.mission.status().can_approve);
}

// The state and its alarm agree from the press on, not a step later.
TEST(BetweenSteps, AWaveOffAndAHoldAreToldAtOnce) {
  for (const bool wave_off : {true, false}) {
    MissionRig rig;
    rig.Arm();
    ASSERT_TRUE(rig.ApproveNow().ok());
    ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
    ASSERT_TRUE(rig.Do(wave_off ? CommandAction(WaveOff{}) : CommandAction(HoldHere{})).ok());
    ASSERT_FALSE(rig.mission.status().alarms.empty());
    EXPECT_EQ(rig.mission.status().alarms[0].kind, wave_off ? AlarmId::kWaveOff : AlarmId::kHold);
    const auto raised = [&] {
      return std::count_if(rig.mission.events().begin(), rig.mission.events().end(),
                           [](const Event& event) { return event.kind == EventKind::kAlarm; });
    };
    const auto before = raised();
    rig.Step();
    EXPECT_EQ(raised(), before) << "told twice";
  }
}

TEST(BetweenSteps, TheAnswerIsWaitedForInSeconds) {
  MissionRig rig;
  rig.vehicle.answers = false;
  rig.Arm();
  rig.link_up = false;  // nor does it fly it
  ASSERT_TRUE(rig.ApproveNow().ok());
  EXPECT_EQ(rig.mission.status().approval_answer_s, 0);
  for (int i = 1; i <= 5; ++i) {
    rig.Step();
    EXPECT_EQ(rig.mission.status().approval_phase, MissionStatus::ApprovalPhase::kSent);
    EXPECT_NEAR(rig.mission.status().approval_answer_s, 0.1 * i, 1e-6);
  }
}

// Commands that come with the first bundle find no step before them.
TEST(BetweenSteps, FirstCommandsAreJudgedByTheirSession) {
  struct Row {
    SourceKind source;
    CommandOrigin origin;
    CommandAction action;
    bool obeyed;
    std::string why;
  };
  const Row rows[] = {
      {SourceKind::kReplay, CommandOrigin::kReplay, AddBookmark{"note"}, true, ""},
      {SourceKind::kLive, CommandOrigin::kReplay, AddBookmark{"note"}, false, words::kRecordedOnly},
      {SourceKind::kImages, CommandOrigin::kOperator, SelectSite{101}, false,
       WhyNoVehicle(SourceKind::kImages)},
      {SourceKind::kReplay, CommandOrigin::kOperator, WaveOff{}, false,
       WhyNoVehicle(SourceKind::kReplay)},
      {SourceKind::kLive, CommandOrigin::kOperator, WaveOff{}, true, ""},
  };
  for (const Row& row : rows) {
    MissionRig rig;
    rig.source = row.source;
    const Status done = rig.Do(row.action, row.origin);
    EXPECT_EQ(done.ok(), row.obeyed) << static_cast<int>(row.source);
    if (!done) {
      EXPECT_EQ(done.error().message, row.why);
    }
  }
}

// Between two measured pairs the last verdict is only repeated: it counts once.
TEST(BetweenSteps, PicturesAreJudgedOncePerPair) {
  MissionRig rig;
  rig.Run(1);
  rig.stereo.row_error_px = 0.8;
  for (int pair = 1; pair <= 3; ++pair) {
    for (int step = 0; step < 3; ++step) {
      rig.Wait();
      MissionInputs in = rig.Inputs();
      in.navigation.new_stereo = step == 0;
      rig.mission.Update(in);
      EXPECT_EQ(FindGuard(rig.mission.status().guards, GuardId::kCameras)->pass, pair < 3)
          << "pair " << pair << ", step " << step;
    }
  }
}

}  // namespace
}  // namespace palace
