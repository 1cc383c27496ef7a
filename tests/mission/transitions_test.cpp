// The state machine, transition by transition, against a small vehicle.
#include <functional>

#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

using Phase = MissionStatus::ApprovalPhase;

TEST(Mission, WholeFlight) {
  MissionRig rig;
  EXPECT_EQ(rig.state(), MissionState::kNoLive);
  rig.Step();
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed, 2));
  rig.Arm();
  EXPECT_TRUE(rig.mission.WantsTracking());
  EXPECT_TRUE(rig.mission.SettingsFrozen());
  ASSERT_TRUE(rig.mission.status().can_approve) << rig.mission.status().cannot_approve_reason;
  EXPECT_EQ(rig.mission.status().guards.size(), 15U);
  ASSERT_TRUE(rig.ApproveNow().ok());
  EXPECT_EQ(rig.state(), MissionState::kApproved);
  EXPECT_FALSE(rig.mission.VisionAllowed());
  rig.Run(0.3);
  EXPECT_EQ(rig.mission.status().approval_phase, Phase::kAccepted);
  EXPECT_NEAR(rig.mission.status().approval_answer_s, 0.1, 1e-9);
  EXPECT_TRUE(rig.mission.VisionAllowed());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  ASSERT_TRUE(rig.RunUntil(MissionState::kLanded, 30)) << rig.mission.status().why;
  EXPECT_NEAR(*rig.mission.status().touchdown_miss_m, 0.5, 1e-9);
  EXPECT_GE(rig.mission.status().rechecks.size(), 8U);
  EXPECT_EQ(rig.SentCount<Approval>(), 1);
  EXPECT_EQ(rig.SentCount<HoldRequest>() + rig.SentCount<AbortRequest>(), 0);
  EXPECT_TRUE(rig.mission.status().alarms.empty());
}

TEST(Mission, SaysWhoMaySelectWhichSite) {
  MissionRig rig;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  EXPECT_TRUE(rig.mission.status().MaySelect(101));
  ASSERT_TRUE(rig.Do(RefuseSite{101}).ok());
  rig.sites.pop_back();  // the other is gone: back to searching
  ASSERT_TRUE(rig.RunUntil(MissionState::kSearch));
  EXPECT_TRUE(rig.mission.status().MaySelect(101));  // a second look
  EXPECT_FALSE(rig.mission.status().MaySelect(102));
  rig.source = SourceKind::kReplay;
  rig.Step();
  EXPECT_FALSE(rig.mission.status().MaySelect(101));
}

TEST(Mission, EvidenceIsFrozenWithTheLimitsItWasArmedUnder) {
  MissionRig rig;
  rig.decision.settings.limits.max_slope_deg = 7;
  rig.Arm();
  rig.decision.settings.limits.max_slope_deg = 3;  // of later maps
  rig.settings.slad.limits.max_slope_deg = 3;
  rig.Run(0.3);
  const LimitRow* slope = FindLimit(rig.mission.status().armed_limits, LimitId::kSlope);
  ASSERT_NE(slope, nullptr);
  EXPECT_NEAR(slope->limit, Rad(7), 1e-12);
  ASSERT_TRUE(rig.Do(DisarmSite{}).ok());
  EXPECT_TRUE(rig.mission.status().armed_limits.empty());
}

TEST(Mission, AppliedLimitsDropWhatIsNotYetFlown) {
  MissionRig rig;
  EXPECT_FALSE(rig.mission.DropsWithSettings());
  rig.Arm();
  EXPECT_TRUE(rig.mission.DropsWithSettings());
  ASSERT_TRUE(rig.ApproveNow().ok());
  EXPECT_TRUE(rig.mission.DropsWithSettings());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  ASSERT_TRUE(rig.Do(HoldHere{}).ok());
  ASSERT_EQ(rig.state(), MissionState::kHold);
  EXPECT_FALSE(rig.mission.DropsWithSettings());
  rig.mission.DropApproval("limits applied");
  EXPECT_EQ(rig.state(), MissionState::kHold);
}

