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
    return Do(LookAtSite{101, sequence, 12}, origin);
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
  EXPECT_NE(status.selection_ended.find(" m above it: not confirmed yet."), std::string::npos);
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  EXPECT_EQ(status.selection_ended.rfind("Site A was looked at from 1", 0), 0u)
      << "it stays to be read";
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

// One map in a few tells no height: a bump stands out, or the air there was not seen.
TEST(Look, IsOfferedFromWhereTheLastMapSaidThatSaidOne) {
  LookRig rig;
  rig.Site(101)->look_height_m = NAN;
  rig.Arm();
  const MissionStatus& status = rig.mission.status();
  EXPECT_FALSE(status.OffersLook());
  const struct {
    double map_says_m, offered_m;
  } rows[] = {{12, 12}, {12.8, 12}, {NAN, 12}, {9, 9}, {NAN, 9}, {12, 12}};
  for (const auto& row : rows) {
    rig.Site(101)->look_height_m = row.map_says_m;
    rig.Run(0.3);
    EXPECT_TRUE(status.OffersLook());
    EXPECT_EQ(status.look_from_m, row.offered_m);
    EXPECT_TRUE(std::isnan(status.armed->look_height_m)) << "evidence stays as it was selected";
  }
  EXPECT_FALSE(rig.Do(LookAtSite{101, rig.sequence, 9}).ok()) << "it says 12 m now";
  ASSERT_TRUE(rig.LookNow().ok());
  EXPECT_EQ(status.approval->stop_height_m, 12);
  LookRig other;
  other.Arm();
  ASSERT_TRUE(other.Do(DisarmSite{}).ok());
  EXPECT_TRUE(std::isnan(other.mission.status().look_from_m)) << "of no other site";
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
  EXPECT_FALSE(other.Do(LookAtSite{102, other.sequence, 12}).ok());
  EXPECT_FALSE(other.Do(LookAtSite{101, other.sequence + 1000, 12}).ok());  // never shown
  EXPECT_FALSE(other.Do(LookAtSite{101, other.sequence, 11}).ok());         // nor that height
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

TEST(Look, ThatIsStoppedWasNoDescentToTheSite) {
  LookRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.LookNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  rig.Site(101)->corridor_clear = false;
  ASSERT_TRUE(rig.RunUntil(MissionState::kHold, 2));
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed, 10));
  EXPECT_EQ(rig.mission.status().selection_ended,
            "Look at site A stopped: Something stands in the approach.");
}

struct Hover {
  const char* name;
  double height_m;
  void (*change)(MissionRig&);
  MissionState becomes;
};
class LookHover : public testing::TestWithParam<Hover> {};

// What hovers elsewhere, was restarted or still flies the approval did not look.
TEST_P(LookHover, IsTheEndOfALookOnlyWhereItWasToEnd) {
  LookRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.LookNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  rig.vehicle.approval_id = 0;
  rig.vehicle.height_m = GetParam().height_m;
  rig.vehicle.Set(VehicleMode::kHover);
  GetParam().change(rig);
  rig.Step();
  EXPECT_EQ(rig.state(), GetParam().becomes) << rig.mission.status().why;
}

INSTANTIATE_TEST_SUITE_P(
    , LookHover,
    testing::Values(Hover{"There", 12.9, [](MissionRig&) {}, MissionState::kSearch},
                    Hover{"TooHigh", 14, [](MissionRig&) {}, MissionState::kHold},
                    Hover{"TooLow", 10, [](MissionRig&) {}, MissionState::kHold},
                    Hover{"Restarted", 12, [](MissionRig& r) { r.vehicle.boot_id = 78; },
                          MissionState::kHold},
                    Hover{"StillApproved", 12,
                          [](MissionRig& r) { r.vehicle.approval_id = r.vehicle.accepted_id; },
                          MissionState::kHold}),
    [](const auto& row) { return row.param.name; });

// A vehicle that does not know of looks goes on: it is stopped, however sure the site is by now.
TEST(Look, AVehicleThatGoesOnIsHeld) {
  LookRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.LookNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  rig.vehicle.stop_height_m = 0;
  rig.Site(101)->confirmed = true;
  ASSERT_TRUE(rig.RunUntil(MissionState::kHold, 20));
  EXPECT_EQ(rig.mission.status().why, "Vehicle did not stop where the look was to end");
  EXPECT_GT(rig.vehicle.height_m, 9.5);
}

// The status was silent all the way: what is heard next is the hover.
TEST(Look, EndsAlsoWhereNothingWasHeardOfTheWay) {
  LookRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.LookNow().ok());
  ASSERT_EQ(rig.state(), MissionState::kApproved);
  rig.Step();
  rig.vehicle.height_m = 12.3;
  rig.vehicle.approval_id = 0;
  rig.vehicle.Set(VehicleMode::kHover);
  rig.Run(0.3);
  EXPECT_EQ(rig.state(), MissionState::kSearch) << rig.mission.status().why;
}

TEST(Look, IsNotOfferedWhereTheVehicleIsAsLowOrTheSiteIsSure) {
  LookRig low;
  low.vehicle.height_m = 13.9;
  low.Arm();
  EXPECT_FALSE(low.LookNow().ok());
  LookRig sure;
  sure.Arm();
  sure.Site(101)->confirmed = true;
  sure.Run(1);
  EXPECT_FALSE(sure.LookNow().ok());
}

// The commit height is that of a landing: a look that ends below it is stopped like one above.
TEST(Look, CommitsToNothingBelowTheCommitHeight) {
  LookRig rig;
  rig.settings.slad.fusion.commit_height_m = 18;
  rig.Arm();
  ASSERT_TRUE(rig.LookNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  rig.Run(1.2);
  ASSERT_LT(rig.vehicle.height_m, 18);
  rig.site_slope_rad = Rad(30);
  EXPECT_TRUE(rig.RunUntil(MissionState::kHold, 5)) << rig.mission.status().why;
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
