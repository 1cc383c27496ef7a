// One control takes the pointer at a time; the keyboard reaches every one, in order.
#include "gui/widgets/interact.h"

#include <map>

#include <gtest/gtest.h>

#include "tests/support/ui_harness.h"

namespace palace {
namespace {

constexpr Rect kLeft{100, 100, 80, 40}, kRight{200, 100, 80, 40};

/// Controls of one screen, in the order in which they interact, and how often each was clicked.
class Controls : public testing::Test {
 protected:
  struct Control {
    std::string name;
    Rect rect;
    unsigned flags = 0;
    TabPlace place{};
  };
  void Frame() {
    ui.Frame([this](UiFrame& frame) {
      for (const Control& c : shown) {
        frame.tab = c.place;
        last[c.name] = Interact(frame, c.name, c.rect, c.flags);
        clicks[c.name] += last[c.name].clicked ? 1 : 0;
      }
      if (overlay.w > 0) {
        BeginOverlay("##overlay", overlay);
        EndOverlay();
      }
    });
  }
  void Point(ImVec2 at, bool down) {
    ui.MoveTo(at);
    ui.Button(down);
    Frame();
  }
  void Tap(ImGuiKey key, bool shift = false) {
    FeedModifiers(shift, false);
    ui.Key(key, true);
    Frame();
    ui.Key(key, false);
    FeedModifiers(false, false);
    Frame();
  }
  std::string Focused() const { return std::string(ui.focus.shown()); }