TEST(Mission, ProposesOnlyAfterThreeMapsAndOneSecond) {
  MissionRig rig;
  rig.Run(0.9);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  std::swap(rig.sites[0], rig.sites[1]);  // another winner: the run of wins starts again
  rig.Run(0.9);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  rig.Run(0.4);
  EXPECT_EQ(rig.state(), MissionState::kProposed);
  rig.sites.clear();
  rig.Step();
  EXPECT_EQ(rig.state(), MissionState::kSearch);
}

TEST(Mission, ArmWindowEndsAfterSixtySeconds) {
  MissionRig rig;
  rig.Arm();
  rig.Run(58);
  EXPECT_EQ(rig.state(), MissionState::kArmed);
  rig.Run(1);
  EXPECT_EQ(rig.state(), MissionState::kProposed);
  EXPECT_FALSE(rig.mission.status().armed.has_value());
}

TEST(Mission, ApprovalExpiresUnlessDescentBegan) {
  MissionRig rig;
  rig.Arm();
  rig.vehicle.answers = false;
  rig.vehicle.public_key = ApprovalSigner::FromSeed(99).public_key();  // it will not take it
  ASSERT_TRUE(rig.ApproveNow().ok());
  rig.Run(29.5);
  EXPECT_EQ(rig.state(), MissionState::kApproved);
  EXPECT_GT(rig.SentCount<Approval>(), 10);  // the same message, repeated
  for (const VehicleMessage& message : rig.sent) {
    if (const auto* approval = std::get_if<Approval>(&message)) {
      EXPECT_EQ(approval->counter, 1U);
    }
  }
  rig.Run(1);
  EXPECT_NE(rig.state(), MissionState::kApproved);
  EXPECT_FALSE(rig.mission.status().approval.has_value());
  rig.Run(0.2);
  EXPECT_GE(rig.SentCount<HoldRequest>(), 1);  // withdrawn at the vehicle too
}

TEST(Mission, VehicleRefusalIsShownAndLeavesNoApproval) {
  MissionRig rig;
  rig.Arm();
  rig.vehicle.refuses = true;
  ASSERT_TRUE(rig.ApproveNow().ok());
  rig.Run(0.3);
  EXPECT_EQ(rig.state(), MissionState::kProposed);
  EXPECT_EQ(rig.mission.status().approval_phase, Phase::kRefused);
  EXPECT_EQ(rig.mission.status().approval_answer, "Fuel low");
  ASSERT_FALSE(rig.mission.status().alarms.empty());
  EXPECT_EQ(rig.mission.status().alarms[0].text,
            "Vehicle refused site A: Fuel low. Select a site again.");
  EXPECT_EQ(rig.SentCount<HoldRequest>(), 0);
}

struct Fault {
  const char* name;
  std::function<void(MissionRig&)> inject;
  double within_s;  ///< a descent must hold by then
};

class DescentFaults : public testing::TestWithParam<Fault> {};

TEST_P(DescentFaults, HoldsInTime) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  rig.Run(1);
  GetParam().inject(rig);
  ASSERT_TRUE(rig.RunUntil(MissionState::kHold, GetParam().within_s)) << rig.mission.status().why;
  EXPECT_FALSE(rig.mission.status().approval.has_value());
  rig.link_up = true;
  rig.Run(1);
  EXPECT_GE(rig.SentCount<HoldRequest>(), 1);
  EXPECT_FALSE(rig.ApproveNow().ok());
}

