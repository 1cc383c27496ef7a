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
  rig.navigation.gps.estimate.v_WB.z() = rig.navigation.vision.estimate.v_WB.z() = 0.42;
  ASSERT_TRUE(rig.RunUntil(MissionState::kLanded, 30)) << rig.mission.status().why;
  EXPECT_NEAR(*rig.mission.status().touchdown_miss_m, 0.5, 1e-9);
  EXPECT_EQ(rig.mission.status().touchdown_sink_mps, 0.42);
  EXPECT_GE(rig.mission.status().rechecks.size(), 8U);
  EXPECT_EQ(rig.SentCount<Approval>(), 1);
  EXPECT_EQ(rig.SentCount<HoldRequest>() + rig.SentCount<AbortRequest>(), 0);
  EXPECT_TRUE(rig.mission.status().alarms.empty());
}

// A wire 6 m up that stops a vehicle is no ground: it says that it stands, and hangs.
TEST(Mission, AVehicleThatHangsInAWireIsNotOnItsSiteAndMayBeWavedOff) {
  for (const bool hangs : {false, true}) {
    MissionRig rig;
    rig.Arm();
    ASSERT_TRUE(rig.ApproveNow().ok());
    ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
    rig.vehicle.height_m = hangs ? 6 : 0;
    rig.north_m += hangs ? 7 : 0;
    rig.vehicle.Set(VehicleMode::kLanded);
    rig.Step();
    ASSERT_EQ(rig.state(), MissionState::kLanded);
    const MissionStatus& status = rig.mission.status();
    EXPECT_EQ(status.why, hangs ? "Vehicle says it is on the ground, 6.5 m from the centre of site "
                                  "A and 6.0 m above it"
                                : "Vehicle is on the ground at site A");
    rig.Step();
    EXPECT_EQ(status.why_no_wave_off, hangs ? "" : "Vehicle on the ground");
    EXPECT_EQ(rig.Do(WaveOff{}).ok(), hangs);
    rig.Step();
    EXPECT_EQ(rig.SentCount<AbortRequest>(), hangs ? 1 : 0);
  }
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

// Another frame of positions: what won there won nothing here.
TEST(Mission, AProposalIsWonAnewWhenTheMapsBegunAnew) {
  MissionRig rig;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  rig.forgotten = true;
  rig.Step();
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  rig.Run(0.8);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  EXPECT_TRUE(rig.RunUntil(MissionState::kProposed, 1));
}

// A click on a site that is listed is never void because another one leads since a moment ago.
TEST(Mission, AProposalOutlivesAChangeOfTheBestSite) {
  MissionRig rig;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  for (int change = 0; change < 20; ++change) {
    std::swap(rig.sites[0], rig.sites[1]);
    rig.Run(change % 2 == 0 ? 0.1 : 0.5);
    ASSERT_EQ(rig.state(), MissionState::kProposed) << change;
    ASSERT_TRUE(rig.mission.status().MaySelect(rig.sites[1].id)) << change;
  }
  rig.sites.erase(rig.sites.begin());  // the leader is lost, another site stands
  rig.Run(0.5);
  EXPECT_EQ(rig.state(), MissionState::kProposed);
  EXPECT_TRUE(rig.Do(SelectSite{rig.sites[0].id}).ok());
}

// Its place on the newest map and what the maps say of it stay to be seen though no list has it.
TEST(Mission, AnArmedSiteIsToldWithItsPresentVerdict) {
  MissionRig rig;
  rig.Arm();
  const auto& status = rig.mission.status();
  ASSERT_TRUE(status.armed_now.has_value());
  EXPECT_EQ(status.armed_now->id, status.armed->id);
  EXPECT_EQ(status.armed_verdict, SiteVerdict::kHolds);
  rig.Site(101)->corridor_clear = false;
  rig.Run(0.5);
  EXPECT_EQ(rig.mission.status().armed_verdict, SiteVerdict::kDegraded);
  EXPECT_EQ(rig.mission.status().armed_why, "Something stands in the approach");
  bool told = false;
  for (const Alarm& alarm : rig.mission.status().alarms) {
    told = told || alarm.text ==
                       "Site A degraded: Something stands in the approach. "
                       "Look again before you approve.";
  }
  EXPECT_TRUE(told);
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
  rig.vehicle.refuses = true;  // it will not take it, nor say so
  ASSERT_TRUE(rig.ApproveNow().ok());
  rig.Run(29.5);
  EXPECT_EQ(rig.state(), MissionState::kApproved);
  EXPECT_GT(rig.SentCount<Approval>(), 10);  // the same message, repeated
  for (const VehicleMessage& message : rig.sent) {
    if (const auto* approval = std::get_if<Approval>(&message)) {
      EXPECT_EQ(approval->id, rig.mission.status().approval->id);
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

TEST(Mission, ProvisionalMustBeConfirmedBySixMetres) {
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
      EXPECT_NEAR(rig.mission.status().height_above_site_m, 6, 0.5);
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

/// Descends on vision to that height, where vision ends.
void LoseVisionAt(double height_m, MissionRig& rig) {
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  rig.navigation.handover = NavigationStatus::Handover::kVision;
  rig.navigation.vision.running = rig.navigation.vision.estimate.healthy = true;
  while (rig.vehicle.height_m > height_m) {
    rig.Step();
  }
  rig.navigation.vision.estimate.healthy = false;
}

TEST(Mission, VisionOutageHoldsHighAndClimbsLow) {
  for (const double height_m : {8.0, 2.5}) {
    MissionRig rig;
    ASSERT_NO_FATAL_FAILURE(LoseVisionAt(height_m, rig));
    rig.vehicle.Set(VehicleMode::kSettle);
    rig.Run(1.9);
    EXPECT_EQ(rig.state(), MissionState::kDescending);
    rig.Run(0.3);
    EXPECT_EQ(rig.state(), height_m > 3 ? MissionState::kHold : MissionState::kAborting);
  }
}

// The vehicle knows that it has no position, the station that the cameras are black.
TEST(Mission, AnAbortNamesWhatTheCamerasHaveAgainstIt) {
  for (const bool black : {false, true}) {
    MissionRig rig;
    ASSERT_NO_FATAL_FAILURE(LoseVisionAt(2.5, rig));
    rig.stereo.left_blank = rig.stereo.right_blank = black;
    rig.vehicle.Set(VehicleMode::kSettle);
    rig.Run(2.2);
    ASSERT_EQ(rig.state(), MissionState::kAborting);
    EXPECT_EQ(rig.mission.status().why, std::string("Vision lost for 2.1 s, limit 2.0 s") +
                                            (black ? " (both cameras show nothing)" : ""));
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
  EXPECT_GT(rig.mission.status().approval->id, old.id);
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

TEST(Mission, TellsWhoApproved) {
  for (const auto& [origin, who] : {std::pair{CommandOrigin::kOperator, "the operator"},
                                    std::pair{CommandOrigin::kScript, "a script"}}) {
    MissionRig rig;
    rig.Arm();
    ASSERT_TRUE(rig.ApproveNow(origin).ok());
    EXPECT_EQ(rig.mission.status().approved_by, who);
  }
}

}  // namespace
}  // namespace palace
