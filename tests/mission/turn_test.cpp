// The approach turned by hand: to a side that the maps call clear, shown anew before it is
// approved.
#include <cmath>

#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/mission/geometry.h"
#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

/// Site A, 10 m north and 2 m east of W, may be approached straight, from the east and from the
/// south-west. The vehicle hovers south of it.
struct TurnRig : MissionRig {
  TurnRig() {
    settings.mission.glide_slope_deg = 45;
    north_m = 1;
    Site(101)->clear_approaches = 1U << 2 | 1U << 5;
  }
  Status Turn(int side, CommandOrigin origin = CommandOrigin::kOperator) {
    return Do(TurnApproach{101, side}, origin);
  }
  const ApproachPlan& plan() const { return *mission.status().approach; }
};

TEST(TurnApproach, IsFlownAsItWasTurnedOnceItWasOnTheScreen) {
  TurnRig rig;
  EXPECT_TRUE(rig.mission.status().approach_sides.empty());
  rig.Arm();
  EXPECT_EQ(rig.mission.status().approach_sides, (std::vector<int>{2, kStraightApproach, 5}));
  ASSERT_FALSE(rig.plan().turned());
  const std::uint64_t before = rig.sequence;
  ASSERT_TRUE(rig.Turn(2).ok());
  EXPECT_EQ(rig.plan().side, 2);
  EXPECT_NEAR(WrapAngle(rig.plan().heading_rad - Rad(-90)), 0, 1e-12) << "from the east";
  EXPECT_FALSE(rig.mission.status().can_approve);
  EXPECT_FALSE(rig.Do(ApproveSite{101, before}).ok()) << "the straight one was on the screen";
  rig.Run(1.5);
  EXPECT_FALSE(rig.Do(ApproveSite{101, before}).ok());
  ASSERT_TRUE(rig.ApproveNow().ok()) << rig.mission.status().cannot_approve_reason;
  EXPECT_EQ(rig.mission.status().approval->approach_heading_rad, rig.plan().heading_rad);
  EXPECT_TRUE(rig.mission.status().approach_sides.empty());
  bool told = false;
  for (const Event& event : rig.mission.events()) {
    told = told || event.text == "Approach of site A turned by the operator: from the east";
  }
  EXPECT_TRUE(told);
}

TEST(TurnApproach, TheStationTurnsItIntoTheWindWhereThatIsClearAndSaysSo) {
  TurnRig rig;
  rig.vehicle.wind_mps = 7;
  rig.vehicle.wind_from_rad = Rad(-90);  // the way from the east goes west, into it
  rig.Arm();
  ASSERT_TRUE(rig.plan().turned());
  EXPECT_EQ(rig.plan().side, 2);
  EXPECT_EQ(rig.plan().why, "into the wind");
  ASSERT_TRUE(rig.mission.status().headings.has_value());
  const auto& headings = rig.mission.status().headings->headings;
  EXPECT_FALSE(headings[54].IsVetoed()) << "270 degrees, from the east";
  EXPECT_TRUE(headings[36].is_blocked) << "180 degrees, from the north";
  EXPECT_GT(headings[54].wind, headings[0].wind);
  TurnRig calm;
  calm.Arm();
  EXPECT_FALSE(calm.plan().turned());
  EXPECT_EQ(calm.plan().why, "");
}

/// The words of the caution that stands about the tailwind; empty: none does.
std::string TailwindTold(const MissionRig& rig) {
  for (const Alarm& alarm : rig.mission.status().alarms) {
    if (alarm.kind == AlarmId::kTailwind && alarm.active) {
      return alarm.text;
    }
  }
  return {};
}

// An approach stays as it was armed. The straight one goes to the north here.
TEST(TurnApproach, AWindThatTurnsIsToldWhileTheApproachIsAheadOrFlown) {
  TurnRig rig;
  rig.vehicle.wind_mps = 4;
  rig.vehicle.wind_from_rad = 0;
  rig.Arm();
  ASSERT_FALSE(rig.plan().turned());
  rig.Run(1.5);
  EXPECT_EQ(TailwindTold(rig), "");
  rig.vehicle.wind_from_rad = Rad(180);
  rig.Run(1.5);
  const double off_rad = rig.plan().heading_rad - rig.vehicle.wind_from_rad;
  const std::string told =
      WithNumbers("Tailwind %.1f m/s on the approach, limit 2.5 m/s. ", -4 * std::cos(off_rad));
  EXPECT_EQ(TailwindTold(rig), told + "Take another side or site, or wait.");
  ASSERT_TRUE(rig.ApproveNow().ok()) << "a caution: " << rig.mission.status().cannot_approve_reason;
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  EXPECT_EQ(TailwindTold(rig), told + "Watch the descent, hold or wave off.");
  ASSERT_TRUE(rig.Do(HoldHere{}).ok());
  rig.Run(1.5);
  EXPECT_EQ(TailwindTold(rig), "") << "nothing is flown with it any more";
}