INSTANTIATE_TEST_SUITE_P(
    , DescentFaults,
    testing::Values(
        Fault{"SiteOverALimit", [](MissionRig& r) { r.site_slope_rad = Rad(12); }, 0.5},
        Fault{"SiteOffTheMap", [](MissionRig& r) { r.sites.erase(r.sites.begin()); }, 0.5},
        Fault{"CamerasStop", [](MissionRig& r) { r.cameras_up = false; }, 1.3},
        Fault{"PoseStops", [](MissionRig& r) { r.pose_up = false; }, 1.3},
        Fault{"MapsStop", [](MissionRig& r) { r.maps_up = false; }, 3.3},
        Fault{"LinkStops", [](MissionRig& r) { r.link_up = false; }, 5.3},
        Fault{"VehicleRestarts", [](MissionRig& r) { r.vehicle.boot_id = 78; }, 0.3},
        Fault{"VehicleHolds", [](MissionRig& r) { r.vehicle.Set(VehicleMode::kHold); }, 0.3},
        Fault{"Operator", [](MissionRig& r) { EXPECT_TRUE(r.Do(HoldHere{}).ok()); }, 0.1}),
    [](const auto& row) { return row.param.name; });

class ArmedFaults : public testing::TestWithParam<Fault> {};

TEST_P(ArmedFaults, DropsTheSelectionAndTheApproval) {
  for (const bool approve : {false, true}) {
    SCOPED_TRACE(approve ? "approved" : "armed");
    MissionRig rig;
    rig.Arm();
    if (approve) {
      ASSERT_TRUE(rig.ApproveNow().ok());
    }
    GetParam().inject(rig);
    rig.Run(GetParam().within_s);
    EXPECT_NE(rig.state(), MissionState::kArmed);
    EXPECT_NE(rig.state(), MissionState::kApproved);
    EXPECT_NE(rig.state(), MissionState::kDescending);
    EXPECT_FALSE(rig.mission.status().approval.has_value());
    EXPECT_FALSE(rig.mission.status().can_approve);
  }
}

INSTANTIATE_TEST_SUITE_P(
    , ArmedFaults,
    testing::Values(Fault{"SiteOverALimit", [](MissionRig& r) { r.site_slope_rad = Rad(12); }, 0.5},
                    Fault{"LimitsChanged", [](MissionRig& r) { r.settings_hash ^= 1; }, 0.1},
                    Fault{"CalibrationChanged", [](MissionRig& r) { r.calibration_hash ^= 1; },
                          0.1},
                    Fault{"VehicleRestarts", [](MissionRig& r) { r.vehicle.boot_id = 78; }, 0.1},
                    Fault{"ClockSteps", [](MissionRig& r) { r.clock_offset_us += 3'000'000; }, 0.1},
                    Fault{"SettingsApplied",
                          [](MissionRig& r) { r.mission.DropApproval("Limits applied"); }, 0.1}),
    [](const auto& row) { return row.param.name; });

struct Block {
  const char* name;
  GuardId guard;
  std::function<void(MissionRig&)> inject;
  double run_s;
};

class Guards : public testing::TestWithParam<Block> {};

TEST_P(Guards, BlockApprovalAndNameTheReason) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.mission.status().can_approve);
  GetParam().inject(rig);
  rig.Run(GetParam().run_s);
  const auto& status = rig.mission.status();
  EXPECT_FALSE(status.can_approve);
  const GuardResult* guard = FindGuard(status.guards, GetParam().guard);
  ASSERT_NE(guard, nullptr);
  EXPECT_FALSE(guard->pass) << status.cannot_approve_reason;
  EXPECT_FALSE(guard->reason.empty());
  const std::size_t events_before = rig.mission.events().size();
  const Status answer = rig.ApproveNow();
  ASSERT_FALSE(answer.ok());
  EXPECT_FALSE(answer.error().message.empty());
  EXPECT_GT(rig.mission.events().size(), events_before);
  EXPECT_EQ(rig.SentCount<Approval>(), 0);
}

