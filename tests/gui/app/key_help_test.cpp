// The list behind F1 shows every key of the table, whole.
#include "gui/app/key_help.h"

#include <gtest/gtest.h>

#include "gui/app/keys.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

TEST(KeyHelp, EveryKeyIsListedWithItsWholeDescriptionInsideTheBox) {
  for (const float scale : {1.0f, 1.5f}) {
    UiHarness ui(1920, 1080, scale);
    ui.Frame([](UiFrame& frame) { DrawKeyHelp({0, 0, 1920, 1080}, frame); });
    const Rect box = ui.items.Find("key_help")->rect;
    const auto inside = [&](const std::string& words) {
      for (const Item& item : ui.items.items()) {
        if (item.name == "text" && item.text == words && item.rect.right() < box.right() &&
            item.rect.bottom() < box.bottom()) {
          return true;
        }
      }
      return false;
    };
    for (const KeyBinding& binding : KeyTable()) {
      EXPECT_TRUE(inside(binding.keys)) << binding.keys;
      EXPECT_TRUE(inside(binding.description)) << binding.description;
    }
  }
}

TEST(KeyHelp, SaysHowToApproveWithoutAMouse) {
  bool said = false;
  for (const KeyBinding& binding : KeyTable()) {
    said = said || (binding.keys == "Enter held" && binding.description.rfind("Approve", 0) == 0);
  }
  EXPECT_TRUE(said);
}

}  // namespace
}  // namespace palace
