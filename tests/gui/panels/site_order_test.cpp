// The order of the list stays where the pointer is: a place does not slip away from under a press.
#include <algorithm>

#include "gui/widgets/imgui_input.h"
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
    window.ui.Frame(window.draw);  // that it is held is said in the frame after
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

// Whatever row is pointed at, how far the list is scrolled and whatever goes: under the pointer
// lies what lay there, or nothing to press.
TEST_F(SiteOrder, NoOtherSiteEverComesUnderThePointer) {
  std::vector<LandingSite> sites = window.snap.terrain->applied->selection.sites;
  while (sites.size() < 6) {
    sites.push_back(sites.back());
    sites.back().id = 50 + sites.size();
    sites.back().letter = std::string(1, static_cast<char>('A' + sites.size() - 1));
  }
  const auto show = [&](const std::vector<LandingSite>& listed) {
    auto decision = std::make_shared<TerrainDecision>(*window.snap.terrain->applied);
    decision->selection.sites = listed;
    window.snap.terrain.Edit().applied = decision;
    window.ui.Frame(window.draw);
  };
  int pointed_at = 0;
  for (const float scrolled : {0.0F, 9.0F}) {
    for (const unsigned gone : {1U, 8U, 32U, 33U, 56U, 31U, 62U, 63U}) {  // bits of A to F
      for (const char* pointed : {"site/A", "site/B", "site/C", "site/D", "site/E", "site/F"}) {
        window.ui.MoveTo(ImVec2(5, 5));
        show(sites);
        window.ui.MoveTo("panel/Sites");
        FeedMouseWheel(9 - 2 * scrolled);  // to its beginning, or to its end
        window.ui.Frame(window.draw);
        const Item* row = window.ui.items.Find(pointed);
        if (row == nullptr || row->rect.h < 1) {
          continue;  // out of sight
        }
        window.ui.MoveTo(pointed);
        window.ui.Frame(window.draw);
        ++pointed_at;
        std::vector<LandingSite> left;
        for (std::size_t i = 0; i < sites.size(); ++i) {
          if ((gone >> i & 1U) == 0) {
            left.push_back(sites[i]);
          }
        }
        for (const bool with_fresh : {false, true}) {
          if (with_fresh) {
            left.push_back(sites[0]);
            left.back().id = 77;
            left.back().letter = "K";
          }
          show(left);
          for (const LandingSite& site : left) {
            const Item* now = window.ui.items.Find("site/" + site.letter);
            if (now != nullptr && now->rect.Contains(ImGui::GetIO().MousePos)) {
              EXPECT_EQ("site/" + site.letter, pointed) << "scrolled " << scrolled << ", " << gone;
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(pointed_at, 2 * 8 * 4) << "four of six rows are in sight";
}

}  // namespace
}  // namespace palace
