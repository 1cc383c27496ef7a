// The approach turned by hand: to a side that the maps call clear, shown anew before it is
// approved.
#include <cmath>

#include "engine/core/units.h"
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
  EXPECT_TRUE(rig.plan().by_hand);
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
    told = told || event.text == "Approach of site A turned by hand: from the east";
  }
  EXPECT_TRUE(told);
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
  EXPECT_FALSE(rig.plan().by_hand);
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
