// Figures on the screen claim what was measured, and no more.
#include "gui/panels/fly_panels.h"
#include "gui/panels/tune/tune.h"
#include "gui/widgets/number_text.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

TEST(Maps, ASizeLostInItsNoiseIsToldByWhatItIsBelow) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  auto decision = std::make_shared<TerrainDecision>(*snap.terrain->applied);
  auto hazards = std::make_shared<HazardMaps>(*decision->hazards);
  const Cell cell = decision->selection.sites[0].cell;
  hazards->roughness_m.at(cell) = 0.0f;
  hazards->roughness_sigma_m.at(cell) = 0.02f / 3;
  hazards->slope_rad.at(cell) = static_cast<float>(Rad(2.1));
  hazards->slope_sigma_rad.at(cell) = static_cast<float>(Rad(0.1));
  decision->hazards = hazards;
  decision->selection.sites[0].roughness_m = {0, 0.02};
  snap.terrain.Edit().applied = decision;
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    FlyWindow window(size.x, size.y, snap);
    EXPECT_TRUE(HasText(window.ui.items, "< 2.0 cm"));
    EXPECT_TRUE(HasText(window.ui.items, "2.1°"));
    EXPECT_FALSE(HasText(window.ui.items, "0.0 cm"));
    ExpectTextsInPanels(window.ui.items);
  }
}

TEST(TuneCells, AreTheClassesOfTheGround) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  auto decision = std::make_shared<TerrainDecision>(*snap.terrain->applied);
  auto hazards = std::make_shared<HazardMaps>(*decision->hazards);
  hazards->counts = {};
  hazards->counts[GroundClass::kLandable] = 2527;
  hazards->counts[GroundClass::kHazard] = 600;
  hazards->counts[GroundClass::kTooNear] = 400;
  hazards->counts[GroundClass::kFootprint] = 73;
  hazards->counts[GroundClass::kUnknown] = 6400;
  hazards->rejected = {.slope = 404,
                       .roughness = 96,
                       .unknown = 6400,
                       .flagged = 60,
                       .doubtful = 40,
                       .footprint = 473};
  decision->hazards = hazards;
  snap.terrain.Edit().applied = decision;
  const auto cells = [&](const Rect& rect, const char* name) {
    UiHarness ui(1920, 1080);
    ui.Frame([&](UiFrame& f) { DrawCellsPanel(snap, rect, f); });
    const Item* item = ui.items.Find(std::string("cells/") + name);
    return item != nullptr ? item->text : std::string("none");
  };
  const Rect tall{0, 0, 400, 190}, low{0, 0, 400, 136};
  for (const Rect& rect : {tall, low}) {
    EXPECT_EQ(cells(rect, "Safe to land on"), Fixed(2527, 0));
    EXPECT_EQ(cells(rect, "Too near a hazard"), "400");
    EXPECT_EQ(cells(rect, "Over a limit under the lander"), "73");
    EXPECT_EQ(cells(rect, "Unknown"), Fixed(6400, 0));
  }
  EXPECT_EQ(cells(tall, "Over slope"), "404");
  EXPECT_EQ(cells(tall, "Over roughness"), "96");
  EXPECT_EQ(cells(tall, "Flagged"), "60");
  EXPECT_EQ(cells(tall, "Not sure enough"), "40");
  EXPECT_EQ(cells(low, "Hazard"), "600");
}

TEST(Plots, AfterTheLandingNoFigureDriftsOn) {
  const EngineSnapshot landed = fake::Snapshot(MissionState::kLanded);
  for (const PlotView& plot : DescentPlots(landed, Palette{})) {
    EXPECT_EQ(plot.current, "landed") << plot.name;
  }
}

// However long ago it was: the last minute before the touchdown stays to be read.
TEST(Plots, TheDescentStaysAfterTheLanding) {
  EngineSnapshot landed = fake::Snapshot(MissionState::kLanded);
  auto history = *landed.flight->history;
  ASSERT_GT(history.size(), 20U);
  const std::array<PlotView, 6> at_once = DescentPlots(landed, Palette{});
  for (int i = 1; i <= 3000; ++i) {  // five minutes on the ground
    HistorySample sample = history.back();
    sample.time = AddSeconds(sample.time, 0.1);
    sample.state = MissionState::kLanded;
    sample.height_above_site_m = 99;
    history.push_back(sample);
  }
  landed.time = history.back().time;
  landed.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
  const std::array<PlotView, 6> later = DescentPlots(landed, Palette{});
  for (std::size_t i = 0; i < later.size(); ++i) {
    SCOPED_TRACE(later[i].name);
    const auto& before = at_once[i].series[0].points;
    const auto& after = later[i].series[0].points;
    ASSERT_EQ(after.size(), before.size());
    EXPECT_FLOAT_EQ(after.back().x, 0);
    EXPECT_TRUE(after.back().y == before.back().y || std::isnan(before.back().y));
    EXPECT_EQ(later[i].zero, "touchdown");
  }
}