INSTANTIATE_TEST_SUITE_P(
    , Guards,
    testing::Values(
        Block{"Link", GuardId::kLink, [](MissionRig& r) { r.link_up = false; }, 1.2},
        Block{"Pose", GuardId::kAttitude, [](MissionRig& r) { r.pose_up = false; }, 0.4},
        Block{"Cameras", GuardId::kCameras, [](MissionRig& r) { r.cameras_up = false; }, 0.7},
        Block{"FrozenCamera", GuardId::kCameras,
              [](MissionRig& r) { r.stereo.suspect_frozen = true; }, 0.7},
        Block{"SwappedCameras", GuardId::kCameras,
              [](MissionRig& r) { r.stereo.suspect_swapped = true; }, 0.7},
        Block{"RowsApart", GuardId::kCameras, [](MissionRig& r) { r.stereo.row_error_px = 0.8; },
              0.7},
        Block{"LeftChannel", GuardId::kCameras, [](MissionRig& r) { r.channels[0].age_s = 1.8; },
              0.1},
        Block{"LeftChannelUnlisted", GuardId::kCameras,
              [](MissionRig& r) { r.channels.erase(r.channels.begin()); }, 0.1},
        Block{"RightChannelUnlisted", GuardId::kCameras,
              [](MissionRig& r) { r.channels.erase(r.channels.begin() + 1); }, 0.1},
        Block{"PoseChannelUnlisted", GuardId::kAttitude,
              [](MissionRig& r) { r.channels.pop_back(); }, 0.1},
        Block{"NoChannelListed", GuardId::kCameras, [](MissionRig& r) { r.channels.clear(); }, 0.1},
        Block{"RightChannelNever", GuardId::kCameras,
              [](MissionRig& r) { r.channels[1].state = ChannelHealth::State::kNever; }, 0.1},
        Block{"Map", GuardId::kMap, [](MissionRig& r) { r.maps_up = false; }, 2.3},
        Block{"Position", GuardId::kPosition,
              [](MissionRig& r) { r.navigation.gps.estimate.healthy = false; }, 0.1},
        Block{"Tracker", GuardId::kPosition, [](MissionRig& r) { r.tracker_locks = false; }, 0.1},
        Block{"Coherence", GuardId::kPosition, [](MissionRig& r) { r.tracker.coherence = 0.3; },
              0.1},
        Block{"CoherenceUnknown", GuardId::kPosition,
              [](MissionRig& r) { r.tracker.coherence = NAN; }, 0.1},
        Block{"Site", GuardId::kSite, [](MissionRig& r) { r.site_slope_rad = Rad(12); }, 0.1},
        Block{"NoLink", GuardId::kAuthority, [](MissionRig& r) { r.can_transmit = false; }, 0.1},
        Block{"Recorder", GuardId::kRecorder, [](MissionRig& r) { r.recorder_ok = false; }, 0.1},
        Block{"Unlabelled", GuardId::kSource, [](MissionRig& r) { r.simulated = false; }, 0.1}),
    [](const auto& row) { return row.param.name; });

TEST(Mission, RecorderLossMayBeAcknowledged) {
  MissionRig rig;
  rig.recorder_ok = false;
  rig.Arm();
  EXPECT_FALSE(rig.mission.status().can_approve);
  ASSERT_TRUE(rig.Do(AcknowledgeAlarm{"recorder"}).ok());
  rig.Step();
  EXPECT_TRUE(rig.mission.status().can_approve) << rig.mission.status().cannot_approve_reason;
}

TEST(Mission, EvidenceMustHaveBeenOnScreen) {
  MissionRig rig;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  const std::uint64_t before = rig.sequence;
  ASSERT_TRUE(rig.Do(SelectSite{101}).ok());
  rig.Run(0.8);
  EXPECT_FALSE(rig.ApproveNow().ok());  // not for 1.0 s yet
  rig.Run(0.7);
  EXPECT_FALSE(rig.Do(ApproveSite{101, before}).ok());               // looked before arming
  EXPECT_FALSE(rig.Do(ApproveSite{101, rig.sequence + 1000}).ok());  // never shown
  EXPECT_FALSE(rig.Do(ApproveSite{102, rig.sequence}).ok());         // not the armed one
  EXPECT_TRUE(rig.Do(ApproveSite{101, rig.sequence}).ok());
  EXPECT_FALSE(rig.Do(ApproveSite{101, rig.sequence}).ok());  // once only (I8)
}

