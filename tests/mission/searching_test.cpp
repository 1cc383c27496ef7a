// The look that the station proposes: for what a site lacks, for what did not last, for what was
// not looked at; and the area that it keeps to.
#include "engine/mission/searching.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/mission/hover_rig.h"

namespace palace {
namespace {

struct SearchingRig : HoverRig {
  SearchingRig() { sites_before = sites; }
  /// Nothing is found any more.
  void FindNothing(double seconds = 3) {
    sites.clear();
    Run(seconds);
  }
  const ProposedLook* Look() const { return status().next_look ? &*status().next_look : nullptr; }
  Status FlyLook() { return Do(FlyTo{Look()->p_WB, Look()->heading_rad}); }
  /// That stands; null: it does not.
  const Alarm* Standing(AlarmId id) const {
    const auto& alarms = status().alarms;
    const auto at = std::find_if(alarms.begin(), alarms.end(),
                                 [&](const Alarm& a) { return a.kind == id && a.active; });
    return at == alarms.end() ? nullptr : &*at;
  }
  std::vector<LandingSite> sites_before;
};

FlyArea Around(double north_m, double east_m, double half_m, double ceiling_m = 40) {
  return {{{north_m - half_m, east_m - half_m},
           {north_m + half_m, east_m - half_m},
           {north_m + half_m, east_m + half_m},
           {north_m - half_m, east_m + half_m}},
          ceiling_m};
}

TEST(Searching, WhatDidNotLastIsLookedAtOnceThenOtherGround) {
  SearchingRig rig;
  rig.settings.mission.glide_slope_deg = 45;
  rig.Site(101)->p_WS = {42.2, 2, 0};
  rig.Run(1);
  rig.FindNothing();
  ASSERT_EQ(rig.state(), MissionState::kSearch);
  ASSERT_NE(rig.Look(), nullptr) << rig.status().why_no_look;
  EXPECT_EQ(rig.Look()->words, "13 m N") << "20 m high, it looks at it from 20 m before";
  EXPECT_EQ(rig.Look()->why, "site A was proposed and did not last");
  ASSERT_TRUE(rig.FlyLook().ok());
  EXPECT_EQ(rig.Look(), nullptr) << "while it is on its way";
  rig.Run(5);
  ASSERT_FALSE(rig.status().going.has_value());
  ASSERT_NE(rig.Look(), nullptr) << rig.status().why_no_look;
  EXPECT_EQ(rig.Look()->why.rfind("shows ", 0), 0u) << rig.Look()->why;
}

TEST(Searching, WhatIsStillListedIsNotLookedAtAgain) {
  SearchingRig rig;
  rig.settings.mission.glide_slope_deg = 45;
  rig.Site(101)->p_WS = {42.2, 2, 0};
  rig.Run(1);
  rig.maps_up = false;  // the pictures are lost, and nothing is proposed on an old map
  ASSERT_TRUE(rig.RunUntil(MissionState::kSearch));
  rig.Run(2);
  EXPECT_TRUE(rig.Look() == nullptr || rig.Look()->why.rfind("site A", 0) != 0) << rig.Look()->why;
}

TEST(Searching, ALookAtOtherGroundIsFlownAndComesToAnEnd) {
  SearchingRig rig;
  ASSERT_TRUE(rig.Do(SetFlyArea{Around(9.5, 2, 25)}).ok());
  rig.sites.clear();
  rig.Run(3);
  int looks = 0;
  while (rig.Look() != nullptr) {
    ASSERT_LT(++looks, 60);
    ASSERT_TRUE(IsInside(*rig.status().area, rig.Look()->p_WB.head<2>()));
    ASSERT_TRUE(rig.FlyLook().ok());
    rig.Run(6);
  }
  EXPECT_GT(looks, 4);
  EXPECT_FALSE(rig.status().why_no_look.empty());
  EXPECT_NE(rig.status().why_no_look.find("in the area"), std::string::npos)
      << rig.status().why_no_look;
}

TEST(Searching, AnArmedSiteThatLacksTheSightOfItsAirIsLookedAtFromHigherUp) {
  SearchingRig rig;
  for (LandingSite& site : rig.sites) {
    site.air_seen_m = site.air_on_way_m = 3.2F;
  }
  rig.Run(0.5);
  rig.Arm();
  EXPECT_FALSE(rig.status().can_approve);
  ASSERT_NE(rig.Look(), nullptr);
  EXPECT_EQ(rig.Look()->words, "up 3 m");
  EXPECT_EQ(rig.Look()->why, "the air over site A is seen up to 3.2 m, min 5.0 m");
  ASSERT_TRUE(rig.FlyLook().ok());
  EXPECT_FALSE(rig.status().armed.has_value());
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  for (LandingSite& site : rig.sites) {
    site.air_seen_m = 6.2F;
  }
  rig.Run(4);
  EXPECT_NEAR(rig.vehicle.height_m, 23, 1e-9);
  rig.Arm();
  EXPECT_TRUE(rig.status().can_approve) << rig.status().cannot_approve_reason;
  EXPECT_EQ(rig.Look(), nullptr) << "nothing is missing";
}

TEST(Searching, NothingIsProposedWhileAnApprovalFlies) {
  SearchingRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  EXPECT_EQ(rig.Look(), nullptr);
  EXPECT_FALSE(rig.status().why_no_look.empty());
}

TEST(Searching, WithoutCamerasThatAreKnownNothingIsProposed) {
  MissionRig rig;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  rig.sites.clear();
  rig.Run(3);
  EXPECT_EQ(rig.mission.status().seen, nullptr);
  EXPECT_EQ(rig.mission.status().why_no_look, "The height of the ground is not known");
}

// 0.4 % a second: full it flies for 250 s, and the reserve is five minutes.
TEST(Searching, OnTheReserveNoLookIsProposedAndAnAlarmSaysSo) {
  SearchingRig rig;
  rig.sites.clear();
  rig.Run(3);
  ASSERT_NE(rig.Look(), nullptr);
  rig.vehicle.energy_per_s = 0.004;
  rig.Run(15);
  ASSERT_LT(rig.status().energy.lasts_s, 300);
  EXPECT_EQ(rig.Look(), nullptr);
  EXPECT_THAT(rig.status().why_no_look, testing::MatchesRegex("No look: energy lasts 4\\.. min, "
                                                              "reserve 5.0 min"));
  const Alarm* alarm = rig.Standing(AlarmId::kEnergyLow);
  ASSERT_NE(alarm, nullptr);
  EXPECT_EQ(alarm->level, AlarmLevel::kCaution);
  EXPECT_THAT(alarm->text, testing::MatchesRegex("Energy for 4\\.. min at this rate, limit "
                                                 "5.0 min. Land, or fly home."));
  EXPECT_TRUE(rig.status().why_not_go.empty()) << "a person may";
  rig.settings.mission.energy_reserve_s = 0;
  rig.Run(3);
  EXPECT_NE(rig.Look(), nullptr) << rig.status().why_no_look;
  EXPECT_EQ(rig.Standing(AlarmId::kEnergyLow), nullptr);
}

TEST(Searching, WithoutARateTheGaugeAloneRaisesTheAlarmAndALookIsProposed) {
  SearchingRig rig;
  rig.sites.clear();
  rig.vehicle.energy = 0.09;
  rig.Run(3);
  const Alarm* alarm = rig.Standing(AlarmId::kEnergyLow);
  ASSERT_NE(alarm, nullptr);
  EXPECT_EQ(alarm->text, "Energy 9 %, limit 10 %. Land, or fly home.");
  EXPECT_NE(rig.Look(), nullptr);
}

TEST(Searching, OnTheReserveASiteIsStillApproved) {
  SearchingRig rig;
  rig.vehicle.energy = 0.3;
  rig.vehicle.energy_per_s = 0.002;
  rig.Run(15);
  ASSERT_NE(rig.Standing(AlarmId::kEnergyLow), nullptr);
  rig.Arm();
  EXPECT_TRUE(rig.ApproveNow().ok()) << rig.status().cannot_approve_reason;
}

TEST(Area, WaysThatLeaveItAreRefused) {
  SearchingRig rig;
  ASSERT_TRUE(rig.Do(SetFlyArea{Around(9.5, 2, 20, 30)}).ok());
  EXPECT_EQ(rig.LastDecision(), "Vehicle kept to an area of 1600 m² up to 30 m, by the operator");
  struct Row {
    Eigen::Vector3d way;
    const char* why;
  };
  for (const Row& row : {Row{{15, 0, 0}, ""}, Row{{26, 0, 0}, "It leaves the area by 6.0 m"},
                         Row{{0, 0, -11}, "31 m high, ceiling 30 m"}, Row{{0, 0, -9}, ""}}) {
    SearchingRig fresh;
    ASSERT_TRUE(fresh.Do(SetFlyArea{Around(9.5, 2, 20, 30)}).ok());
    const Status answer = fresh.Fly(row.way, 0.3);
    EXPECT_EQ(answer.ok() ? "" : answer.error().message, row.why) << row.way.transpose();
  }
  ASSERT_TRUE(rig.Do(ClearFlyArea{}).ok());
  EXPECT_TRUE(rig.Fly({26, 0, 0}, 0).ok());
}

TEST(Area, ASiteOutsideItIsNotApproved) {
  SearchingRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.status().can_approve);
  // Site A lies at 10 m north, 2 m east, half a metre ahead of the vehicle.
  ASSERT_TRUE(rig.Do(SetFlyArea{Around(-10, 2, 15)}).ok());
  rig.Run(0.2);
  EXPECT_FALSE(rig.status().can_approve);
  EXPECT_EQ(rig.status().cannot_approve_reason, "Site A lies 5.0 m outside the area");
  EXPECT_FALSE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.Do(SetFlyArea{Around(9.5, 2, 15)}).ok());
  rig.Run(0.2);
  EXPECT_TRUE(rig.status().can_approve) << rig.status().cannot_approve_reason;
}

