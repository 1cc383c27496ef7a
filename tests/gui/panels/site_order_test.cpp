// The order of the list stays where the pointer is: a place does not slip away from under a press.
#include <algorithm>

#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

class SiteOrder : public testing::Test {
 protected:
  SiteOrder() : window(1920, 1080, fake::Snapshot(MissionState::kProposed)) {}
  float Top(const std::string& item) { return window.ui.items.Find(item)->rect.y; }
  /// The engine ranks B before A.
  void Swap() {
    auto decision = std::make_shared<TerrainDecision>(*window.snap.terrain->applied);
    std::swap(decision->selection.sites[0], decision->selection.sites[1]);
    window.snap.terrain.Edit().applied = decision;
    window.ui.Frame(window.draw);
  }
  FlyWindow window;
};

TEST_F(SiteOrder, StaysUnderThePointerAndSaysSo) {
  ASSERT_LT(Top("site/A"), Top("site/B"));
  window.ui.MoveTo("site/A");
  window.Run(0.1);
  Swap();
  EXPECT_LT(Top("site/A"), Top("site/B"));
  EXPECT_TRUE(HasText(window.ui.items, "Order held under the pointer"));
  EXPECT_EQ(window.ui.items.Find("site/best")->text, "B") << "what leads is what the engine says";
  window.ui.MoveTo(ImVec2(5, 5));
  window.Run(0.1);
  EXPECT_GT(Top("site/A"), Top("site/B"));
  EXPECT_FALSE(HasText(window.ui.items, "Order held"));
}

TEST_F(SiteOrder, FollowsTheEngineWhereNobodyPoints) {
  window.ui.MoveTo(ImVec2(5, 5));
  window.Run(0.1);
  Swap();
  EXPECT_GT(Top("site/A"), Top("site/B"));
}

TEST_F(SiteOrder, WhatIsGoneLeavesItsRoomAndWhatIsNewTakesItButUnderThePointer) {
  for (const bool pointed : {true, false}) {
    SCOPED_TRACE(pointed);
    FlyWindow list(1920, 1080, fake::Snapshot(MissionState::kProposed));
    const auto top = [&](const char* item) { return list.ui.items.Find(item)->rect.y; };
    list.ui.MoveTo(pointed ? "site/A" : "site/B");
    list.Run(0.1);
    const float a = top("site/A"), b = top("site/B"), c = top("site/C");
    auto decision = std::make_shared<TerrainDecision>(*list.snap.terrain->applied);
    auto& sites = decision->selection.sites;
    sites.front().id = 77;  // A is gone, K is new
    sites.front().letter = "K";
    list.snap.terrain.Edit().applied = decision;
    list.ui.Frame(list.draw);
    list.ui.Frame(list.draw);
    EXPECT_EQ(list.ui.items.Find("site/A"), nullptr);
    EXPECT_EQ(HasText(list.ui.items, "A is no longer listed"), pointed);
    EXPECT_EQ(top("site/B"), b);
    EXPECT_EQ(top("site/C"), c);
    const Item* fresh = list.ui.items.Find("site/K");
    EXPECT_TRUE(pointed ? fresh == nullptr || fresh->rect.y > c : fresh->rect.y == a);
    list.ui.MoveTo(ImVec2(5, 5));
    list.Run(0.1);
    EXPECT_FALSE(HasText(list.ui.items, "no longer listed"));
    EXPECT_EQ(top("site/K"), a) << "as the engine ranks them";
  }
}

}  // namespace
}  // namespace palace