// Neither of a light air, whose direction is noise, nor of a limit that keeps it.
TEST(TurnApproach, NoTailwindIsToldOfALightAirOrWithinTheLimit) {
  TurnRig rig;
  rig.vehicle.wind_from_rad = Rad(180);
  rig.settings.mission.max_tailwind_mps = 0.2;
  rig.vehicle.wind_mps = 0.4;
  rig.Arm();
  rig.Run(1.5);
  EXPECT_EQ(TailwindTold(rig), "");
  rig.vehicle.wind_mps = 0.6;
  rig.Run(1.5);
  EXPECT_NE(TailwindTold(rig), "");
  rig.settings.mission.max_tailwind_mps = 3;
  rig.Run(1.5);
  EXPECT_EQ(TailwindTold(rig), "");
}

// Drawn as it is flown: to where the slope begins, on the side that was chosen, then down.
TEST(TurnApproach, TheWayShownIsTheOneThatIsFlown) {
  TurnRig rig;
  EXPECT_TRUE(rig.mission.status().way_W.empty());
  rig.Site(101)->confirmed = false;
  rig.Site(101)->look_height_m = 12;
  rig.Arm();
  ASSERT_TRUE(rig.Turn(2).ok());
  rig.Run(1.5);
  const Eigen::Vector3d site(10, 2, 0);
  const std::vector<Eigen::Vector3d> turned = rig.mission.status().way_W;
  ASSERT_EQ(turned.size(), 3u);
  EXPECT_LT((turned[0] - rig.p_WB()).norm(), 0.01);
  EXPECT_NEAR(turned[1].z(), turned[0].z(), 1e-9) << "level";
  EXPECT_GT(turned[1].y(), site.y() + 10) << "from the east";
  EXPECT_NEAR(turned[1].x(), site.x(), 1e-9);
  EXPECT_LT((turned[2] - site).norm(), 1e-9);
  ASSERT_TRUE(rig.Do(LookAtSite{101, rig.sequence, 12}).ok());
  rig.Step();
  const std::vector<Eigen::Vector3d> look = rig.mission.status().way_W;
  ASSERT_EQ(look.size(), 3u);
  const FlightPath path = PathTo(rig.mission.memory(), *rig.mission.status().armed);
  EXPECT_NEAR(path.SkidHeight(look[2]), 12, 1e-6) << "it ends in the hover";
}

TEST(TurnApproach, GoesBackToTheStraightOne) {
  TurnRig rig;
  rig.Arm();
  const double straight_rad = rig.plan().heading_rad;
  ASSERT_TRUE(rig.Turn(5).ok());
  ASSERT_TRUE(rig.Turn(kStraightApproach).ok());
  EXPECT_NEAR(rig.plan().heading_rad, straight_rad, 1e-12);
  rig.Run(1.5);
  EXPECT_TRUE(rig.ApproveNow().ok()) << rig.mission.status().cannot_approve_reason;
}

// What was blocked when the site was selected is not offered: nobody judges it again.
TEST(TurnApproach, TheStraightOneIsOfferedOnlyWhereItWasClear) {
  TurnRig rig;
  rig.Site(101)->corridor_clear = false;
  rig.Arm();
  EXPECT_EQ(rig.plan().side, 5) << "the lesser turn";
  EXPECT_EQ(rig.mission.status().approach_sides, (std::vector<int>{2, 5}));
  EXPECT_FALSE(rig.Turn(kStraightApproach).ok());
  EXPECT_TRUE(rig.Turn(2).ok());
}

struct Refused {
  const char* name;
  std::uint64_t site_id;
  int side;
  CommandOrigin origin;
  bool arm;
  const char* why;
};
class TurnRefused : public testing::TestWithParam<Refused> {};

