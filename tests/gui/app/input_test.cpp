// Keys on their way to ImGui.
#include "gui/app/input.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace palace