  UiHarness ui{800, 600};
  std::vector<Control> shown = {{"left", kLeft}, {"right", kRight}};
  Rect overlay{};
  std::map<std::string, Interaction> last;
  std::map<std::string, int> clicks;
};

TEST_F(Controls, AClickIsAPressAndAReleaseOnTheSameControl) {
  Frame();
  Point(kLeft.centre(), false);
  Point(kLeft.centre(), true);
  EXPECT_TRUE(last["left"].pressed);
  EXPECT_TRUE(last["left"].held);
  EXPECT_EQ(clicks["left"], 0);
  Point(kLeft.centre(), false);
  EXPECT_EQ(clicks["left"], 1);
  Point(kLeft.centre(), true);
  Point(kRight.centre(), true);  // slides off to another
  EXPECT_TRUE(last["left"].held);
  EXPECT_FALSE(last["right"].hovered);
  Point(kRight.centre(), false);
  EXPECT_EQ(clicks["left"], 1);
  EXPECT_EQ(clicks["right"], 0);
}

TEST_F(Controls, WhatAppearsUnderAHeldPointerDoesNotFire) {
  Frame();
  Point(kLeft.centre(), false);
  Point(kLeft.centre(), true);
  shown[0].name = "new";
  Frame();
  Frame();
  Point(kLeft.centre(), false);
  EXPECT_EQ(clicks["new"], 0);
  Point(kLeft.centre(), true);  // a press of its own does
  Point(kLeft.centre(), false);
  EXPECT_EQ(clicks["new"], 1);
}

TEST_F(Controls, WhatBecomesEnabledUnderAHeldPointerDoesNotFire) {
  shown[0].flags = kDisabled;
  Frame();
  Point(kLeft.centre(), false);
  Point(kLeft.centre(), true);
  shown[0].flags = 0;
  Frame();
  Point(kLeft.centre(), false);
  EXPECT_EQ(clicks["left"], 0);
}

TEST_F(Controls, OfTwoThatOverlapTheFirstHasThePointer) {
  shown = {{"button", {110, 110, 20, 20}}, {"picture", kLeft}};
  Frame();
  Point({115, 115}, false);
  Point({115, 115}, true);
  Point({115, 115}, false);
  EXPECT_EQ(clicks["button"], 1);
  EXPECT_EQ(clicks["picture"], 0);
}

TEST_F(Controls, AnOverlayShieldsWhatLiesUnderIt) {
  Frame();
  overlay = kLeft;
  Frame();
  Frame();
  Point(kLeft.centre(), false);
  EXPECT_FALSE(last["left"].hovered);
  Point(kLeft.centre(), true);
  Point(kLeft.centre(), false);
  EXPECT_EQ(clicks["left"], 0);
  Point(kRight.centre(), false);
  Point(kRight.centre(), true);
  Point(kRight.centre(), false);
  EXPECT_EQ(clicks["right"], 1);
}

TEST_F(Controls, OnPressFiresWhenThePointerGoesDown) {
  shown[0].flags = kOnPress;
  Frame();
  Point(kLeft.centre(), false);
  Point(kLeft.centre(), true);
  EXPECT_EQ(clicks["left"], 1);
  Point(kLeft.centre(), false);
  EXPECT_EQ(clicks["left"], 1);
}

TEST_F(Controls, APopupBlocksAllButWhatWorksOverIt) {
  shown[1].flags = kOverPopup | kOnPress;
  ui.popup = true;
  Frame();
  for (const Rect& rect : {kLeft, kRight}) {
    Point(rect.centre(), false);
    Point(rect.centre(), true);
    Point(rect.centre(), false);
  }
  EXPECT_EQ(clicks["left"], 0);
  EXPECT_EQ(clicks["right"], 1);
  Tap(ImGuiKey_Tab);
  EXPECT_EQ(Focused(), "");
}

TEST_F(Controls, APassiveAreaSeesThePointerAndLeavesItToTheControlsOnIt) {
  shown = {{"area", {90, 90, 300, 80}, kPassive}, {"left", kLeft}};
  Frame();
  Point(kLeft.centre(), false);
  EXPECT_TRUE(last["area"].hovered);
  Point(kLeft.centre(), true);
  Point(kLeft.centre(), false);
  EXPECT_EQ(clicks["left"], 1);
  EXPECT_EQ(ui.items.Find("area"), nullptr);
}

TEST_F(Controls, EnterAndSpacePressTheFocusedOneOnceAndOnlyWithTheRing) {
  Frame();
  Tap(ImGuiKey_Enter);
  EXPECT_EQ(clicks["left"] + clicks["right"], 0);
  Tap(ImGuiKey_Tab);
  EXPECT_EQ(Focused(), "left");
  ASSERT_NE(ui.items.Find("focus"), nullptr);
  EXPECT_EQ(ui.items.Find("focus")->text, "left");
  ui.Key(ImGuiKey_Enter, true);
  for (int i = 0; i < 120; ++i) {  // held: once
    Frame();
  }
  ui.Key(ImGuiKey_Enter, false);
  Frame();
  EXPECT_EQ(clicks["left"], 1);
  Tap(ImGuiKey_Space);
  EXPECT_EQ(clicks["left"], 2);
  Point(kRight.centre(), false);
  Point(kRight.centre(), true);  // the mouse hides the ring
  Point(kRight.centre(), false);
  EXPECT_EQ(Focused(), "");
  Tap(ImGuiKey_Space);
  EXPECT_EQ(clicks["right"], 1);
}

TEST_F(Controls, TabGoesThroughTheGroupsAndBackAndPastDisabledOnes) {
  shown = {{"bar", kLeft, 0, {kFrameTabs, {}}},
           {"picture", kLeft, 0, {kViewTabs, {}}},
           {"first", kRight, 0, {}},
           {"off", kRight, kDisabled, {}},
           {"hold", kRight, kDisabled | kKeepsStop, {}},
           {"own_key", kRight, kNoTab, {}}};
  Frame();
  for (const char* name : {"first", "hold", "picture", "bar", "first"}) {
    Tap(ImGuiKey_Tab);
    EXPECT_EQ(Focused(), name);
  }
  for (const char* name : {"bar", "picture", "hold", "first"}) {
    Tap(ImGuiKey_Tab, true);
    EXPECT_EQ(Focused(), name);
  }
}

TEST_F(Controls, AListIsOneStopEnteredWhereItWasLeft) {
  const TabPlace list{kDecisionTabs, "rows"};
  shown = {{"before", kLeft, 0, {}},
           {"row/1", kLeft, 0, list},
           {"row/2", kLeft, kSideSteps, list},
           {"row/3", kLeft, 0, list},
           {"after", kRight, 0, {}}};
  Frame();
  Tap(ImGuiKey_Tab);
  Tap(ImGuiKey_Tab);
  EXPECT_EQ(Focused(), "row/1");
  Tap(ImGuiKey_DownArrow);
  EXPECT_EQ(Focused(), "row/2");
  Tap(ImGuiKey_Tab);
  EXPECT_EQ(Focused(), "after");
  Tap(ImGuiKey_Tab, true);
  EXPECT_EQ(Focused(), "row/2");
  Tap(ImGuiKey_DownArrow);
  Tap(ImGuiKey_DownArrow);  // the end stays
  EXPECT_EQ(Focused(), "row/3");
  Tap(ImGuiKey_UpArrow);
  EXPECT_EQ(Focused(), "row/2");
}

TEST_F(Controls, ArrowsStepFineAndWithShiftCoarse) {
  shown[0].flags = kAllSteps;
  Frame();
  Tap(ImGuiKey_Tab);
  const auto step = [&](ImGuiKey key, bool shift) {
    FeedModifiers(shift, false);
    ui.Key(key, true);
    Frame();
    const Interaction in = last["left"];
    ui.Key(key, false);
    FeedModifiers(false, false);
    Frame();
    return std::pair(in.step_right, in.step_up);
  };
  EXPECT_EQ(step(ImGuiKey_RightArrow, false), std::pair(1, 0));
  EXPECT_EQ(step(ImGuiKey_LeftArrow, true), std::pair(-10, 0));
  EXPECT_EQ(step(ImGuiKey_UpArrow, false), std::pair(0, 1));
  EXPECT_EQ(step(ImGuiKey_DownArrow, true), std::pair(0, -10));
}

TEST_F(Controls, AClickMovesTheStartOfTabAndAnArmedSiteItsNextStop) {
  shown = {{"a", kLeft}, {"b", kRight}, {"c", {300, 100, 80, 40}}};
  Frame();
  Point(kRight.centre(), false);
  Point(kRight.centre(), true);
  Point(kRight.centre(), false);
  Tap(ImGuiKey_Tab);
  EXPECT_EQ(Focused(), "c");
  ui.focus.TabLandsOn("b");
  EXPECT_EQ(Focused(), "");
  Tap(ImGuiKey_Tab);
  EXPECT_EQ(Focused(), "b");
}

}  // namespace
}  // namespace palace