TEST(Mission, ProvisionalMustBeConfirmedByTenMetres) {
  for (const bool confirm : {false, true}) {
    MissionRig rig;
    rig.sites[0].confirmed = false;
    rig.Arm();
    ASSERT_TRUE(rig.ApproveNow().ok());
    EXPECT_TRUE(rig.mission.status().approval->provisional);
    ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
    rig.sites[0].confirmed = confirm;
    const MissionState end = confirm ? MissionState::kLanded : MissionState::kHold;
    ASSERT_TRUE(rig.RunUntil(end, 30)) << rig.mission.status().why;
    if (!confirm) {
      EXPECT_NEAR(rig.mission.status().height_above_site_m, 10, 0.5);
    }
  }
}

TEST(Mission, BelowCommitHeightTheLastVerdictStands) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  while (rig.vehicle.height_m > 2.9) {
    rig.Step();
  }
  rig.site_slope_rad = Rad(14);
  rig.cameras_up = false;
  EXPECT_TRUE(rig.RunUntil(MissionState::kLanded, 10)) << rig.mission.status().why;
}

TEST(Mission, VisionOutageHoldsHighAndClimbsLow) {
  for (const double height_m : {8.0, 2.5}) {
    MissionRig rig;
    rig.Arm();
    ASSERT_TRUE(rig.ApproveNow().ok());
    ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
    rig.navigation.handover = NavigationStatus::Handover::kVision;
    rig.navigation.vision.running = rig.navigation.vision.estimate.healthy = true;
    while (rig.vehicle.height_m > height_m) {
      rig.Step();
    }
    rig.navigation.vision.estimate.healthy = false;
    rig.vehicle.Set(VehicleMode::kSettle);
    rig.Run(1.9);
    EXPECT_EQ(rig.state(), MissionState::kDescending);
    rig.Run(0.3);
    EXPECT_EQ(rig.state(), height_m > 3 ? MissionState::kHold : MissionState::kAborting);
  }
}

TEST(Mission, HoldLeadsToANewProposalNeverToTheOldApproval) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  const Approval old = *rig.mission.status().approval;
  ASSERT_TRUE(rig.Do(HoldHere{}).ok());
  rig.Run(2);
  EXPECT_EQ(rig.state(), MissionState::kHold);
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed, 5));
  rig.vehicle.approval_id = old.id;  // a vehicle that resumes by itself is stopped again
  rig.vehicle.Set(VehicleMode::kDescend);
  rig.Step();
  EXPECT_EQ(rig.state(), MissionState::kHold);
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed, 10));
  rig.Arm(102);
  ASSERT_TRUE(rig.ApproveNow().ok());
  EXPECT_GT(rig.mission.status().approval->counter, old.counter);
}

TEST(Mission, WaveOffNeedsVehicleAndOperator) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  ASSERT_TRUE(rig.Do(WaveOff{}).ok());
  EXPECT_EQ(rig.state(), MissionState::kAborting);
  EXPECT_FALSE(rig.mission.status().approval.has_value());
  ASSERT_TRUE(rig.Do(AcknowledgeWaveOff{}).ok());
  rig.Run(2);
  EXPECT_EQ(rig.state(), MissionState::kAborting);  // still climbing
  ASSERT_TRUE(rig.RunUntil(MissionState::kSearch, 3));
  EXPECT_EQ(rig.vehicle.mode, VehicleMode::kHover);
  EXPECT_GE(rig.SentCount<AbortRequest>(), 1);
}

TEST(Mission, RefusingASiteProposesTheNext) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.Do(RefuseSite{101}).ok());
  rig.Step();
  EXPECT_FALSE(rig.mission.status().armed.has_value());
  ASSERT_TRUE(rig.RunUntil(MissionState::kSearch, 1));
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed, 3));
  EXPECT_EQ(rig.mission.status().why.substr(0, 6), "Site B");
  ASSERT_TRUE(rig.Do(RefuseSite{102}).ok());
  rig.Run(2);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  EXPECT_TRUE(rig.Do(SelectSite{101}).ok());  // on second thoughts
}

