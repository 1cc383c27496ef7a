#include "gui/panels/fly_panels.h"

#include <gtest/gtest.h>

#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

TEST(FlySites, AClickSelectsExactlyThatSiteOnce) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  window.ui.Click("site/B", window.draw);
  window.Run(0.5);
  EXPECT_EQ(window.ui.intents.size(), 1u);
  EXPECT_EQ(window.ui.CountCommands<SelectSite>(), 1);
  EXPECT_EQ(window.ui.LastCommand<SelectSite>().site_id, 2u);
}

TEST(FlySites, TabHighlightsAndEnterArmsTheHighlightedOne) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  for (int i = 0; i < 3; ++i) {
    window.ui.Tap(ImGuiKey_Tab, window.draw);
  }
  EXPECT_EQ(window.ui.highlighted_site, 3u);
  EXPECT_TRUE(window.ui.intents.empty());
  window.ui.Key(ImGuiKey_Enter, true);
  window.Run(1.5);  // held: arms once, never approves
  EXPECT_EQ(window.ui.CountCommands<SelectSite>(), 1);
  EXPECT_EQ(window.ui.LastCommand<SelectSite>().site_id, 3u);
  EXPECT_EQ(window.ui.CountCommands<ApproveSite>(), 0);
}

TEST(FlySites, NothingCanBeSelectedWhileSearching) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kSearch));
  window.ui.Click("site/A", window.draw);
  EXPECT_TRUE(window.ui.intents.empty());
}

/// Proposed, with A, the first of the list, refused before.
EngineSnapshot WithRefusedA(MissionState state) {
  EngineSnapshot snap = fake::Snapshot(state);
  snap.flight.Edit().mission.refused_sites = {1};
  return snap;
}

TEST(FlySites, ARefusedSiteIsListedAsSuchAndNeverTheBest) {
  FlyWindow window(1920, 1080, WithRefusedA(MissionState::kProposed));
  EXPECT_EQ(window.ui.items.Find("site/A")->text.rfind("A Refused ", 0), 0u)
      << window.ui.items.Find("site/A")->text;
  EXPECT_EQ(window.ui.items.Find("site/best")->text, "B");
  EXPECT_EQ(SiteInView(window.snap, 0)->letter, "B");
  EXPECT_EQ(MarksOf(window.snap, 0).selected->letter, "B");
  EXPECT_EQ(window.ui.items.Find("panel/Evidence for site B") != nullptr,
            window.ui.items.Find("panel/Evidence for site A") == nullptr);
  window.ui.Click("site/best", window.draw);
  EXPECT_EQ(window.ui.LastCommand<SelectSite>().site_id, 2u);
  window.ui.Click("site/A", window.draw);  // a deliberate second look
  EXPECT_EQ(window.ui.LastCommand<SelectSite>().site_id, 1u);
}

TEST(FlySites, WhileSearchingOnlyARefusedSiteMayBeLookedAtAgain) {
  FlyWindow window(1920, 1080, WithRefusedA(MissionState::kSearch));
  window.ui.Click("site/B", window.draw);
  EXPECT_TRUE(window.ui.intents.empty());
  window.ui.Click("site/A", window.draw);
  EXPECT_EQ(window.ui.LastCommand<SelectSite>().site_id, 1u);
}

TEST(FlySites, WithEverySiteRefusedNoneIsRinged) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  for (const LandingSite& site : snap.terrain->applied->selection.sites) {
    snap.flight.Edit().mission.refused_sites.push_back(site.id);
  }
  FlyWindow window(1920, 1080, snap);
  EXPECT_EQ(SiteInView(window.snap, 0), nullptr);
  EXPECT_EQ(window.ui.items.Find("site/best"), nullptr);
}

TEST(FlyFrame, WaveOffFiresOnPressAlsoUnderAPopupButNotInReplay) {
  FlyWindow live(1280, 720, fake::Snapshot(MissionState::kDescending));
  live.ui.popup = true;
  live.ui.MoveTo("wave_off");
  live.Run(0.05);
  live.ui.Button(true);
  live.ui.Frame(live.draw);
  EXPECT_EQ(live.ui.CountCommands<WaveOff>(), 1);
  live.Run(0.5);
  EXPECT_EQ(live.ui.CountCommands<WaveOff>(), 1);

  FlyWindow replay(1280, 720, fake::Snapshot(MissionState::kDescending, SourceKind::kReplay));
  replay.ui.Click("wave_off", replay.draw);
  EXPECT_TRUE(replay.ui.intents.empty());
  EXPECT_EQ(replay.ui.items.Find("wave_off")->text, "WAVE OFF | No link in replay");
}

