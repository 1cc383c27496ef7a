// Sites of a preview and sites of the mission are never mixed; without a site none is drawn.
#include <algorithm>

#include "gui/panels/fly_panels.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

/// A preview with another order, and a place that the flight never listed.
EngineSnapshot WithPreview(MissionState state) {
  EngineSnapshot snap = fake::Snapshot(state);
  TerrainDecision preview = *snap.terrain->applied;
  auto& sites = preview.selection.sites;
  std::rotate(sites.begin(), sites.begin() + 1, sites.end());
  sites.front().id = kFirstUnnamedSite + 1;
  sites.front().letter = "+1";
  snap.terrain.Edit().preview = std::make_shared<const TerrainDecision>(preview);
  return snap;
}

EngineSnapshot Flown(const EngineSnapshot& snap) {
  std::optional<EngineSnapshot> kept;
  return AsFlown(snap, kept);
}

// What a preview shows is named and commanded nowhere on Fly; maps and pictures that show it say
// so.
TEST(Preview, LeavesTheSitesOfFlyToTheMission) {
  for (const MissionState state : {MissionState::kProposed, MissionState::kArmed,
                                   MissionState::kDescending, MissionState::kLanded}) {
    for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
      SCOPED_TRACE(MissionStateWord(state));
      FlyWindow window(size.x, size.y, Flown(WithPreview(state)));
      for (const Item& item : window.ui.items.items()) {
        EXPECT_EQ(item.text.find("+1 "), std::string::npos) << item.name << ": " << item.text;
        EXPECT_NE(item.text, "+1") << item.name;
        EXPECT_NE(item.name, "site/+1");
        EXPECT_NE(item.text.rfind("applied ", 0), 0u) << item.text;
      }
      EXPECT_EQ(SiteInView(window.snap, 0)->letter, "A");
      const bool listed = state < MissionState::kDescending;
      EXPECT_EQ(HasText(window.ui.items, "PREVIEW"), listed);
      EXPECT_EQ(HasText(window.ui.items, "Applied, not the preview"), listed);
      ExpectTextsInPanels(window.ui.items);
    }
  }
}

// A vehicle on its way down is watched on the maps that it is held by.
TEST(Preview, IsNotDrawnOverADescent) {
  for (const MissionState state : {MissionState::kProposed, MissionState::kArmed}) {
    EXPECT_NE(Flown(WithPreview(state)).terrain->preview, nullptr) << MissionStateWord(state);
  }
  for (const MissionState state : {MissionState::kDescending, MissionState::kHold,
                                   MissionState::kAborting, MissionState::kLanded}) {
    const EngineSnapshot snap = WithPreview(state);
    const EngineSnapshot flown = Flown(snap);
    EXPECT_EQ(flown.terrain->preview, nullptr) << MissionStateWord(state);
    EXPECT_EQ(flown.terrain->applied, snap.terrain->applied);
    EXPECT_NE(snap.terrain->preview, nullptr) << "what Tune shows";
  }
}

TEST(Preview, ACommandOnFlyNamesASiteOfTheMission) {
  FlyWindow window(1920, 1080, WithPreview(MissionState::kProposed));
  window.ui.Click("site/best", window.draw);
  EXPECT_EQ(window.ui.LastCommand<SelectSite>().site_id, 1u);
  window.ui.Click("letter/picture/B", window.draw);
  EXPECT_EQ(window.ui.LastCommand<SelectSite>().site_id, 2u);
}

TEST(Preview, IsDiscardedWhereItIsShown) {
  for (const MissionState state : {MissionState::kProposed, MissionState::kArmed}) {
    FlyWindow window(1920, 1080, WithPreview(state));
    const auto chip =
        std::find_if(window.ui.items.items().begin(), window.ui.items.items().end(),
                     [](const Item& item) { return item.name.rfind("discard_preview/", 0) == 0; });
    ASSERT_NE(chip, window.ui.items.items().end());
    window.ui.Click(std::string(chip->name), window.draw);
    ASSERT_EQ(window.ui.intents.size(), 1u);
    const auto* command = std::get_if<CommandAction>(&window.ui.intents.front());
    ASSERT_NE(command, nullptr);
    EXPECT_TRUE(std::holds_alternative<DiscardSettings>(*command));
  }
}

// Nothing was approved, or what was is forgotten: no site is the one that is landed on, and while
// the vehicle climbs away none is proposed.
TEST(WaveOffWithoutASite, DrawsNone) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kAborting);
  MissionStatus& mission = snap.flight.Edit().mission;
  mission.armed.reset();
  mission.armed_limits.clear();
  mission.approval.reset();
  EXPECT_FALSE(MarksOf(snap, 0).commanded);
  EXPECT_FALSE(MarksOf(snap, 0).selected.has_value());
  FlyWindow window(1920, 1080, snap);
  EXPECT_EQ(window.ui.items.Find("ring"), nullptr);
  EXPECT_EQ(window.ui.items.Find("landing_ring"), nullptr);
  EXPECT_EQ(SiteInView(snap, 0), nullptr);
  snap.flight.Edit().mission.state = MissionState::kHold;
  EXPECT_FALSE(MarksOf(snap, 0).commanded);
  EXPECT_TRUE(MarksOf(fake::Snapshot(MissionState::kAborting), 0).commanded);
}

}  // namespace
}  // namespace palace