/// Texts of the events since `from`.
std::string EventsSince(const MissionRig& rig, std::size_t from) {
  std::string text;
  for (std::size_t i = from; i < rig.mission.events().size(); ++i) {
    text += rig.mission.events()[i].text + "\n";
  }
  return text;
}

TEST(Mission, ARefusedSiteStaysRefusedWhileItsLetterLives) {
  MissionRig rig;
  rig.Arm();
  const std::size_t before = rig.mission.events().size();
  ASSERT_TRUE(rig.Do(RefuseSite{101}).ok());
  rig.Step();
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  EXPECT_EQ(rig.mission.status().why, "Site A refused, next is B");
  EXPECT_EQ(EventsSince(rig, before),
            "Site A refused by the operator\nSEARCH: Site A refused, next is B\n");
  EXPECT_TRUE(rig.mission.status().IsRefused(101));
  EXPECT_EQ(rig.mission.status().BestStanding(rig.sites)->id, 102U);
  EXPECT_NEAR(rig.mission.status().distance_to_site_m, std::hypot(15.5, 6), 1e-9);  // to B
  ++rig.settings_hash;  // a moved limit is no change of mind
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed, 3));
  EXPECT_EQ(rig.mission.status().why.substr(0, 6), "Site B");
  ASSERT_TRUE(rig.Do(WaveOff{}).ok());
  ASSERT_TRUE(rig.Do(AcknowledgeWaveOff{}).ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed, 20));
  EXPECT_EQ(rig.mission.status().why.substr(0, 6), "Site B");
  EXPECT_TRUE(rig.mission.status().IsRefused(101));
}

TEST(Mission, ASecondLookAtARefusedSiteIsNoProposal) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.Do(RefuseSite{101}).ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed, 3));
  ASSERT_TRUE(rig.Do(RefuseSite{102}).ok());
  rig.Run(1);
  EXPECT_EQ(rig.mission.status().why, "Site B refused, no other site");
  ASSERT_TRUE(rig.Do(SelectSite{101}).ok());
  ASSERT_TRUE(rig.Do(DisarmSite{}).ok());
  rig.Run(3);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  EXPECT_EQ(rig.mission.status().why, "Every site on the newest map is refused");
  ASSERT_TRUE(rig.Do(SelectSite{101}).ok());
  rig.Run(1.5);
  ASSERT_TRUE(rig.ApproveNow().ok());
  EXPECT_FALSE(rig.mission.status().IsRefused(101));  // approved: taken back
  EXPECT_TRUE(rig.mission.status().IsRefused(102));
}

TEST(Mission, WithoutASelectionNoCheckClaimsAChange) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.Do(RefuseSite{101}).ok());
  rig.Step();
  ASSERT_FALSE(rig.mission.status().armed.has_value());
  for (const GuardResult& guard : rig.mission.status().guards) {
    EXPECT_TRUE(guard.pass || guard.reason == "Select a site first")
        << GuardName(guard.id) << " " << guard.reason;
  }
  EXPECT_FALSE(rig.mission.status().can_approve);
}

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
      {SourceKind::kImages, "No vehicle in a picture folder"},
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
  EXPECT_TRUE(approval.signature.empty());
  // The log's vehicle answers under another session's number.
  rig.vehicle.approval_id = (std::uint64_t{0xabc} << 32) | (approval.id & 0xffffffff);
  rig.vehicle.acks.push_back({rig.now, rig.vehicle.approval_id, AckResult::kAccepted, ""});
  rig.vehicle.Set(VehicleMode::kAlign);
  ASSERT_TRUE(rig.RunUntil(MissionState::kLanded, 40)) << rig.mission.status().why;
  EXPECT_TRUE(rig.sent.empty());
}

}  // namespace
}  // namespace palace
