// Sources and their time: jumps, replays, and what cannot be approved on.
#include <functional>

#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

TEST(Mission, AJumpInTimeRestartsAReplay) {
  MissionRig rig;
  rig.source = SourceKind::kReplay;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  ASSERT_TRUE(rig.Do(SelectSite{101}, CommandOrigin::kReplay).ok());
  rig.Run(1.5);
  ASSERT_TRUE(rig.ApproveNow(CommandOrigin::kReplay).ok());
  rig.now = {500'000'000};
  rig.jumped = true;
  rig.Step();
  EXPECT_FALSE(rig.mission.status().approval.has_value());
  EXPECT_FALSE(rig.mission.status().armed.has_value());
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed, 3));
  ASSERT_TRUE(rig.Do(SelectSite{101}, CommandOrigin::kReplay).ok());
  rig.Run(1.5);
  EXPECT_TRUE(rig.ApproveNow(CommandOrigin::kReplay).ok());
}

TEST(Mission, AJumpInTimeStopsALiveFlight) {
  for (const double jump_s : {-100.0, 100.0}) {
    SCOPED_TRACE(jump_s);
    const auto jump = [&](MissionRig& rig) {
      rig.now = AddSeconds(rig.now, jump_s);
      rig.jumped = true;
      rig.Step();
    };
    MissionRig armed;
    armed.Arm();
    jump(armed);
    EXPECT_FALSE(armed.mission.status().armed.has_value());
    EXPECT_FALSE(armed.mission.status().can_approve);

    MissionRig flying;
    flying.Arm();
    ASSERT_TRUE(flying.ApproveNow().ok());
    ASSERT_TRUE(flying.RunUntil(MissionState::kDescending, 5));
    jump(flying);
    EXPECT_EQ(flying.state(), MissionState::kHold);
    EXPECT_FALSE(flying.mission.status().approval.has_value());

    MissionRig aborting;
    aborting.Step();
    aborting.link_up = false;
    ASSERT_TRUE(aborting.Do(WaveOff{}).ok());
    jump(aborting);
    const int before = aborting.SentCount<AbortRequest>();
    ASSERT_TRUE(aborting.Do(AcknowledgeWaveOff{}).ok());
    aborting.Run(2);
    EXPECT_EQ(aborting.state(), MissionState::kAborting);
    EXPECT_GE(aborting.SentCount<AbortRequest>(), before + 3);  // still repeated
  }
}

TEST(Mission, SourcesThatCannotBeApprovedOn) {
  const std::pair<SourceKind, const char*> pictures[] = {
      {SourceKind::kImages, "No vehicle, pictures only"},
      {SourceKind::kCameras, "No vehicle, cameras only"},
      {SourceKind::kVideo, "No vehicle in a video"}};
  for (const auto& [kind, why] : pictures) {
    SCOPED_TRACE(why);
    MissionRig rig;
    rig.source = kind;
    ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
    const Status answer = rig.Do(SelectSite{101});
    ASSERT_FALSE(answer.ok());
    EXPECT_EQ(answer.error().message, why);
    EXPECT_EQ(rig.mission.status().cannot_approve_reason, why);
    EXPECT_FALSE(rig.Do(WaveOff{}).ok());
    EXPECT_TRUE(rig.sent.empty());
  }

  MissionRig live;
  live.source = SourceKind::kLive;
  live.simulated = false;
  ASSERT_TRUE(live.RunUntil(MissionState::kProposed));
  EXPECT_FALSE(live.Do(SelectSite{101}, CommandOrigin::kScript).ok());
  EXPECT_FALSE(live.Do(SelectSite{101}, CommandOrigin::kReplay).ok());
  EXPECT_TRUE(live.Do(SelectSite{101}).ok());
}

TEST(Mission, ReplayFollowsWithoutALinkAndSendsNothing) {
  MissionRig rig;
  rig.source = SourceKind::kReplay;
  rig.can_transmit = rig.recorder_ok = false;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  EXPECT_EQ(rig.Do(SelectSite{101}).error().message, "No link in replay");
  ASSERT_TRUE(rig.Do(SelectSite{101}, CommandOrigin::kReplay).ok());
  rig.Run(1.5);
  EXPECT_FALSE(rig.mission.status().can_approve);
  ASSERT_TRUE(rig.ApproveNow(CommandOrigin::kReplay).ok());
  const Approval approval = *rig.mission.status().approval;
  // The log's vehicle answers under another session's number.
  rig.vehicle.approval_id = (std::uint64_t{0xabc} << 32) | (approval.id & 0xffffffff);
  rig.vehicle.acks.push_back({rig.now, rig.vehicle.approval_id, AckResult::kAccepted, ""});
  rig.vehicle.Set(VehicleMode::kAlign);
  ASSERT_TRUE(rig.RunUntil(MissionState::kLanded, 40)) << rig.mission.status().why;
  EXPECT_TRUE(rig.sent.empty());
}

}  // namespace
}  // namespace palace
