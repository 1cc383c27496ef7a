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

TEST_F(SiteOrder, WhatIsNewComesLastAndWhatIsGoneLeaves) {
  window.ui.MoveTo("site/B");
  window.Run(0.1);
  auto decision = std::make_shared<TerrainDecision>(*window.snap.terrain->applied);
  auto& sites = decision->selection.sites;
  LandingSite fresh = sites[0];
  fresh.id = 77;
  fresh.letter = "K";
  sites.erase(sites.begin());
  sites.insert(sites.begin(), fresh);
  window.snap.terrain.Edit().applied = decision;
  window.ui.Frame(window.draw);
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.ui.items.Find("site/A"), nullptr);
  EXPECT_LT(Top("site/B"), Top("site/C"));
  const Item* row = window.ui.items.Find("site/K");
  EXPECT_TRUE(row == nullptr || row->rect.y > Top("site/C")) << "scrolled out of sight, or last";
}

}  // namespace
}  // namespace palace