// Without a position nothing is said of its error, and what was plotted before stays.
TEST(Plots, TheDistanceKeepsItsPastWhenThePositionIsLost) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  auto history = *snap.flight->history;
  const std::size_t lost = 10;
  ASSERT_GT(history.size(), 2 * lost);
  for (std::size_t i = history.size() - lost; i < history.size(); ++i) {
    history[i].p_WS = Eigen::Vector3d::Constant(NAN);
    history[i].from_site_m = NAN;
  }
  snap.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
  const PlotView plot = DescentPlots(snap, Palette{})[1];
  EXPECT_EQ(plot.current, "––");
  const auto& points = plot.series[0].points;
  EXPECT_TRUE(std::isfinite(points[points.size() - lost - 1].y));
  EXPECT_TRUE(std::isnan(points.back().y));
}

TEST(Landed, ElsewhereThanOnTheSiteIsNotOnTheSite) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kLanded);
  MissionStatus& m = snap.flight.Edit().mission;
  m.armed->clear_radius_m = 2.3;
  m.touchdown_miss_m = 2.2;
  EXPECT_TRUE(HasText(FlyWindow(1920, 1080, snap).ui.items, "Landed on site A"));
  m.touchdown_miss_m = 7.68;
  m.why = "Vehicle says it is on the ground, 7.7 m from the centre of site A and 6.1 m above it";
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    FlyWindow window(size.x, size.y, snap);
    EXPECT_TRUE(HasText(window.ui.items, "Not on site A"));
    EXPECT_TRUE(HasText(window.ui.items, "Vehicle says it is on the ground"));
    EXPECT_FALSE(HasText(window.ui.items, "Landed on site"));
    ExpectTextsInPanels(window.ui.items);
  }
}

TEST(Plots, TheEstimateEndsAtTouchdownTheTruthGoesOn) {
  EngineSnapshot landed = fake::Snapshot(MissionState::kLanded);
  auto history = *landed.flight->history;
  ASSERT_GT(history.size(), 20u);
  for (std::size_t i = 0; i < history.size(); ++i) {
    history[i].state = i + 12 < history.size() ? MissionState::kDescending : MissionState::kLanded;
  }
  landed.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
  const PlotView distance = DescentPlots(landed, Palette{})[1];
  const PlotTrace &estimate = distance.series[0], &truth = distance.series[1];
  EXPECT_EQ(estimate.points.size() + 12, truth.points.size());
  EXPECT_EQ(estimate.band.size(), estimate.points.size());
  EXPECT_LT(estimate.points.back().x, truth.points.back().x);
}

TEST(Evidence, ASizeLostInItsNoiseIsToldByWhatItIsBelow) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  MissionStatus& m = snap.flight.Edit().mission;
  m.armed->roughness_m = {0, 0.02};
  m.armed->step_m = {0.026, 0.007};
  m.armed_limits = SiteLimits(*m.armed, snap.session->settings.slad);
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    FlyWindow window(size.x, size.y, snap);
    EXPECT_EQ(window.ui.items.Find("evidence/Roughness")->text,
              "Roughness under 2.0 cm max 10 cm, guard");
    ExpectTextsInPanels(window.ui.items);
  }
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("evidence/Largest step")->text,
            "Largest step 2.6 ± 0.7 cm max 15 cm, guard");
}

TEST(Evidence, TellsHowFarUpTheAirOverTheSiteWasSeen) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  MissionStatus& m = snap.flight.Edit().mission;
  m.armed->air_seen_m = 6.43;
  m.armed_limits = SiteLimits(*m.armed, snap.session->settings.slad);
  const FlyWindow window(1920, 1080, snap);
  const auto* row = window.ui.items.Find("evidence/Air over it seen");
  ASSERT_NE(row, nullptr);
  EXPECT_EQ(row->text, "Air over it seen 6.4 m min 5 m, guard");
  ExpectTextsInPanels(window.ui.items);
}

}  // namespace
}  // namespace palace
