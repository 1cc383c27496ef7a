// The vehicle sent to another hover by the operator: when, how it is followed, and how it ends.
#include "engine/mission/going.h"

#include <cmath>

#include "tests/mission/hover_rig.h"

namespace palace {
namespace {

TEST(Going, IsSentFollowedAndOver) {
  HoverRig rig;
  ASSERT_EQ(rig.status().why_not_go, "");
  ASSERT_TRUE(rig.Fly({12, 0, -3}, Rad(90)).ok());
  EXPECT_EQ(rig.LastDecision(), "Sent 12.0 m north, 3.0 m up, to look along 090°, by the operator");
  EXPECT_EQ(rig.state(), MissionState::kSearch) << "what was proposed was seen from elsewhere";
  ASSERT_TRUE(rig.status().going.has_value());
  rig.Run(0.5);
  EXPECT_TRUE(rig.status().going->accepted);
  EXPECT_TRUE(rig.status().going->flown);
  EXPECT_EQ(rig.SentCount<GoRequest>(), 1) << "answered: not repeated";
  EXPECT_NEAR(rig.status().going->to_go_m, std::hypot(12, 3), 1e-6);
  ASSERT_EQ(rig.status().way_W.size(), 3u);
  EXPECT_NEAR((rig.status().way_W.back() - rig.status().going->p_WB).norm(), 0, 1e-9);
  rig.Run(3);
  EXPECT_FALSE(rig.status().going.has_value());
  EXPECT_EQ(rig.status().selection_ended, "Vehicle hovers where it was sent.");
  EXPECT_NEAR(rig.north_m, 21.5, 1e-9);
  EXPECT_TRUE(rig.RunUntil(MissionState::kProposed)) << "by maps from there";
}

TEST(Going, BearingsAreToldFrom000To359) {
  for (const auto& [heading_deg, told] : {std::pair{-0.3, "000°"},
                                          {359.7, "000°"},
                                          {45.2, "045°"},
                                          {-90.0, "270°"},
                                          {180.0, "180°"}}) {
    HoverRig rig;
    ASSERT_TRUE(rig.Fly({5, 0, 0}, Rad(heading_deg)).ok());
    EXPECT_NE(rig.LastDecision().find(std::string("along ") + told), std::string::npos)
        << rig.LastDecision();
  }
}

TEST(Going, IsRefusedWithTheReason) {
  struct Row {
    const char* why;
    Eigen::Vector3d way;
  };
  for (const Row& row :
       {Row{"61 m away, limit 60 m", {0, 61, 0}}, Row{"31 m up, limit 30 m", {0, 0, -31}},
        Row{"2.0 m lower: a way down is flown to a site", {3, 0, 2}},
        Row{"It hovers there already", {0, 0, 0}}, Row{"The place is not a number", {NAN, 0, 0}}}) {
    HoverRig rig;
    const Status answer = rig.Fly(row.way, 0);
    ASSERT_FALSE(answer.ok()) << row.why;
    EXPECT_EQ(answer.error().message, row.why);
    EXPECT_EQ(rig.SentCount<GoRequest>(), 0);
    EXPECT_FALSE(rig.status().going.has_value());
  }
}

TEST(Going, NothingKnownMayReachTheSkidsOnTheWay) {
  HoverRig rig;
  // 10 m north of the vehicle; its skids fly 20 m high, less what they hang below B.
  const auto cell = rig.elevation->geometry.CellFromPoint(19.5, 2);
  rig.elevation->height_m.at(*cell) = 17.5F;
  rig.Run(0.2);
  const Status answer = rig.Fly({15, 0, 0}, 0);
  ASSERT_FALSE(answer.ok());
  EXPECT_EQ(answer.error().message.rfind("What stands on the way leaves 1.6 m below", 0), 0u)
      << answer.error().message;
  EXPECT_TRUE(rig.Fly({15, 0, -3}, 0).ok()) << "higher over it";
  HoverRig other;
  other.elevation->height_m.at(*cell) = 17.5F;
  other.Run(0.2);
  EXPECT_TRUE(other.Fly({0, 15, 0}, 0).ok()) << "another way";
  HoverRig below;
  below.elevation->height_m.at(*below.elevation->geometry.CellFromPoint(9.5, 2)) = 18;
  below.Run(0.2);
  EXPECT_TRUE(below.Fly({0, 0, 0}, Rad(45)).ok()) << "where it hovers it may turn";
}

TEST(Going, WhatIsSelectedOrFlownComesFirst) {
  HoverRig rig;
  rig.Arm();
  EXPECT_EQ(rig.status().why_not_go, "");
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  EXPECT_FALSE(rig.Fly({5, 0, 0}, 0).ok());
  EXPECT_EQ(rig.SentCount<GoRequest>(), 0);
}

TEST(Going, AfterAHoldItIsTheWayOn) {
  HoverRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  rig.sites.clear();
  ASSERT_TRUE(rig.Do(HoldHere{}).ok());
  rig.Run(2);
  ASSERT_EQ(rig.state(), MissionState::kHold);
  ASSERT_EQ(rig.status().why_not_go, "");
  ASSERT_TRUE(rig.Fly({0, 10, 0}, Rad(90)).ok());
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  EXPECT_FALSE(rig.status().armed.has_value());
}

TEST(Going, IsHeldByOnePress) {
  HoverRig rig;
  ASSERT_TRUE(rig.Fly({40, 0, 0}, 0).ok());
  rig.Run(0.5);
  ASSERT_TRUE(rig.Do(HoldHere{}).ok());
  EXPECT_FALSE(rig.status().going.has_value());
  rig.Run(1.2);
  EXPECT_EQ(rig.vehicle.mode, VehicleMode::kHold);
  EXPECT_EQ(rig.SentCount<HoldRequest>(), 1);
  EXPECT_EQ(rig.status().why_not_go, "") << "and may be sent on from there";
}

TEST(Going, AWaveOffEndsIt) {
  HoverRig rig;
  ASSERT_TRUE(rig.Fly({40, 0, 0}, 0).ok());
  rig.Run(0.5);
  ASSERT_TRUE(rig.Do(WaveOff{}).ok());
  EXPECT_FALSE(rig.status().going.has_value());
  rig.Run(0.5);
  EXPECT_EQ(rig.vehicle.mode, VehicleMode::kAbort);
}

TEST(Going, SaysWhatTheVehicleRefusesOrDoesNotAnswer) {
  HoverRig rig;
  rig.vehicle.refuses = true;
  ASSERT_TRUE(rig.Fly({10, 0, 0}, 0).ok());
  rig.Run(0.5);
  EXPECT_FALSE(rig.status().going.has_value());
  EXPECT_EQ(rig.status().selection_ended, "Vehicle does not fly there: Fuel low.");
  HoverRig deaf;
  deaf.link_up = false;
  ASSERT_TRUE(deaf.Fly({10, 0, 0}, 0).ok());
  deaf.Run(4.5);
  ASSERT_TRUE(deaf.status().going.has_value());
  EXPECT_GT(deaf.SentCount<GoRequest>(), 5) << "repeated until it is answered";
  deaf.Run(1);
  EXPECT_FALSE(deaf.status().going.has_value());
  const int sent = deaf.SentCount<GoRequest>();
  deaf.Run(2);
  EXPECT_EQ(deaf.SentCount<GoRequest>(), sent);
}

TEST(Going, ALostAnswerIsSeenByTheDeed) {
  HoverRig rig;
  rig.vehicle.answers = false;
  ASSERT_TRUE(rig.Fly({10, 0, 0}, 0).ok());
  rig.Run(1.2);
  ASSERT_TRUE(rig.status().going.has_value());
  EXPECT_TRUE(rig.status().going->accepted);
  rig.Run(3);
  EXPECT_FALSE(rig.status().going.has_value());
}

TEST(Going, ASelectionStopsItWhereTheSiteIsSeen) {
  HoverRig rig;
  ASSERT_TRUE(rig.Fly({10, 0, 0}, 0).ok());
  rig.vehicle.mode_for_s = -100;  // it takes long
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  ASSERT_TRUE(rig.status().going.has_value());
  ASSERT_TRUE(rig.Do(SelectSite{101}).ok());
  EXPECT_FALSE(rig.status().going.has_value());
  rig.Run(1.5);
  EXPECT_EQ(rig.vehicle.mode, VehicleMode::kHold);
  EXPECT_TRUE(rig.ApproveNow().ok()) << rig.status().cannot_approve_reason;
}

TEST(Going, StopsWhereThePositionIsLost) {
  HoverRig rig;
  ASSERT_TRUE(rig.Fly({10, 0, 0}, 0).ok());
  rig.vehicle.mode_for_s = -100;
  rig.Run(0.5);
  rig.navigation.gps.estimate.healthy = false;
  rig.Run(0.5);
  EXPECT_FALSE(rig.status().going.has_value());
  EXPECT_EQ(rig.vehicle.mode, VehicleMode::kHold);
  EXPECT_EQ(rig.status().why_not_go, "Where the vehicle is, is not known");
}

TEST(Going, ASecondPressWithinAMomentIsNoNewWay) {
  HoverRig rig;
  ASSERT_TRUE(rig.Fly({40, 0, 0}, 0).ok());
  rig.Run(0.5);
  ASSERT_TRUE(rig.Do(HoldHere{}).ok());
  EXPECT_FALSE(rig.Fly({0, 0, 0}, Rad(-45)).ok());
  rig.Run(1.2);
  EXPECT_TRUE(rig.Fly({0, 0, 0}, Rad(-45)).ok());
}

TEST(Going, OfAScriptOnlyWhereScriptsMayAndNeverWithoutCommand) {
  HoverRig rig;
  rig.simulated = false;
  rig.Run(0.2);
  EXPECT_FALSE(rig.Fly({10, 0, 0}, 0, CommandOrigin::kScript).ok());
  rig.authority.standing = AuthorityStanding::kOther;
  rig.authority.why_not = "Another station commands";
  rig.Run(0.2);
  EXPECT_FALSE(rig.Fly({10, 0, 0}, 0).ok());
  EXPECT_EQ(rig.SentCount<GoRequest>(), 0);
}

}  // namespace
}  // namespace palace
