// The search map, by pointer and by keys: places to fly to, the area that the vehicle is kept to.
#include "gui/panels/search_map.h"

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/mission/way_rules.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"
#include "tests/support/fake_snapshot.h"

namespace palace {
namespace {

/// Looked at is the square of 20 m around where the search began, which is where the vehicle is.
EngineSnapshot Searching() {
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  auto seen = std::make_shared<SeenGround>();
  seen->middle_W = snap.sensors->pose->X_WB.p.head<2>();
  seen->squares = {64, 64, SeenGround::kSquare_m, seen->middle_W.x() - 64, seen->middle_W.y() - 64};
  seen->maps = Grid<std::uint8_t>(64, 64, 0);
  for (int row = 27; row < 37; ++row) {
    for (int col = 27; col < 37; ++col) {
      seen->maps.at(row, col) = SeenGround::kMapsOfALook;
    }
  }
  snap.flight.Edit().mission.seen = seen;
  snap.flight.Edit().mission.may_select = true;
  return snap;
}

struct SearchWindow : FlyWindow {
  explicit SearchWindow(float width = 1920) : FlyWindow(width, width * 9 / 16, Searching()) {
    ui.Click("show_search_map", draw);
    Run(0.05);
  }
  /// A click so many metres from where the search began.
  void ClickAt(double north_m, double east_m) {
    const Rect& map = ui.items.Find("search_map")->rect;
    const double px_per_m =
        static_cast<double>(std::min(map.w, map.h)) / (2 * fly.search_map.half_m);
    ui.MoveTo(ImVec2{map.x + map.w / 2 + static_cast<float>(east_m * px_per_m),
                     map.y + map.h / 2 - static_cast<float>(north_m * px_per_m)});
    Run(0.02);
    ui.Button(true);
    Run(0.04);
    ui.Button(false);
    Run(0.04);
  }
  Eigen::Vector2d middle() const { return snap.flight->mission.seen->middle_W; }
};

TEST(SearchMap, TellsHowMuchWasLookedAtAndGoesBackToThe3dView) {
  SearchWindow window;
  EXPECT_TRUE(HasText(window.ui.items, "Looked at 400 m²"));
  window.ui.Click("show_3d_view", window.draw);
  window.Run(0.05);
  EXPECT_EQ(window.ui.items.Find("search_map"), nullptr);
  EXPECT_NE(window.ui.items.Find("view_3d"), nullptr);
}

TEST(SearchMap, APlaceIsFlownToAtTheHeightOfNow) {
  for (const float width : {1280.0F, 1920.0F}) {
    SearchWindow window(width);
    window.ClickAt(20, -15);
    ASSERT_TRUE(window.fly.search_map.picked.has_value());
    const Eigen::Vector2d picked = *window.fly.search_map.picked;
    EXPECT_NEAR((picked - window.middle() - Eigen::Vector2d(20, -15)).norm(), 0, 0.7) << width;
    window.ui.Click("fly_there", window.draw);
    ASSERT_EQ(window.ui.CountCommands<FlyTo>(), 1);
    const FlyTo there = window.ui.LastCommand<FlyTo>();
    EXPECT_EQ(there.p_WB.head<2>(), picked);
    EXPECT_EQ(there.p_WB.z(), window.snap.sensors->pose->X_WB.p.z());
    window.ClickAt(20, -15);
    EXPECT_FALSE(window.fly.search_map.picked.has_value()) << "a second click takes it away";
  }
}

TEST(SearchMap, AnAreaIsDrawnCornerByCornerAndSent) {
  SearchWindow window;
  window.ui.Click("draw_area", window.draw);
  window.ClickAt(-20, -20);
  window.ClickAt(-20, 20);
  window.ClickAt(30, 30);  // one too many
  window.ui.Click("area_undo", window.draw);
  window.ClickAt(20, 20);
  window.ClickAt(20, -20);
  window.ui.Click("area_higher", window.draw);
  const double ceiling_m = window.fly.search_map.ceiling_m;
  EXPECT_GT(ceiling_m, -window.snap.sensors->pose->X_WB.p.z());
  window.ClickAt(-20, -20);  // the first corner closes it
  ASSERT_EQ(window.ui.CountCommands<SetFlyArea>(), 1);
  const FlyArea area = window.ui.LastCommand<SetFlyArea>().area;
  ASSERT_EQ(area.corners_W.size(), 4u);
  EXPECT_NEAR(AreaOf_m2(area), 1600, 80);
  EXPECT_EQ(area.ceiling_m, ceiling_m);
  EXPECT_FALSE(window.fly.search_map.draws);
}

// Drawn anew it is as high as the one in force, whatever the vehicle's height.
TEST(SearchMap, AnAreaDrawnAnewKeepsItsCeiling) {
  SearchWindow window;
  const Eigen::Vector2d m = window.middle();
  window.snap.flight.Edit().mission.area =
      FlyArea{{m, m + Eigen::Vector2d(30, 0), m + Eigen::Vector2d(0, 30)}, 21};
  window.Run(0.05);
  window.ui.Click("draw_area", window.draw);
  EXPECT_EQ(window.fly.search_map.ceiling_m, 21);
}

// A double click's second press means the corner, or the button, of the first.
TEST(SearchMap, ADoubleClickIsOneCornerAndClosesOnce) {
  SearchWindow window;
  window.ui.Click("draw_area", window.draw);
  for (const auto& [north, east] : {std::pair{-20.0, -20.0}, {-20.0, 20.0}, {20.0, 20.0}}) {
    window.ClickAt(north, east);
    window.ClickAt(north, east);
  }
  // The first corner's second click closes nothing: there are two corners more to come.
  EXPECT_EQ(window.fly.search_map.corners.size(), 3U);
  window.ui.Click("area_close", window.draw);
  EXPECT_EQ(window.ui.CountCommands<SetFlyArea>(), 1);
  for (const bool down : {true, false}) {  // once more at the same place
    window.ui.Button(down);
    window.Run(0.04);
  }
  EXPECT_FALSE(window.fly.search_map.draws);
}

TEST(SearchMap, AnAreaThatIsNoneIsNotSentAndSaysWhy) {
  SearchWindow window;
  window.ui.Click("draw_area", window.draw);
  for (const auto& [north, east] :
       {std::pair{-20.0, -20.0}, {20.0, 20.0}, {20.0, -20.0}, {-20.0, 20.0}}) {
    window.ClickAt(north, east);
  }
  window.ui.Click("area_close", window.draw);
  window.Run(0.05);
  EXPECT_EQ(window.ui.CountCommands<SetFlyArea>(), 0);
  EXPECT_TRUE(HasText(window.ui.items, "Its edges cross"));
  window.ui.Click("area_cancel", window.draw);
  EXPECT_FALSE(window.fly.search_map.draws);
}

TEST(SearchMap, ADrawnAreaIsToldAndCleared) {
  SearchWindow window;
  const Eigen::Vector2d m = window.middle();
  window.snap.flight.Edit().mission.area =
      FlyArea{{m, m + Eigen::Vector2d(30, 0), m + Eigen::Vector2d(0, 30)}, 45};
  window.Run(0.05);
  EXPECT_TRUE(HasText(window.ui.items, "Ceiling 45 m"));
  EXPECT_EQ(window.ui.items.Find("area_restore"), nullptr);
  window.ui.Click("area_clear", window.draw);
  EXPECT_EQ(window.ui.CountCommands<ClearFlyArea>(), 1);
}

TEST(SearchMap, AClearedAreaIsBroughtBackByOnePressAndNotByADoubleClick) {
  SearchWindow window;
  const Eigen::Vector2d m = window.middle();
  const FlyArea area{{m, m + Eigen::Vector2d(30, 0), m + Eigen::Vector2d(0, 30)}, 45};
  window.snap.flight.Edit().mission.area = area;
  window.Run(0.05);
  const ImVec2 where = window.ui.items.Find("area_clear")->rect.centre();
  window.ui.Click("area_clear", window.draw);
  window.snap.flight.Edit().mission.area.reset();  // as the engine answers
  window.Run(0.05);
  EXPECT_TRUE(HasText(window.ui.items, "Area cleared"));
  window.ui.MoveTo(where);
  for (const bool down : {true, false}) {
    window.ui.Button(down);
    window.Run(0.04);
  }
  EXPECT_EQ(window.ui.CountCommands<SetFlyArea>(), 0);
  EXPECT_FALSE(window.fly.search_map.picked.has_value()) << "nor picks it a place";
  window.ui.Click("area_restore", window.draw);
  ASSERT_EQ(window.ui.CountCommands<SetFlyArea>(), 1);
  EXPECT_EQ(window.ui.LastCommand<SetFlyArea>().area.corners_W, area.corners_W);
  EXPECT_EQ(window.ui.LastCommand<SetFlyArea>().area.ceiling_m, area.ceiling_m);
  window.snap.flight.Edit().mission.state = MissionState::kNoLive;  // another flight
  window.Run(0.05);
  EXPECT_EQ(window.ui.items.Find("area_restore"), nullptr);
}

// What was drawn is not lost by one press, nor brought back by the second one of a double click.
TEST(SearchMap, AnAreaWhoseDrawingWasCancelledGoesOnWhereItWas) {
  for (const float width : {1280.0F, 1920.0F}) {
    SCOPED_TRACE(width);
    SearchWindow window(width);
    window.ui.Click("draw_area", window.draw);
    for (const auto& [north, east] :
         {std::pair{-20.0, -20.0}, {-20.0, 20.0}, {20.0, 20.0}, {20.0, -20.0}}) {
      window.ClickAt(north, east);
    }
    window.ui.Click("area_higher", window.draw);
    const std::vector<Eigen::Vector2d> corners = window.fly.search_map.corners;
    const double ceiling_m = window.fly.search_map.ceiling_m;
    ASSERT_EQ(corners.size(), 4U);
    window.ui.Click("area_cancel", window.draw);
    for (const bool down : {true, false}) {  // once more at the same place
      window.ui.Button(down);
      window.Run(0.04);
    }
    EXPECT_FALSE(window.fly.search_map.draws);
    EXPECT_FALSE(window.fly.search_map.picked.has_value());
    EXPECT_TRUE(HasText(window.ui.items, "Drawing cancelled"));
    window.Run(0.6);
    window.ui.Click("area_resume", window.draw);
    EXPECT_TRUE(window.fly.search_map.draws);
    EXPECT_EQ(window.fly.search_map.corners, corners);
    window.Run(0.05);
    window.ui.Click("area_close", window.draw);
    ASSERT_EQ(window.ui.CountCommands<SetFlyArea>(), 1);
    EXPECT_EQ(window.ui.LastCommand<SetFlyArea>().area.corners_W, corners);
    EXPECT_EQ(window.ui.LastCommand<SetFlyArea>().area.ceiling_m, ceiling_m);
    window.Run(0.05);
    EXPECT_EQ(window.ui.items.Find("area_resume"), nullptr) << "it is drawn";
  }
}

// A mission ends behind the panels of the descent, and the next one has another origin.
TEST(SearchMap, AnAreaOfAMissionThatIsOverIsNotBroughtBack) {
  for (const MissionState end : {MissionState::kLanded, MissionState::kNoLive}) {
    SCOPED_TRACE(MissionStateName(end));
    SearchWindow window;
    const Eigen::Vector2d m = window.middle();
    window.snap.flight.Edit().mission.area =
        FlyArea{{m, m + Eigen::Vector2d(30, 0), m + Eigen::Vector2d(0, 30)}, 45};
    window.Run(0.05);
    window.snap.flight.Edit().mission.area.reset();
    window.fly.search_map.put_aside = {m};
    window.Run(0.05);
    EXPECT_NE(window.ui.items.Find("area_resume"), nullptr);
    window.snap = fake::Snapshot(MissionState::kDescending);
    window.Run(0.05);
    window.snap = fake::Snapshot(end);
    window.Run(0.05);
    window.snap = Searching();
    window.Run(0.05);
    EXPECT_EQ(window.ui.items.Find("area_resume"), nullptr);
    EXPECT_EQ(window.ui.items.Find("area_restore"), nullptr);
  }
}

TEST(SearchMap, APlaceThatTheEngineWouldRefuseIsNotOfferedAndSaysItsWords) {
  SearchWindow window;
  window.ui.why_not_flown = WhyNotFlown;
  const Eigen::Vector2d m = window.middle();
  const auto area = [&](double ceiling_m) {
    return FlyArea{{m + Eigen::Vector2d(-10, -10), m + Eigen::Vector2d(10, -10),
                    m + Eigen::Vector2d(10, 10), m + Eigen::Vector2d(-10, 10)},
                   ceiling_m};
  };
  const auto told = [&] {
    const Item* tooltip = window.ui.items.Find("tooltip");
    return tooltip != nullptr ? tooltip->text : std::string("nothing");
  };
  window.snap.flight.Edit().mission.area = area(60);
  window.ClickAt(-6, -6);
  window.ui.Click("fly_there", window.draw);
  EXPECT_EQ(window.ui.CountCommands<FlyTo>(), 1);
  window.ui.unseen_on_way = [](const EngineSnapshot&, const FlyTo&) { return 6.3; };
  window.ui.MoveTo("fly_there");
  window.Run(1);
  EXPECT_EQ(told(),
            "Flies level to over the cross and hovers there. Flies over 6.3 m of ground that no "
            "map showed");
  window.ui.unseen_on_way = nullptr;
  window.ClickAt(40, 0);
  window.ui.Click("fly_there", window.draw);
  EXPECT_EQ(window.ui.CountCommands<FlyTo>(), 1);
  EXPECT_EQ(told().rfind("It leaves the area by", 0), 0U) << told();
  window.snap.flight.Edit().mission.area = area(20);
  window.ClickAt(-6, -6);
  window.ui.Click("fly_there", window.draw);
  EXPECT_EQ(window.ui.CountCommands<FlyTo>(), 1);
  EXPECT_NE(told().find("m high, ceiling 20 m"), std::string::npos) << told();
}

/// Four sites within a metre, so that their letters would cover each other.
EngineSnapshot Crowded() {
  EngineSnapshot snap = Searching();
  snap.flight.Edit().mission.state = MissionState::kProposed;
  auto decision = std::make_shared<TerrainDecision>(*snap.terrain->applied);
  std::vector<LandingSite>& sites = decision->selection.sites;
  for (std::size_t k = 0; k < sites.size(); ++k) {
    sites[k].p_WS.head<2>() =
        snap.flight->mission.seen->middle_W + Eigen::Vector2d(10 + 0.2 * static_cast<double>(k), 5);
  }
  snap.terrain.Edit().applied = decision;
  return snap;
}

TEST(SearchMap, LettersCoverNoOther) {
  for (const float width : {1920.0F, 1366.0F, 1280.0F}) {
    SCOPED_TRACE(width);
    SearchWindow window(width);
    window.snap = Crowded();
    window.Run(0.05);
    std::vector<const Item*> letters;
    for (const Item& item : window.ui.items.items()) {
      if (item.name.rfind("letter/search_map/", 0) == 0) {
        letters.push_back(&item);
      }
    }
    ASSERT_EQ(letters.size(), window.snap.terrain->applied->selection.sites.size());
    ASSERT_GE(letters.size(), 4U);
    for (std::size_t i = 0; i < letters.size(); ++i) {
      for (std::size_t j = i + 1; j < letters.size(); ++j) {
        EXPECT_FALSE(Touch(letters[i]->rect, letters[j]->rect))
            << letters[i]->name << " and " << letters[j]->name;
      }
    }
  }
}

TEST(SearchMap, AClickOnALetterSelectsItsSiteAndPicksNoPlace) {
  SearchWindow window;
  window.snap = Crowded();
  window.Run(0.05);
  for (const LandingSite& site : window.snap.terrain->applied->selection.sites) {
    SCOPED_TRACE(site.letter);
    const int before = window.ui.CountCommands<SelectSite>();
    window.ui.Click("letter/search_map/" + site.letter, window.draw);
    EXPECT_EQ(window.ui.CountCommands<SelectSite>(), before + 1);
    EXPECT_EQ(window.ui.LastCommand<SelectSite>().site_id, site.id);
    EXPECT_FALSE(window.fly.search_map.picked.has_value());
  }
}

TEST(SearchMap, WhileAnAreaIsDrawnAClickOnALetterIsACorner) {
  SearchWindow window;
  window.snap = Crowded();
  window.ui.Click("draw_area", window.draw);
  window.ClickAt(10, 5);
  EXPECT_EQ(window.ui.CountCommands<SelectSite>(), 0);
  EXPECT_EQ(window.fly.search_map.corners.size(), 1U);
}

TEST(SearchMap, TheLegendTellsOnlyWhatIsDrawn) {
  SearchWindow window;
  EXPECT_TRUE(HasText(window.ui.items, "Next looks keep to 60 m"));
  EXPECT_FALSE(HasText(window.ui.items, "Course suits"));
  const Eigen::Vector2d m = window.middle();
  window.snap.flight.Edit().mission.area =
      FlyArea{{m, m + Eigen::Vector2d(30, 0), m + Eigen::Vector2d(0, 30)}, 45};
  window.Run(0.05);
  EXPECT_FALSE(HasText(window.ui.items, "Next looks keep to 60 m"));
  EXPECT_TRUE(HasText(window.ui.items, "Area"));
  window.ui.Click("search_legend", window.draw);
  EXPECT_FALSE(window.fly.search_map.picked.has_value()) << "a click on it picks no place";
  window.ui.Click("search_legend_on", window.draw);
  window.Run(0.05);
  EXPECT_EQ(window.ui.items.Find("search_legend"), nullptr);
}

TEST(SearchMap, TheCoursesToASelectedSiteAreLargeAndTold) {
  for (const float width : {1920.0F, 1280.0F}) {
    SCOPED_TRACE(width);
    SearchWindow window(width);
    EngineSnapshot snap = Crowded();
    MissionStatus& m = snap.flight.Edit().mission;
    m.state = MissionState::kArmed;
    m.armed = snap.terrain->applied->selection.sites[0];
    m.headings.emplace();
    window.snap = snap;
    window.fly.search_map.legend = true;
    window.Run(0.05);
    const Item* courses = window.ui.items.Find("courses");
    ASSERT_NE(courses, nullptr);
    const Rect& map = window.ui.items.Find("search_map")->rect;
    EXPECT_GE(courses->rect.w, 0.4F * std::min(map.w, map.h));
    const Item* legend = window.ui.items.Find("search_legend");
    ASSERT_NE(legend, nullptr);
    EXPECT_TRUE(Inside(legend->rect, map)) << "all its words are on the map";
    EXPECT_TRUE(HasText(window.ui.items, "Course suits"));
  }
}

TEST(SearchMap, ButtonsAndWheelZoomAlike) {
  SearchWindow window;
  const double before = window.fly.search_map.half_m;
  window.ui.Click("map_closer", window.draw);
  EXPECT_LT(window.fly.search_map.half_m, before);
  window.ui.Click("map_wider", window.draw);
  EXPECT_NEAR(window.fly.search_map.half_m, before, 1e-9);
}

TEST(SearchMap, IsWorkedByKeysAlone) {
  SearchWindow window;
  window.Run(0.05);
  for (int press = 0; press < 200 && window.ui.focus.shown() != "search_map"; ++press) {
    window.ui.Tap(ImGuiKey_Tab, window.draw);
  }
  ASSERT_EQ(window.ui.focus.shown(), "search_map");
  for (int press = 0; press < 5; ++press) {
    window.ui.Tap(ImGuiKey_UpArrow, window.draw);
  }
  window.ui.Tap(ImGuiKey_RightArrow, window.draw);
  window.ui.Tap(ImGuiKey_Enter, window.draw);
  ASSERT_TRUE(window.fly.search_map.picked.has_value());
  EXPECT_NEAR((*window.fly.search_map.picked - window.middle() - Eigen::Vector2d(10, 2)).norm(), 0,
              1e-9);
}

TEST(SearchMap, IsGoneWhileItDescends) {
  SearchWindow window;
  window.snap = fake::Snapshot(MissionState::kDescending);
  window.Run(0.05);
  EXPECT_EQ(window.ui.items.Find("search_map"), nullptr);
  EXPECT_EQ(window.ui.items.Find("show_search_map"), nullptr);
}

}  // namespace
}  // namespace palace
