// A graphics context that is lost is replaced: the same picture stands again, made anew from the
// snapshot.
#include "gui/app/surface.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include "gui/app/view.h"
#include "gui/widgets/imgui_input.h"
#include "tests/support/expected.h"
#include "tests/support/fake_snapshot.h"

namespace palace {
namespace {

ImageRgba Drawn(Surface& surface, const EngineSnapshot& snapshot, const std::string& complaint) {
  const std::unique_ptr<View> view = View::Create("dark", nullptr).value();
  UiState state;
  ViewFrame frame{surface.width_px(), surface.height_px(), 1, 0};
  frame.complaint = complaint;
  for (int i = 0; i < 3; ++i) {
    view->Upload(snapshot, frame, state, INFINITY);
    surface.backend().BeginFrame(0.1);
    view->Draw(&snapshot, nullptr, state, surface.backend().fonts(), frame);
    surface.backend().EndFrame();
  }
  const Item* shown = view->items().Find("engine_complaint");
  EXPECT_EQ(shown != nullptr, !complaint.empty());
  EXPECT_TRUE(view->items().Find("wave_off")->enabled);
  return surface.ReadPixels();
}

bool Same(const ImageRgba& a, const ImageRgba& b) {
  return a.width() == b.width() && a.height() == b.height() && a.pixels() == b.pixels();
}

TEST(Surface, AfterTheContextIsGoneTheSamePictureIsMadeAnew) {
  AppOptions options;
  options.headless = true;
  options.width_px = 1280;
  options.height_px = 720;
  auto opened = Surface::Open(options);
  PALACE_REQUIRE_GL(opened);
  Surface& surface = **opened;
  const EngineSnapshot snapshot = fake::Snapshot(MissionState::kProposed);
  const ImageRgba before = Drawn(surface, snapshot, "");
  ASSERT_TRUE(surface.SetSize(1400, 800));
  ASSERT_TRUE(surface.Reopen());
  EXPECT_EQ(surface.width_px(), 1400) << "of the size that it had";
  ASSERT_TRUE(surface.SetSize(1280, 720));
  EXPECT_TRUE(Same(before, Drawn(surface, snapshot, "")));
}

TEST(Surface, AnEngineThatDoesNotAnswerIsNamedOverItsOldAlarms) {
  AppOptions options;
  options.headless = true;
  auto opened = Surface::Open(options);
  PALACE_REQUIRE_GL(opened);
  const EngineSnapshot snapshot = fake::Snapshot(MissionState::kDescending);
  const ImageRgba without = Drawn(**opened, snapshot, "");
  EXPECT_FALSE(Same(without, Drawn(**opened, snapshot, "Engine has not answered for 1.4 s")));
}

}  // namespace
}  // namespace palace
