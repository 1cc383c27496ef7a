#include "gui/widgets/hold_button.h"

#include <gtest/gtest.h>

#include "tests/support/ui_harness.h"

namespace palace {
namespace {

/// One hold on a screenless button.
class HoldButton : public testing::Test {
 protected:
  void Run(double seconds) {
    for (double t = 0; t < seconds - 1e-9; t += 1.0 / 60) {
      ui.Frame([&](UiFrame& frame) {
        fired += DrawHoldButton(frame, "approve", {100, 100, 268, 68}, view, state) ? 1 : 0;
      });
    }
  }
  void PressInside() {
    ui.MoveTo(ImVec2{200, 130});
    Run(0.05);
    ui.Button(true);
  }
  UiHarness ui{800, 600};
  HoldButtonView view{HoldPhase::kReady, "Hold to approve A", "", 7, 1.0};
  HoldState state;
  int fired = 0;
};

TEST_F(HoldButton, NineTenthsOfASecondDoNotFireAndTheButtonSaysSo) {
  PressInside();
  Run(0.9);
  ui.Button(false);
  Run(0.1);
  EXPECT_EQ(fired, 0);
  EXPECT_NE(ui.items.Find("approve")->text.find("Hold the full 1.0 s."), std::string::npos);
  Run(3.1);
  EXPECT_EQ(ui.items.Find("approve")->text, "Hold to approve A | 1.0 s · mouse or Enter");
}

TEST_F(HoldButton, ElevenTenthsFireExactlyOnceUntilPressedAgain) {
  PressInside();
  Run(1.1);
  EXPECT_EQ(fired, 1);
  Run(3);
  EXPECT_EQ(fired, 1);
}

TEST_F(HoldButton, SlidingOffCancelsAndComingBackDoesNotResume) {
  PressInside();
  Run(0.8);
  ui.MoveTo(ImVec2{500, 130});
  Run(0.1);
  ui.MoveTo(ImVec2{200, 130});
  Run(2);
  EXPECT_EQ(fired, 0);
}

TEST_F(HoldButton, AnotherSiteCancels) {
  PressInside();
  Run(0.8);
  view.subject = 8;
  Run(2);
  EXPECT_EQ(fired, 0);
}

TEST_F(HoldButton, APopupCancels) {
  PressInside();
  Run(0.8);
  ui.popup = true;
  Run(0.1);
  ui.popup = false;
  Run(2);
  EXPECT_EQ(fired, 0);
}

TEST_F(HoldButton, BecomingBlockedCancelsAndBlockedNeverFires) {
  PressInside();
  Run(0.8);
  view.phase = HoldPhase::kBlocked;
  view.reason = "Left camera stale, 1.8 s";
  Run(2);
  EXPECT_EQ(fired, 0);
  EXPECT_EQ(ui.items.Find("approve")->text, "Cannot approve | Left camera stale, 1.8 s");
  EXPECT_FALSE(ui.items.Find("approve")->enabled);
  view.phase = HoldPhase::kReady;  // the finger never left: still no approval
  Run(2);
  EXPECT_EQ(fired, 0);
}

TEST_F(HoldButton, PressedBeforeItIsReadySaysThatItHasToBeReleased) {
  for (const bool by_key : {false, true}) {
    view.phase = HoldPhase::kBlocked;
    view.reason = "Site on screen for 0.6 s, min 1.0 s";
    Run(0.05);
    if (by_key) {
      ui.MoveTo(ImVec2{500, 400});
      ui.focus.Show("approve");
      Run(0.05);
      ui.Key(ImGuiKey_Enter, true);
    } else {
      PressInside();
    }
    Run(0.5);
    EXPECT_EQ(ui.items.Find("approve")->text, "Cannot approve | " + view.reason);
    view.phase = HoldPhase::kReady;
    view.reason.clear();
    Run(2);
    EXPECT_EQ(fired, 0);
    EXPECT_EQ(ui.items.Find("approve")->text, "Hold to approve A | Release first, then hold");
    by_key ? ui.Key(ImGuiKey_Enter, false) : ui.Button(false);
    Run(0.05);
    EXPECT_EQ(ui.items.Find("approve")->text, "Hold to approve A | 1.0 s · mouse or Enter");
  }
}

TEST_F(HoldButton, EnterHeldWithFocusFiresAndWithoutFocusDoesNot) {
  Run(0.05);
  ui.Key(ImGuiKey_Enter, true);
  Run(1.5);
  EXPECT_EQ(fired, 0);
  ui.focus.Show("approve");  // a key already down when the focus came does not count
  Run(1.5);
  EXPECT_EQ(fired, 0);
  ui.Key(ImGuiKey_Enter, false);
  Run(0.05);
  ui.Key(ImGuiKey_Enter, true);
  Run(1.1);
  EXPECT_EQ(fired, 1);
}

TEST_F(HoldButton, EscapeCancelsByMouseAndByKeyAndIsTaken) {
  PressInside();
  Run(0.6);
  ui.Key(ImGuiKey_Escape, true);
  Run(1.0 / 60);
  EXPECT_TRUE(ui.focus.escape_taken());
  ui.Key(ImGuiKey_Escape, false);
  Run(2);  // the finger never left
  EXPECT_EQ(fired, 0);
  ui.Button(false);
  ui.focus.Show("approve");
  Run(0.05);
  ui.Key(ImGuiKey_Enter, true);
  Run(0.6);
  ui.Key(ImGuiKey_Escape, true);
  Run(2);
  EXPECT_EQ(fired, 0);
}

TEST_F(HoldButton, AnEscapeWithoutAHoldIsLeftToOthers) {
  Run(0.05);
  ui.Key(ImGuiKey_Escape, true);
  Run(1.0 / 60);
  EXPECT_FALSE(ui.focus.escape_taken());
}

TEST(HoldStateMachine, ALostWindowFocusCancels) {
  HoldState state;
  HoldInput in;
  in.pointer_inside = in.mouse_pressed = in.mouse_down = true;
  EXPECT_FALSE(AdvanceHold(state, in));
  in.mouse_pressed = false;
  in.now_s = 0.5;
  in.window_focused = false;
  EXPECT_FALSE(AdvanceHold(state, in));
  in.window_focused = true;
  in.now_s = 2;
  EXPECT_FALSE(AdvanceHold(state, in));
  EXPECT_FALSE(state.holding);
}

}  // namespace
}  // namespace palace
