// A look: flown on one press under an approval's checks, over where it was to end, never a landing.
#include <cmath>

#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

/// Site A, not sure from here, would be from 12 m above it.
struct LookRig : MissionRig {
  LookRig() {
    Site(101)->confirmed = false;
    Site(101)->look_height_m = 12;
  }
  Status LookNow(CommandOrigin origin = CommandOrigin::kOperator) {
    return Do(LookAtSite{101, sequence}, origin);
  }
};

TEST(Look, EndsInSearchWhereTheVehicleHovers) {
  LookRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.LookNow().ok());
  const MissionStatus& status = rig.mission.status();
  ASSERT_EQ(rig.state(), MissionState::kApproved);
  EXPECT_EQ(status.approval->stop_height_m, 12);
  EXPECT_TRUE(status.approval->provisional);
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  EXPECT_GT(status.time_to_touchdown_s, 0);
  ASSERT_TRUE(rig.RunUntil(MissionState::kSearch));
  EXPECT_NEAR(rig.vehicle.height_m, 12, 0.5);
  EXPECT_EQ(status.why.rfind("Site A was looked at from 1", 0), 0u) << status.why;
  EXPECT_FALSE(status.approval || status.armed);
  EXPECT_EQ(rig.SentCount<HoldRequest>() + rig.SentCount<AbortRequest>(), 0);
  // What is seen from there is proposed, selected and approved like anything else.
  *rig.Site(101) = [&] {
    LandingSite site = *rig.Site(101);
    site.confirmed = true;
    site.look_height_m = NAN;
    return site;
  }();
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok()) << status.cannot_approve_reason;
  EXPECT_EQ(status.approval->stop_height_m, 0);
  EXPECT_TRUE(rig.RunUntil(MissionState::kLanded, 60));
}

TEST(Look, IsRefusedWhereAnApprovalIsAndWhereNoHeightIsKnown) {
  LookRig sure;
  sure.Site(101)->look_height_m = NAN;
  sure.Arm();
  const Status none = sure.LookNow();
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().message, "No height is known from which site A would be sure");
  LookRig unarmed;
  EXPECT_FALSE(unarmed.LookNow().ok());
  LookRig windy;
  windy.Arm();
  windy.vehicle.wind_mps = 30;
  windy.Run(3);
  EXPECT_FALSE(windy.LookNow().ok());
  EXPECT_EQ(windy.SentCount<Approval>(), 0);
  LookRig other;
  other.Arm();
  EXPECT_FALSE(other.Do(LookAtSite{102, other.sequence}).ok());
  EXPECT_FALSE(other.Do(LookAtSite{101, other.sequence + 1000}).ok());  // never shown
  EXPECT_TRUE(other.LookNow().ok());
  EXPECT_FALSE(other.LookNow().ok());
}

TEST(Look, IsHeldAndWavedOffLikeALanding) {
  for (const bool wave_off : {false, true}) {
    LookRig rig;
    rig.Arm();
    ASSERT_TRUE(rig.LookNow().ok());
    ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
    ASSERT_TRUE(rig.Do(wave_off ? CommandAction(WaveOff{}) : CommandAction(HoldHere{})).ok());
    EXPECT_EQ(rig.state(), wave_off ? MissionState::kAborting : MissionState::kHold);
    rig.Run(1);
    EXPECT_EQ(rig.vehicle.approval_id, 0u);
  }
}

// A vehicle that stops by itself on the way did not look.
TEST(Look, AHoverTooHighIsAHold) {
  LookRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.LookNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  ASSERT_GT(rig.vehicle.height_m, 14);
  rig.vehicle.approval_id = 0;
  rig.vehicle.Set(VehicleMode::kHover);
  rig.Step();
  EXPECT_EQ(rig.state(), MissionState::kHold);
}

TEST(Look, AScriptMayOnlyOnASimulatedVehicle) {
  LookRig rig;
  rig.source = SourceKind::kLive;
  rig.simulated = false;
  rig.authority = Commanding();
  rig.Arm();
  EXPECT_FALSE(rig.LookNow(CommandOrigin::kScript).ok());
  EXPECT_TRUE(rig.LookNow().ok());
}

}  // namespace
}  // namespace palace
