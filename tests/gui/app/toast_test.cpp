// A toast hides no figure: bars, readouts, channels and buttons stay in sight beside it.
#include "gui/app/toast.h"

#include <gtest/gtest.h>

#include "gui/app/layout.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

const char* const kRefusals[] = {
    "Site A refused", "Refuse refused: Select a site first",
    "Fly there refused: What stands on the way leaves 1.6 m below the skids, min 3.0 m",
    "Approve refused: Wind 9.2 m/s, max 8.0 m/s; the air over it was seen up to 3.0 m, min 5.0 m"};

TEST(Toast, HidesNoFigureOnFly) {
  for (const ImVec2 size : {ImVec2(1024, 576), ImVec2(1024, 768), ImVec2(1280, 720),
                            ImVec2(1366, 768), ImVec2(1600, 900), ImVec2(1920, 1080)}) {
    for (const MissionState state : {MissionState::kProposed, MissionState::kDescending}) {
      for (const char* words : kRefusals) {
        SCOPED_TRACE(std::to_string(size.x) + " " + words);
        const auto scale = static_cast<float>(
            FittingScale(static_cast<double>(size.x), static_cast<double>(size.y), 1));
        FlyWindow window(size.x, size.y, fake::Snapshot(state), scale);
        const FlyLayout fly =
            ComputeFlyLayout(static_cast<double>(size.x), static_cast<double>(size.y),
                             static_cast<double>(scale), state == MissionState::kDescending);
        window.ui.Frame([&](UiFrame& ui) {
          window.draw(ui);
          DrawToast(ToastRoom(fly, ui.style), words, ui);
        });
        const Item* toast = window.ui.items.Find("toast");
        ASSERT_NE(toast, nullptr);
        EXPECT_TRUE(Inside(toast->rect, fly.view_3d));
        for (const Item& item : window.ui.items.items()) {
          const bool told = item.name.rfind("readout/", 0) == 0 || item.name.rfind("tick/", 0) == 0;
          EXPECT_FALSE(told && Touch(item.rect, toast->rect)) << item.name;
          if (item.name == "text" && Touch(item.rect, toast->rect)) {
            EXPECT_TRUE(Inside(item.rect, toast->rect)) << item.text;
          }
        }
      }
    }
  }
}

TEST(Toast, ElsewhereStandsBesideTheRightColumn) {
  for (const ImVec2 size : {ImVec2(1280, 720), ImVec2(1920, 1080)}) {
    UiHarness ui(size.x, size.y);
    const FrameLayout frame =
        ComputeFrameLayout(static_cast<double>(size.x), static_cast<double>(size.y), 1);
    ui.Frame([&](UiFrame& f) { DrawToast(ToastRoom(frame, f.style), kRefusals[2], f); });
    const Rect& toast = ui.items.Find("toast")->rect;
    EXPECT_TRUE(Inside(toast, frame.body));
    EXPECT_LE(toast.right(), frame.body.right() - (frame.narrow ? 360 : 432));
    EXPECT_EQ(toast.h, 44);
  }
}

}  // namespace
}  // namespace palace