TEST(FlyFrame, AcknowledgeRefuseAndHoldHereAskForWhatTheySay) {
  FlyWindow armed(1920, 1080, fake::Snapshot(MissionState::kArmed));
  armed.ui.Click("acknowledge", armed.draw);
  armed.ui.Click("refuse", armed.draw);
  EXPECT_EQ(armed.ui.LastCommand<AcknowledgeAlarm>().alarm, "gps_error");
  EXPECT_EQ(armed.ui.LastCommand<RefuseSite>().site_id, 1u);
  EXPECT_EQ(armed.ui.intents.size(), 2u);
  FlyWindow descending(1920, 1080, fake::Snapshot(MissionState::kDescending));
  descending.ui.Click("hold_here", descending.draw);
  EXPECT_EQ(descending.ui.CountCommands<HoldHere>(), 1);
}

TEST(FlyFrame, OnHoldItSaysWhetherThereIsAnythingToSelect) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kHold);
  for (const double age_s : {0.5, 30.0}) {
    auto map = std::make_shared<TerrainDecision>(*snap.terrain->applied);
    for (LandingSite& site : map->selection.sites) {
      site.age_s = age_s;
    }
    snap.terrain.Edit().applied = map;
    FlyWindow window(1920, 1080, snap);
    EXPECT_TRUE(HasText(window.ui.items, age_s < 2
                                             ? "Select a site once the vehicle has stopped."
                                             : "No site in view: wave off to look from above."));
  }
}

TEST(FlyFrame, OnHoldACheckThatFailsSaysWhyNothingCanBeSelected) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kHold);
  for (GuardResult& guard : snap.flight.Edit().mission.guards) {
    if (guard.id == GuardId::kCameras) {
      guard.pass = false;
      guard.reason = "Both cameras repeat their pictures";
    }
  }
  FlyWindow window(1920, 1080, snap);
  EXPECT_TRUE(
      HasText(window.ui.items, "Both cameras repeat their pictures: no site can be selected."));
}

// The bars and the white figures of a map are of what is.
TEST(FlyFrame, OfAnOldMapTheSitesLimitsAreGreyAndOfTheirAge) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  const auto slope = [&] {
    FlyWindow window(1920, 1080, snap);
    return window.ui.items.Find("evidence/Slope")->text;
  };
  EXPECT_EQ(slope().find(" old"), std::string::npos) << slope();
  snap.time = AddSeconds(snap.terrain->applied->map_time, 8.8);
  EXPECT_NE(slope().find("; 8.8 s old"), std::string::npos) << slope();
}

TEST(FlyMaps, DraggingTheLimitTickSetsTheLimitOnceItIsAnswered) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  window.ui.MoveTo("tick/slad.max_slope_deg");
  window.Run(0.05);
  const ImVec2 at = ImGui::GetIO().MousePos;
  window.ui.Button(true);
  window.Run(0.05);
  window.ui.MoveTo(ImVec2{at.x - 26.4f, at.y});  // a tenth of the 264 px bar: 2 degrees of 20
  window.Run(0.05);
  window.ui.Button(false);
  window.Run(0.05);
  window.ui.Click("tick_set", window.draw);
  EXPECT_EQ(window.ui.LastCommand<SetSetting>().name, "slad.max_slope_deg");
  EXPECT_NEAR(window.ui.LastCommand<SetSetting>().value, 8.0, 0.11);
}

