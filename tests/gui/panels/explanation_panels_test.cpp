// What the screen answers to "why": the box beside a probed cell, a site's rank, a re-check.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "engine/model/cell_explanation.h"
#include "gui/panels/review/review.h"
#include "gui/panels/tune/tune.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

/// What the engine would say of a rough cell.
CellExplanation RoughCell(const TerrainDecision& decision, Cell cell) {
  CellExplanation why;
  why.cell = cell;
  why.state = CellState::kMeasured;
  why.height_m = {decision.elevation->height_m.at(cell), 0.06};
  why.frames = 10;
  why.age_s = 0.2;
  why.flags = kFlagShadow;
  why.verdict = "Roughness here 23.0 cm, max 10 cm";
  why.terms = {{CellTerm::kSlope, {Rad(2.1), Rad(0.3)}, Rad(10), false, false},
               {CellTerm::kRoughness, {0.23, 0.02}, 0.1, true, true},
               {CellTerm::kStep, {0.14, 0.03}, 0.15, false, false},
               {CellTerm::kProbability, {0.2, 0}, 0.99, true, false},
               {CellTerm::kHazardDistance, {0, 0}, 2.3, true, false}};
  return why;
}

bool Overlap(const Rect& a, const Rect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

// The grid under a flying camera moves on: what was pinned there is not silently gone.
TEST(FlyMaps, APinThatTheMapLeftBehindIsTold) {
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    FlyWindow window(size.width, size.height, fake::Snapshot(MissionState::kProposed));
    window.ui.explain = RoughCell;
    const GridGeometry& g = window.snap.terrain->applied->hazards->geometry;
    window.fly.maps.probe.pinned = {g.north_max_m() + 12, g.east_min_m + 3};
    window.fly.maps.probe.pinned_map = "map/slope";
    window.Run(0.05);
    EXPECT_TRUE(HasText(window.ui.items, "Pin 12 m off the map"));
    window.fly.maps.probe.pinned = {g.north_max_m() - 3, g.east_min_m + 3};
    window.Run(0.05);
    EXPECT_FALSE(HasText(window.ui.items, "off the map"));
  }
}

// Every map, nine places each, three sizes, three states: the box is there, explains the cell, and
// lies over nothing it must not.
TEST(FlyMaps, TheWhyBoxExplainsTheCellAndKeepsOffWhatMatters) {
  for (const WindowSize& size : kWindowSizes) {
    for (const MissionState state :
         {MissionState::kProposed, MissionState::kArmed, MissionState::kDescending}) {
      SCOPED_TRACE(testing::Message() << size.name << " state " << int(state));
      FlyWindow window(size.width, size.height, fake::Snapshot(state));
      window.ui.explain = RoughCell;
      window.fly.tab = PlotTab::kMaps;
      window.Run(0.05);
      for (const char* map : {"map/elevation", "map/cost", "map/safe_distance"}) {
        ASSERT_NE(window.ui.items.Find(map), nullptr) << map;
        const Rect square = window.ui.items.Find(map)->rect;
        for (int place = 0; place < 9; ++place) {
          const ImVec2 at{square.x + square.w * (0.05F + 0.45F * float(place % 3)),
                          square.y + square.h * (0.05F + 0.45F * float(place / 3))};
          window.ui.MoveTo(at);
          window.Run(0.05);
          const Item* why = window.ui.items.Find("why");
          ASSERT_NE(why, nullptr) << map << " place " << place;
          EXPECT_NE(why->text.find("Roughness 23.0 cm ± 2.0 cm max 10 cm over decided"),
                    std::string::npos)
              << why->text;
          EXPECT_NE(why->text.find("Measured in 10 frames, 0.3 s ago"), std::string::npos)
              << why->text;
          EXPECT_NE(why->text.find("Flags: deep shadow"), std::string::npos);
          EXPECT_FALSE(why->rect.Contains(at));
          EXPECT_FALSE(Overlap(why->rect, window.ui.wave_off_rect));
          for (const char* name : {"ring", "approve", "refuse", "hold_here"}) {
            if (const Item* other = window.ui.items.Find(name)) {
              EXPECT_FALSE(Overlap(why->rect, other->rect)) << name;
            }
          }
          for (const Item& item : window.ui.items.items()) {
            if (item.text == "± 2.0 cm" || item.text == "Flags: deep shadow" ||
                item.text == "Measured in 10 frames, 0.3 s ago") {
              EXPECT_TRUE(Inside(item.rect, why->rect)) << item.text;
            }
          }
        }
      }
    }
  }
}

