// A screen says of a way what the engine answers to the command, whatever the way.
#include "engine/mission/way_rules.h"

#include <set>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "tests/mission/hover_rig.h"

namespace palace {
namespace {

/// What the pipeline publishes of that mission.
EngineSnapshot Published(const HoverRig& rig) {
  EngineSnapshot snapshot;
  snapshot.flight.Edit().mission = rig.status();
  snapshot.flight.Edit().navigation = rig.navigation;
  snapshot.flight.Edit().navigation.gps.estimate.p_WB = rig.p_WB();
  VehiclePose pose;
  pose.X_WB = {RotationFromEuler({0, 0, rig.yaw_rad}), rig.p_WB()};
  snapshot.sensors.Edit().pose = pose;
  snapshot.terrain.Edit().applied = std::make_shared<const TerrainDecision>(rig.decision);
  snapshot.session.Edit().settings = rig.settings;
  return snapshot;
}

TEST(WayRules, AScreenSaysWhatTheEngineAnswers) {
  RandomStream random(11, "ways");
  int flown_unseen = 0;
  std::set<std::string> kinds;  // first words of the refusals
  for (int trial = 0; trial < 120; ++trial) {
    SCOPED_TRACE(trial);
    HoverRig rig;
    rig.elevation->height_m.at(*rig.elevation->geometry.CellFromPoint(19.5, 2)) = 18.5F;
    const Eigen::Vector2d here = rig.p_WB().head<2>();
    if (random.Index(2) == 0) {
      const double half_m = random.Uniform(5, 40);
      ASSERT_TRUE(rig.Do(SetFlyArea{{{here + Eigen::Vector2d(-half_m, -half_m),
                                      here + Eigen::Vector2d(half_m, -half_m),
                                      here + Eigen::Vector2d(half_m, half_m),
                                      here + Eigen::Vector2d(-half_m, half_m)},
                                     random.Uniform(15, 60)}})
                      .ok());
    }
    rig.Run(0.2);
    const FlyTo there{rig.p_WB() + Eigen::Vector3d(random.Uniform(-50, 50), random.Uniform(-50, 50),
                                                   random.Uniform(-40, 2)),
                      random.Uniform(-3, 3)};
    const std::string said = WhyNotFlown(Published(rig), there);
    const double unseen_m = UnseenOnWay(Published(rig), there);
    const Status answer = rig.Do(there);
    EXPECT_EQ(said, answer.ok() ? std::string() : answer.error().message);
    if (answer.ok()) {
      EXPECT_EQ(unseen_m, rig.mission.status().going->unseen_m);
      flown_unseen += unseen_m > 0 ? 1 : 0;
    }
    kinds.insert(said.empty() ? said : said.substr(said.find_first_not_of("0123456789. m")));
  }
  EXPECT_GE(kinds.size(), 5U) << "the ways are of every kind";
  EXPECT_GT(flown_unseen, 0) << "and some go over ground that no map showed";
}

TEST(WayRules, TheMissionsOwnReasonComesFirst) {
  HoverRig rig;
  EngineSnapshot snapshot = Published(rig);
  const FlyTo there{rig.p_WB() + Eigen::Vector3d(200, 0, 0), 0};
  EXPECT_EQ(WhyNotFlown(snapshot, there), "200 m away, limit 60 m");
  snapshot.flight.Edit().mission.why_not_go = "The vehicle does not hover";
  EXPECT_EQ(WhyNotFlown(snapshot, there), "The vehicle does not hover");
  snapshot.flight.Edit().mission.why_not_go.clear();
  snapshot.sensors.Edit().pose.reset();
  EXPECT_EQ(WhyNotFlown(snapshot, there), "Where the vehicle is, is not known");
}

// The vehicle measures the way from another place than the station.
TEST(WayRules, WhileGpsDisagreesItTurnsAndClimbsOnTheSpotAlone) {
  HoverRig rig;
  rig.navigation.gps_agreement.off = true;
  rig.navigation.gps_agreement.off_m = 8;
  rig.Run(0.2);
  const FlyTo level{rig.p_WB() + Eigen::Vector3d(5, 0, 0), 0};
  const Status refused = rig.Do(level);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message.rfind("GPS is 8.0 m off", 0), 0u) << refused.error().message;
  EXPECT_EQ(WhyNotFlown(Published(rig), level), refused.error().message);
  EXPECT_TRUE(rig.Do(FlyTo{rig.p_WB() - Eigen::Vector3d(0, 0, 5), 0}).ok());
}

}  // namespace
}  // namespace palace