TEST(FlyMaps, ProbeFollowsThePointerAndAClickPinsItUntilTheNext) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  const std::string at_site = window.ui.items.Find("map/slope")->text;
  window.ui.Click("map/slope", window.draw);
  window.ui.MoveTo(ImVec2(5, 5));
  window.Run(0.1);
  ASSERT_TRUE(window.fly.maps.probe.pinned.has_value());
  const GridGeometry& g = window.snap.terrain->applied->hazards->geometry;
  const auto cell = ProbeCell(window.fly.maps.probe, g);
  ASSERT_TRUE(cell.has_value());
  EXPECT_NEAR(cell->row, g.rows / 2, 1);
  EXPECT_NEAR(cell->col, g.cols / 2, 1);
  window.ui.Click("map/cost", window.draw);  // the same place on another map
  window.ui.MoveTo(ImVec2(5, 5));
  window.Run(0.1);
  EXPECT_FALSE(window.fly.maps.probe.pinned.has_value());
  EXPECT_EQ(window.ui.items.Find("map/slope")->text, at_site);
}

TEST(FlyPictures, AVerdictOlderThanThePictureIsNotExplainedButDated) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  FlyWindow fresh(1920, 1080, snap);
  EXPECT_TRUE(HasText(fresh.ui.items, "Over a limit or unknown"));
  EXPECT_FALSE(HasText(fresh.ui.items, "Last map"));
  auto old = std::make_shared<TerrainDecision>(*snap.terrain->applied);
  old->map_time = AddSeconds(snap.sensors->frame ? snap.sensors->frame->time : snap.time, -4.2);
  snap.terrain.Edit().applied = old;
  FlyWindow late(1920, 1080, snap);
  EXPECT_TRUE(HasText(late.ui.items, "Last map 4.2 s old"));
  EXPECT_FALSE(HasText(late.ui.items, "Over a limit or unknown"));
}

/// The row of the list, to be changed by a test.
LimitRow& RowOf(EngineSnapshot& snap, LimitId id) {
  for (LimitRow& row : snap.flight.Edit().mission.limits) {
    if (row.id == id) {
      return row;
    }
  }
  ADD_FAILURE() << "no such row";
  return snap.flight.Edit().mission.limits.front();
}

TEST(FlyLimits, ShowWhoActsAndCountWhatTheEngineCallsOver) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  {
    FlyWindow window(1920, 1080, snap);
    EXPECT_TRUE(HasText(window.ui.items, "All inside"));
    EXPECT_EQ(window.ui.items.Find("evidence/Off the path")->text,
              "Off the path 0.14 ± 0.13 m max 1.2 m, alarm");
    EXPECT_EQ(window.ui.items.Find("evidence/Slope")->text, "Slope 1.9 ± 0.3° max 10°, guard");
  }
  // Beyond its limit but for information: neither a wall nor a count.
  LimitRow& wind = RowOf(snap, LimitId::kWind);
  wind.value = 12;
  wind.enforced_by = EnforcedBy::kNobody;
  {
    FlyWindow window(1920, 1080, snap);
    EXPECT_TRUE(HasText(window.ui.items, "All inside"));
    EXPECT_EQ(window.ui.items.Find("evidence/Wind")->text, "Wind 12.0 m/s for information");
  }
  RowOf(snap, LimitId::kOffPath).over = true;
  {
    FlyWindow window(1920, 1080, snap);
    EXPECT_TRUE(HasText(window.ui.items, "1 over a limit"));
  }
}

TEST(FlyLimits, AfterLandingAnUnlockedTrackerIsUnknownNotOverALimit) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kLanded);
  RowOf(snap, LimitId::kCoherence).value = NAN;
  FlyWindow window(1920, 1080, snap);
  EXPECT_NE(window.ui.items.Find("evidence/Coherence")->text.find("––"), std::string::npos);
  EXPECT_TRUE(HasText(window.ui.items, "None in force"));
  const std::string slope = window.ui.items.Find("evidence/Slope")->text;
  EXPECT_NE(slope.find("max 10"), std::string::npos) << slope;
  EXPECT_FALSE(HasText(window.ui.items, "1 over a limit"));
}