TEST(FlyMaps, APinnedCellKeepsItsWhyBoxUntilUnpinned) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  window.ui.explain = RoughCell;
  window.ui.Click("map/slope", window.draw);
  window.ui.MoveTo(ImVec2(5, 5));
  window.Run(0.1);
  EXPECT_NE(window.ui.items.Find("why"), nullptr);
  window.ui.Click("map/slope", window.draw);
  window.ui.MoveTo(ImVec2(5, 5));
  window.Run(0.1);
  EXPECT_EQ(window.ui.items.Find("why"), nullptr);
}

TEST(FlyDescent, TheKeptAlternativeIsComparedWithTheSiteFlownAndALossHasItsReason) {
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
    FlyWindow window(size.width, size.height, snap);
    const Item* kept = window.ui.items.Find("alternative");
    ASSERT_NE(kept, nullptr);
    EXPECT_EQ(kept->text, "B 0.1 m more clear than A");
    SiteRecheck& newest = snap.flight.Edit().mission.rechecks.back();
    newest.verdict = SiteVerdict::kDegraded;
    newest.reason = "Slope 9.6° ± 0.9°, max 10°";
    FlyWindow degraded(size.width, size.height, snap);
    bool said = false;
    for (const Item& item : degraded.ui.items.items()) {
      said = said || (item.name == "text" && item.text.rfind("Degraded: Slope", 0) == 0);
    }
    EXPECT_TRUE(said);
    ExpectTextsInPanels(degraded.ui.items);
  }
}

TEST(FlyDescent, NoMapIsAskedOfASiteThatWasLeft) {
  for (const MissionState state : {MissionState::kDescending, MissionState::kAborting}) {
    FlyWindow window(1920, 1080, fake::Snapshot(state));
    const std::vector<Item>& items = window.ui.items.items();
    const auto says = [&](const char* text) {
      return std::any_of(items.begin(), items.end(), [&](const Item& i) { return i.text == text; });
    };
    const bool left = state == MissionState::kAborting;
    EXPECT_EQ(says("Each new map"), !left);
    EXPECT_EQ(says("No more maps") && says("waved off"), left);
  }
}

TEST(FlyDescent, TheListOfChecksKeepsTheLeastClearOfTheDescent) {
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
    auto& rechecks = snap.flight.Edit().mission.rechecks;
    SiteRecheck check = rechecks.back();
    rechecks.clear();
    check.verdict = SiteVerdict::kHolds;
    for (double height_m = 22; height_m > 4; height_m -= 0.25) {
      check.height_above_site_m = height_m;
      check.safe_distance_m = height_m == 18.5 ? 0.3 : 0.9;
      rechecks.push_back(check);
    }
    FlyWindow window(size.width, size.height, snap);
    int least = 0;
    for (const Item& item : window.ui.items.items()) {
      least += item.name == "text" && item.text.rfind("0.3 m", 0) == 0 ? 1 : 0;
    }
    EXPECT_EQ(least, 1);
  }
}

TEST(FlyDescent, TheRecheckedMapAnswersToo) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kDescending));
  window.ui.explain = RoughCell;
  window.ui.MoveTo("map/recheck");
  window.Run(0.05);
  const Item* why = window.ui.items.Find("why");
  ASSERT_NE(why, nullptr);
  EXPECT_FALSE(Overlap(why->rect, window.ui.items.Find("hold_here")->rect));
}

TEST(FlyEvidence, SafeProbabilityNamesTheWorstHeading) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kArmed));
  EXPECT_EQ(window.ui.items.Find("evidence/Safe as seen")->text,
            "Safe as seen 0.998 at 040° min 0.900, guard");
}

}  // namespace
}  // namespace palace