TEST_P(TurnRefused, LeavesThePlanAndSaysWhy) {
  const Refused& row = GetParam();
  TurnRig rig;
  if (row.arm) {
    rig.Arm();
  } else {
    ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  }
  const auto before = rig.mission.status().approach;
  const Status answer = rig.Do(TurnApproach{row.site_id, row.side}, row.origin);
  ASSERT_FALSE(answer.ok());
  EXPECT_EQ(answer.error().message.rfind(row.why, 0), 0u) << answer.error().message;
  EXPECT_EQ(rig.mission.status().approach.has_value(), before.has_value());
  if (before) {
    EXPECT_EQ(rig.plan().heading_rad, before->heading_rad);
    EXPECT_TRUE(rig.ApproveNow().ok());
  }
}

constexpr auto kOperator = CommandOrigin::kOperator;
INSTANTIATE_TEST_SUITE_P(
    , TurnRefused,
    testing::Values(Refused{"Blocked", 101, 0, kOperator, true, "No clear approach is known"},
                    Refused{"NoSide", 101, 8, kOperator, true, "No clear approach is known"},
                    Refused{"OtherSite", 102, 2, kOperator, true, "Selected is site A"},
                    Refused{"Unarmed", 101, 2, kOperator, false, "Select a site first"}),
    [](const auto& row) { return row.param.name; });

// A map must have judged the course: evidence on the screen is no evidence of another way.
TEST(TurnApproach, IsNotApprovedBeforeAMapHasJudgedIt) {
  TurnRig rig;
  rig.Arm();
  rig.maps_up = false;
  rig.Step();
  ASSERT_TRUE(rig.Turn(2).ok());
  rig.Run(1.5);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason, "No map has judged this approach yet");
  EXPECT_FALSE(rig.ApproveNow().ok());
  rig.maps_up = true;
  rig.Run(0.3);
  EXPECT_TRUE(rig.ApproveNow().ok()) << rig.mission.status().cannot_approve_reason;
}

// What the newest map calls blocked does not stand for the sector that it is in.
TEST(TurnApproach, AStraightOneThatIsBlockedNowIsNotOffered) {
  TurnRig rig;
  rig.Site(101)->clear_approaches = 1U << 2 | 1U << 4;
  rig.Arm();
  EXPECT_EQ(rig.mission.status().approach_sides, (std::vector<int>{2, kStraightApproach}));
  rig.Site(101)->corridor_clear = false;
  rig.Run(0.3);
  EXPECT_EQ(rig.mission.status().approach_sides, (std::vector<int>{2, 4}));
}

TEST(TurnApproach, AScriptMayOnlyOnASimulatedVehicle) {
  TurnRig rig;
  EXPECT_TRUE([&] {
    rig.Arm();
    return rig.Turn(2, CommandOrigin::kScript).ok();
  }());
  TurnRig live;
  live.source = SourceKind::kLive;
  live.simulated = false;
  live.authority = Commanding();
  live.Arm();
  EXPECT_FALSE(live.Turn(2, CommandOrigin::kScript).ok());
  EXPECT_TRUE(live.Turn(2).ok());
}

TEST(TurnApproach, BeforeItWasShownNothingElseIsSaidToBeMissing) {
  TurnRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.Turn(2).ok());
  const GuardResult* shown = FindGuard(rig.mission.status().guards, GuardId::kShown);
  ASSERT_NE(shown, nullptr);
  EXPECT_FALSE(shown->pass);
  EXPECT_EQ(shown->reason.rfind("Site on screen for 0.0 s", 0), 0u) << shown->reason;
}

// The newest map tells what is clear, not the one of the selection.
TEST(TurnApproach, FollowsTheNewestMap) {
  TurnRig rig;
  rig.Arm();
  rig.Site(101)->clear_approaches = 1U << 7;
  rig.Run(0.5);
  EXPECT_EQ(rig.mission.status().approach_sides, (std::vector<int>{kStraightApproach, 7}));
  EXPECT_FALSE(rig.Turn(2).ok());
  EXPECT_TRUE(rig.Turn(7).ok());
  rig.Site(101)->corridor_clear = false;  // as the maps judge it now
  rig.Run(1.5);
  EXPECT_FALSE(rig.mission.status().can_approve);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason, "Approach to site A is blocked");
}

TEST(TurnApproach, IsSetNotToggledAndNotOnTheWay) {
  TurnRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.Turn(2).ok());
  rig.Run(1.5);
  ASSERT_TRUE(rig.Turn(2).ok());
  EXPECT_TRUE(rig.mission.status().can_approve) << "nothing new is to be shown";
  ASSERT_TRUE(rig.ApproveNow().ok());
  EXPECT_FALSE(rig.Turn(5).ok());
  EXPECT_EQ(rig.plan().side, 2);
}

}  // namespace
}  // namespace palace