// It may be sent in; that it hovers outside is told with the area, and no reason speaks of leaving.
TEST(Area, ThatDoesNotHoldTheVehicleSaysSo) {
  SearchingRig rig;
  ASSERT_TRUE(rig.Do(SetFlyArea{Around(40, 2, 20, 15)}).ok());
  const std::string began = "Vehicle kept to an area of 1600 m² up to 15 m, by the operator; it ";
  EXPECT_EQ(rig.LastDecision(),
            began + "hovers 10.5 m outside the area and 5.0 m above its ceiling");
  struct Row {
    Eigen::Vector3d way;
    const char* why;
  };
  for (const Row& row : {Row{{20, 0, 0}, ""}, Row{{0, 0, -5}, ""},
                         Row{{-6, 0, 0}, "It ends 16.5 m outside the area"}}) {
    SearchingRig fresh;
    ASSERT_TRUE(fresh.Do(SetFlyArea{Around(40, 2, 20, 30)}).ok());
    const Status answer = fresh.Fly(row.way, 0.3);
    EXPECT_EQ(answer.ok() ? "" : answer.error().message, row.why) << row.way.transpose();
  }
}

TEST(Area, IsRefusedWithTheReasonAndNotChangedUnderAnApproval) {
  SearchingRig rig;
  const Status crossed = rig.Do(SetFlyArea{{{{0, 0}, {20, 20}, {20, 0}, {0, 20}}, 30}});
  ASSERT_FALSE(crossed.ok());
  EXPECT_EQ(crossed.error().message, "Its edges cross");
  EXPECT_FALSE(rig.status().area.has_value());
  EXPECT_FALSE(rig.Do(ClearFlyArea{}).ok()) << "none was drawn";
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  EXPECT_FALSE(rig.Do(SetFlyArea{Around(9.5, 2, 20)}).ok());
}

}  // namespace
}  // namespace palace