TEST(FlyPictures, ViewAndCameraLieWhereTheLayoutSays) {
  for (const ImVec2 size : {ImVec2(1280, 720), ImVec2(1920, 1080)}) {
    FlyWindow window(size.x, size.y, fake::Snapshot(MissionState::kProposed));
    const FlyLayout layout = ComputeFlyLayout(size.x, size.y, 1, false);
    const auto same = [](const Rect& a, const Rect& b) {
      return a.x == b.x && a.y == b.y && a.w == b.w && a.h == b.h;
    };
    EXPECT_TRUE(
        same(window.ui.items.Find("view_3d")->rect, View3dScene(layout.view_3d, window.ui.style)));
    EXPECT_TRUE(same(window.ui.items.Find("left_camera")->rect,
                     LeftCameraImage(window.snap, layout.left_camera, window.ui.style)));
  }
}

struct TextCase {
  const char* name;
  float width, height, scale;
  MissionState state;
  SourceKind kind;
  double silent_s = 0;
};
class FlyText : public testing::TestWithParam<TextCase> {};

TEST_P(FlyText, StaysInItsPanelAndTouchesNoOther) {
  const TextCase& c = GetParam();
  FlyWindow window(c.width, c.height, fake::Snapshot(c.state, c.kind), c.scale);
  window.silent_s = c.silent_s;
  window.Run(0.05);
  ExpectTextsInPanels(window.ui.items);
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, FlyText,
    testing::Values(
        TextCase{"armed1920", 1920, 1080, 1, MissionState::kArmed, SourceKind::kLive},
        TextCase{"armed1280", 1280, 720, 1, MissionState::kArmed, SourceKind::kLive},
        TextCase{"armed1600", 1600, 900, 1, MissionState::kArmed, SourceKind::kSimulation},
        TextCase{"armed3840", 3840, 2160, 2, MissionState::kArmed, SourceKind::kLive},
        TextCase{"proposedReplay", 1280, 720, 1, MissionState::kProposed, SourceKind::kReplay},
        TextCase{"descent1920", 1920, 1080, 1, MissionState::kDescending, SourceKind::kSimulation},
        TextCase{"descent1280", 1280, 720, 1, MissionState::kDescending, SourceKind::kSimulation},
        TextCase{"silent1280", 1280, 720, 1, MissionState::kArmed, SourceKind::kLive, 12.3},
        TextCase{"landed1920", 1920, 1080, 1, MissionState::kLanded, SourceKind::kSimulation},
        TextCase{"aborting1920", 1920, 1080, 1, MissionState::kAborting, SourceKind::kLive}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(FlyEmpty, ASnapshotWithNothingInItIsDrawnWithoutValues) {
  FlyWindow window(1920, 1080, EngineSnapshot{});
  window.Run(0.1);
  EXPECT_TRUE(window.ui.intents.empty());
  EXPECT_FALSE(window.ui.items.Find("approve")->enabled);
}

TEST(ChannelStrip, TellsTheVehiclesRatesHoweverSeldomThisStationLooks) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  for (const double silent_s : {0.0, 0.22, 0.45, 0.8}) {
    SCOPED_TRACE(silent_s);
    window.silent_s = silent_s;
    window.Run(0.05);
    const Item* imu = window.ui.items.Find("channel/IMU");
    ASSERT_NE(imu, nullptr);
    EXPECT_EQ(imu->text.find("200 Hz") != std::string::npos, silent_s <= 0.5) << imu->text;
    const bool behind = std::any_of(
        window.ui.items.items().begin(), window.ui.items.items().end(),
        [](const Item& item) { return item.text.rfind("Screen 0.8 s behind", 0) == 0; });
    EXPECT_EQ(behind, silent_s > 0.5);
  }
}

TEST(StatusBar, CountsPicturesThatWereOvertaken) {
  for (const std::uint64_t replaced : {0, 1, 31}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
    snap.session.Edit().losses.pairs_replaced = replaced;
    for (const ImVec2 size : {ImVec2(1280, 720), ImVec2(1920, 1080)}) {
      SCOPED_TRACE(size.x);
      FlyWindow window(size.x, size.y, snap);
      std::string said;
      for (const Item& item : window.ui.items.items()) {
        if (item.name == "text" && item.text.find("overtaken") != std::string::npos) {
          said = item.text;
        }
      }
      EXPECT_EQ(said, replaced == 0   ? ""
                      : replaced == 1 ? "1 pair overtaken"
                                      : "31 pairs overtaken");
    }
  }
}

}  // namespace
}  // namespace palace
