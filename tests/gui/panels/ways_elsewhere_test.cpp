// Ways to look at other ground, by pointer: in the head of Approve while nothing is selected.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"
#include "tests/support/fake_snapshot.h"

namespace palace {
namespace {

TEST(WaysElsewhere, ATurnAndAClimbStartWhereTheVehicleIs) {
  for (const float width : {1280.0F, 1920.0F}) {
    struct Row {
      const char* button;
      double up_m, turn_deg;
    };
    for (const Row& row :
         {Row{"turn_left", 0, -45}, Row{"turn_right", 0, 45}, Row{"climb", 5, 0}}) {
      FlyWindow window(width, width * 9 / 16, fake::Snapshot(MissionState::kSearch));
      window.ui.Click(row.button, window.draw);
      ASSERT_EQ(window.ui.CountCommands<FlyTo>(), 1) << row.button << " at " << width;
      const FlyTo there = window.ui.LastCommand<FlyTo>();
      const RigidTransform& X_WB = window.snap.sensors->pose->X_WB;
      EXPECT_NEAR((there.p_WB - X_WB.p + row.up_m * Eigen::Vector3d::UnitZ()).norm(), 0, 1e-9);
      const double turn_rad = there.heading_rad - EulerFromRotation(X_WB.R).yaw_rad;
      EXPECT_NEAR(WrapAngle(turn_rad - Rad(row.turn_deg)), 0, 1e-9) << row.button;
    }
  }
}

TEST(WaysElsewhere, APinIsLookedAtFromWhereTheCamerasSeeIt) {
  FlyWindow window(1280, 720, fake::Snapshot(MissionState::kSearch));
  window.Run(0.05);
  EXPECT_EQ(window.ui.items.Find("look_at_pin"), nullptr) << "nothing is pinned";
  const Eigen::Vector3d p_WB = window.snap.sensors->pose->X_WB.p;
  const ElevationMap& map = *window.snap.terrain->applied->elevation;
  const GridGeometry& g = map.geometry;
  const Cell cell = window.snap.terrain->applied->selection.sites.back().cell;
  const Eigen::Vector2d pin(g.NorthOfRow(cell.row), g.EastOfCol(cell.col));
  window.fly.maps.probe.pinned = pin;
  window.Run(0.05);
  ASSERT_NE(window.ui.items.Find("look_at_pin"), nullptr);
  window.ui.Click("look_at_pin", window.draw);
  ASSERT_EQ(window.ui.CountCommands<FlyTo>(), 1);
  const FlyTo there = window.ui.LastCommand<FlyTo>();
  const Eigen::Vector2d way = pin - p_WB.head<2>();
  EXPECT_NEAR(WrapAngle(there.heading_rad - std::atan2(way.y(), way.x())), 0, 1e-9);
  EXPECT_EQ(there.p_WB.z(), p_WB.z()) << "level";
  const double height_m = -p_WB.z() - static_cast<double>(map.Measured().at(cell));
  const double before_m =
      height_m / std::tan(Rad(window.snap.session->settings.mission.glide_slope_deg));
  EXPECT_NEAR((pin - there.p_WB.head<2>()).norm(), std::min(way.norm(), before_m), 1e-6);
}

TEST(WaysElsewhere, HaveRoomInTheHead) {
  for (const MissionState state : {MissionState::kSearch, MissionState::kHold}) {
    for (const float width : {1280.0F, 1920.0F}) {
      EngineSnapshot snap = fake::Snapshot(state);
      snap.flight.Edit().mission.next_look =
          ProposedLook{{30, 0, -20}, 0, "30 m NW", "shows 240 of 2400 m² left to see, in 14 s"};
      FlyWindow window(width, width * 9 / 16, snap);
      window.fly.maps.probe.pinned = Eigen::Vector2d(0, 0);
      window.Run(0.05);
      for (const char* last : {"next_look", "look_at_pin"}) {
        const Item* item = window.ui.items.Find(last);
        if (item != nullptr) {
          EXPECT_LT(item->rect.right(), width - 8) << last << " at " << width;
        }
      }
      EXPECT_EQ(window.ui.items.Find("next_look") != nullptr, state == MissionState::kSearch);
      ASSERT_NE(window.ui.items.Find("climb"), nullptr);
    }
  }
}

TEST(WaysElsewhere, StandWhereTheyStoodWhateverThePanelIsCalled) {
  for (const ImVec2 size : {ImVec2(1280, 720), ImVec2(1280, 1100), ImVec2(1600, 900),
                            ImVec2(1920, 1080), ImVec2(2560, 1440)}) {
    SCOPED_TRACE(testing::Message() << size.x << " x " << size.y);
    std::vector<Rect> left;
    for (const auto& [state, stop_height_m] : {std::pair{MissionState::kHold, 0.0},
                                               {MissionState::kHold, 12.0},
                                               {MissionState::kSearch, 0.0},
                                               {MissionState::kProposed, 0.0}}) {
      EngineSnapshot snap = fake::Snapshot(state);
      snap.flight.Edit().mission.may_select = true;
      snap.flight.Edit().mission.stop_height_m = stop_height_m;
      FlyWindow window(size.x, size.y, snap);
      window.Run(0.05);
      ASSERT_NE(window.ui.items.Find("turn_left"), nullptr) << MissionStateName(state);
      left.push_back(window.ui.items.Find("turn_left")->rect);
      ExpectTextsInPanels(window.ui.items);
    }
    for (const Rect& rect : left) {
      EXPECT_EQ(rect.x, left.front().x);
      EXPECT_EQ(rect.y, left.front().y);
    }
  }
}

TEST(WaysElsewhere, TheProposedLookIsFlownByOnePressAndToldWithItsReason) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  const ProposedLook look{
      {3, 4, -21}, 0.5, "right 45°", "shows 240 of 2400 m² left to see, in 14 s"};
  snap.flight.Edit().mission.next_look = look;
  FlyWindow window(1920, 1080, snap);
  window.Run(0.05);
  EXPECT_TRUE(HasText(window.ui.items, "Look right 45°"));
  EXPECT_TRUE(HasText(window.ui.items, "240"));  // wherever its line ends
  window.ui.Click("next_look", window.draw);
  ASSERT_EQ(window.ui.CountCommands<FlyTo>(), 1);
  EXPECT_EQ(window.ui.LastCommand<FlyTo>().p_WB, look.p_WB);
  EXPECT_EQ(window.ui.LastCommand<FlyTo>().heading_rad, look.heading_rad);
}

TEST(WaysElsewhere, ASelectedSiteThatLacksTheSightOfItsAirOffersTheClimb) {
  for (const float width : {1280.0F, 1920.0F}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
    snap.flight.Edit().mission.next_look = ProposedLook{
        {3, 4, -21}, 0.5, "up 3 m", "the air over site A is seen up to 3.2 m, min 5.0 m"};
    FlyWindow window(width, width * 9 / 16, snap);
    window.ui.Click("next_look", window.draw);
    ASSERT_EQ(window.ui.CountCommands<FlyTo>(), 1) << width;
    const Item* deselect = window.ui.items.Find("deselect");
    ASSERT_NE(deselect, nullptr);
    EXPECT_LT(window.ui.items.Find("next_look")->rect.right(), deselect->rect.x);
  }
}

TEST(WaysElsewhere, SayWhyNotAndAreGoneWhereASiteIsSelected) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  snap.flight.Edit().mission.why_not_go = "The vehicle does not hover";
  FlyWindow refused(1280, 720, snap);
  refused.ui.Click("climb", refused.draw);
  EXPECT_EQ(refused.ui.CountCommands<FlyTo>(), 0);
  refused.ui.MoveTo("climb");
  refused.Run(0.1);
  ASSERT_NE(refused.ui.items.Find("tooltip"), nullptr);
  EXPECT_EQ(refused.ui.items.Find("tooltip")->text, "The vehicle does not hover");
  FlyWindow armed(1280, 720, fake::Snapshot(MissionState::kArmed));
  armed.Run(0.05);
  EXPECT_EQ(armed.ui.items.Find("climb"), nullptr);
}

TEST(WaysElsewhere, OnTheWayThereIsOneButtonThatStopsIt) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  Going going;
  going.to_go_m = 12.34;
  going.unseen_m = 6;
  snap.flight.Edit().mission.going = going;
  FlyWindow window(1280, 720, snap);
  window.Run(0.05);
  EXPECT_EQ(window.ui.items.Find("climb"), nullptr);
  EXPECT_TRUE(HasText(window.ui.items, "12.3 m to go"));
  window.ui.Click("hold_here", window.draw);
  EXPECT_EQ(window.ui.CountCommands<HoldHere>(), 1);
}

TEST(WaysElsewhere, AHoldThatNothingFollowsOffersThem) {
  FlyWindow window(1280, 720, fake::Snapshot(MissionState::kHold));
  window.ui.Click("turn_left", window.draw);
  EXPECT_EQ(window.ui.CountCommands<FlyTo>(), 1);
}

}  // namespace
}  // namespace palace
