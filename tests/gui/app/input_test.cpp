// Keys on their way to ImGui.
#include "gui/app/input.h"

#include <utility>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "gui/widgets/button.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

TEST(ShortTaps, AKeyThatWentDownAndUpBetweenTwoFramesIsSeenOnce) {
#if IMGUI_VERSION_NUM >= 18900
  GTEST_SKIP()
      << "runs with Dear ImGui before 1.89 (Debian 12); later ones take events and miss none";
#endif
  UiHarness ui(200, 100);
  const auto nothing = [](UiFrame&) {};
  ui.Frame(nothing);
  std::vector<ImGuiKey> held;
  const auto seen = [&](const std::vector<KeyEvent>& events) {
    bool pressed = false;
    FeedShortTaps(events, held);
    ui.Frame([&](UiFrame&) { pressed = KeyPressed(ImGuiKey_Backspace, false); });
    return pressed;
  };
  const KeyEvent down{GLFW_KEY_BACKSPACE, 0, KeyAction::kPress, ""};
  const KeyEvent up{GLFW_KEY_BACKSPACE, 0, KeyAction::kRelease, ""};
  EXPECT_TRUE(seen({down, up}));
  EXPECT_FALSE(seen({}));
  EXPECT_FALSE(KeyDown(ImGuiKey_Backspace));
  EXPECT_FALSE(seen({down}));  // still down: the window's own backend says so
  EXPECT_FALSE(seen({up}));
  EXPECT_TRUE(seen({down, up, down, up}));
}

// Of a frame that took long: the press counts where it happened, not where the pointer went to.
TEST(Pointer, AClickWhosePointerLeftWithinAFrameIsOfTheButtonItWasOn) {
  const PointerEvent arrives{20, 20}, press{20, 20, 0, true}, release{20, 20, 0, false},
      leaves{150, 20};
  PointerQueue queue;
  queue.Add({arrives, press, release, leaves});
  for (const PointerEvent& expected : {press, release, leaves}) {
    const std::optional<PointerEvent> seen = queue.Take();
    ASSERT_TRUE(seen.has_value());
    EXPECT_FLOAT_EQ(seen->x, expected.x);
    EXPECT_EQ(seen->button, expected.button);
    EXPECT_EQ(seen->down, expected.down);
  }
  EXPECT_FALSE(queue.waiting());
  EXPECT_FALSE(queue.Take().has_value());
}

TEST(Pointer, PressesTheButtonThatItWasOn) {
#if IMGUI_VERSION_NUM >= 18900
  GTEST_SKIP() << "runs with Dear ImGui before 1.89 (Debian 12); later ones take events";
#endif
  UiHarness ui(200, 100);
  PointerQueue queue;
  int on_left = 0, on_right = 0;
  const auto draw = [&](UiFrame& frame) {
    on_left += DrawButton(frame, "left", {0, 0, 80, 40}, "Left") ? 1 : 0;
    on_right += DrawButton(frame, "right", {100, 0, 80, 40}, "Right") ? 1 : 0;
  };
  ui.Frame(draw);
  std::vector<PointerEvent> events = {{20, 20}, {20, 20, 0, true}, {20, 20, 0, false}, {150, 20}};
  for (int frame = 0; frame < 6; ++frame) {
    FeedPointer(std::exchange(events, {}), queue);
    ui.Frame(draw);
  }
  EXPECT_EQ(on_left, 1);
  EXPECT_EQ(on_right, 0);
}

}  // namespace
}  // namespace palace
