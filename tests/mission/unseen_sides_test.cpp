// An approach from another side is offered only over ground that was looked at: a roof that no
// camera saw stands in no map.
#include <algorithm>
#include <vector>

#include "engine/core/units.h"
#include "engine/model/approach_side.h"
#include "tests/mission/hover_rig.h"

namespace palace {
namespace {

/// Looks north at site A, 20 m ahead and as far below; a way from the east is clear by the map.
struct SidesRig : HoverRig {
  SidesRig() {
    settings.mission.glide_slope_deg = 45;
    LandingSite& site = *Site(101);
    site.p_WS = {29.5, 2, 0};
    site.clear_approaches = 1U << 2;
    Run(3);
  }
  std::vector<int> Sides() {
    Arm();
    const std::vector<int> sides = status().approach_sides;
    EXPECT_TRUE(Do(DisarmSite{}).ok());
    return sides;
  }
};

TEST(UnseenSides, AreNotOfferedBeforeTheGroundUnderThemWasLookedAt) {
  SidesRig rig;
  EXPECT_EQ(rig.Sides(), std::vector<int>{kStraightApproach});
  rig.yaw_rad = Rad(45);
  rig.Run(3);
  rig.yaw_rad = 0;
  rig.Run(1);
  EXPECT_EQ(rig.Sides(), (std::vector<int>{2, kStraightApproach}));
}

TEST(UnseenSides, AreNoWayRoundABlockedApproachAndAreNamed) {
  SidesRig rig;
  rig.Site(101)->corridor_clear = false;
  rig.Arm();
  EXPECT_FALSE(rig.status().approach->turned());
  EXPECT_FALSE(rig.status().can_approve);
  EXPECT_EQ(rig.status().cannot_approve_reason,
            "Approach to site A is blocked, and under the ways round it ground was not looked at: "
            "look there first");
  ASSERT_TRUE(rig.Do(DisarmSite{}).ok());
  rig.yaw_rad = Rad(45);
  rig.Run(3);
  rig.yaw_rad = 0;
  rig.Run(1);
  rig.Arm();
  EXPECT_TRUE(rig.status().approach->turned());
  EXPECT_EQ(rig.status().approach->side, 2);
}

TEST(NotOnSite, AVehicleThatStandsElsewhereIsAWarning) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  rig.Run(2);
  rig.north_m -= 8;
  rig.vehicle.mode = VehicleMode::kLanded;
  rig.Run(0.3);
  ASSERT_EQ(rig.state(), MissionState::kLanded) << rig.mission.status().why;
  const auto& alarms = rig.mission.status().alarms;
  const auto alarm = std::find_if(alarms.begin(), alarms.end(), [](const Alarm& a) {
    return a.kind == AlarmId::kNotOnSite && a.active;
  });
  ASSERT_NE(alarm, alarms.end());
  EXPECT_EQ(alarm->level, AlarmLevel::kWarning);
  EXPECT_NE(alarm->text.find("on the ground, "), std::string::npos) << alarm->text;
}

}  // namespace
}  // namespace palace
