// Nothing is left out unsaid: axes hold what is plotted, rows without room are counted and reached.
#include <cmath>

#include "gui/panels/fly_panels.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

// The axis holds what is plotted: a climb is no empty plot.
TEST(Plots, AClimbAndALostTrackStayOnTheirAxes) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  auto history = *snap.flight->history;
  for (std::size_t i = history.size() - 50; i < history.size(); ++i) {
    history[i].descent_rate_mps = -1.9;
    history[i].coherence = 0.12;
    history[i].residual_sigma = 6.5;
    history[i].glide_deviation_m = 3.1;
  }
  snap.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
  for (const PlotView& plot : DescentPlots(snap, Palette{})) {
    SCOPED_TRACE(plot.name);
    for (const PlotTrace& series : plot.series) {
      for (const ImVec2& point : series.points) {
        if (std::isfinite(point.y)) {
          ASSERT_GE(point.y, plot.y_min);
          ASSERT_LE(point.y, plot.y_max);
        }
      }
    }
  }
  EXPECT_EQ(DescentPlots(snap, Palette{})[2].y_min, -2.0f);
}

void Wheel(FlyWindow& window, const char* item, float turns) {
  window.ui.MoveTo(item);
  window.ui.Frame(window.draw);
  FeedMouseWheel(turns);
  window.ui.Frame(window.draw);
  window.ui.Frame(window.draw);
}

// What has no room is counted, and the wheel brings it.
TEST(Rows, ThatHaveNoRoomAreCountedAndReached) {
  const struct {
    MissionState state;
    const char* panel;
    const char* rows;
    const char* hidden;
  } cases[] = {
      {MissionState::kArmed, "Evidence for site A", "evidence_rows", "evidence/Unknown cells"},
      {MissionState::kDescending, "Limits in force", "limit_rows", "evidence/Largest step"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.panel);
    FlyWindow window(1280, 720, fake::Snapshot(c.state));
    EXPECT_TRUE(HasText(window.ui.items, " rows"));
    EXPECT_EQ(window.ui.items.Find(c.hidden), nullptr);
    Wheel(window, c.rows, -20);
    const Item* row = window.ui.items.Find(c.hidden);
    ASSERT_NE(row, nullptr);
    EXPECT_TRUE(Inside(row->rect, window.ui.items.Find(std::string("panel/") + c.panel)->rect));
    ExpectTextsInPanels(window.ui.items);
  }
  EXPECT_EQ(
      FlyWindow(1920, 1080, fake::Snapshot(MissionState::kArmed)).ui.items.Find("evidence_rows"),
      nullptr);
}

}  // namespace
}  // namespace palace
