// What the screen shows is marked as what it is: the landing site in every workspace, maps that are
// old, ages that grow in silence, sizes that drown in noise, limits that are only asked for.
#include "gui/panels/diagnose/diagnose.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/terrain_views.h"
#include "gui/panels/tune/tune.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

/// A flight to C while the newest map ranks A first.
EngineSnapshot FliesToC(MissionState state) {
  EngineSnapshot snap = fake::Snapshot(state);
  snap.flight.Edit().mission.armed = snap.terrain->applied->selection.sites[2];
  return snap;
}

TEST(LandingSite, IsMarkedOnTuneAndDiagnoseWhateverTheMapRanksFirst) {
  const struct {
    MissionState state;
    const char* word;
  } table[] = {{MissionState::kArmed, "Selected C"},
               {MissionState::kDescending, "Landing on C"},
               {MissionState::kHold, "Was to land on C"},
               {MissionState::kLanded, "Landed on C"}};
  for (const auto& row : table) {
    SCOPED_TRACE(row.word);
    const EngineSnapshot snap = FliesToC(row.state);
    UiHarness tune(1920, 1080);
    for (ImTextureID* id : {&tune.textures.left_camera, &tune.textures.maps[4]}) {
      *id = &tune;
    }
    TuneState state;
    tune.Frame([&](UiFrame& f) { DrawTuneWorkspace(snap, BodyOf(1920, 1080), state, f); });
    ASSERT_NE(tune.items.Find("landing_ring"), nullptr);
    EXPECT_EQ(tune.items.Find("landing_ring")->text, "C");
    EXPECT_EQ(tune.items.Find("ring")->text, "A");
    EXPECT_TRUE(HasText(tune.items, row.word));
    EXPECT_NE(tune.items.Find("landing_on_map/safe_distance"), nullptr);
    UiHarness diagnose(1920, 1080);
    DiagnoseState diagnose_state;
    diagnose.Frame(
        [&](UiFrame& f) { DrawDiagnoseWorkspace(snap, BodyOf(1920, 1080), diagnose_state, f); });
    EXPECT_TRUE(HasText(diagnose.items, row.word));
  }
}

TEST(LandingSite, ThatIsAlsoTheBestIsMarkedOnce) {
  const EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  UiHarness tune(1920, 1080);
  tune.textures.left_camera = &tune;
  TuneState state;
  tune.Frame([&](UiFrame& f) { DrawTuneWorkspace(snap, BodyOf(1920, 1080), state, f); });
  EXPECT_NE(tune.items.Find("ring"), nullptr);
  EXPECT_EQ(tune.items.Find("landing_ring"), nullptr);
}

TEST(Letters, OnThePictureAndOnEveryMapSelectTheirSite) {
  for (const char* item : {"letter/picture/B", "letter/map/slope/B", "letter/map/cost/B"}) {
    SCOPED_TRACE(item);
    FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
    window.ui.Frame(window.draw);
    ASSERT_NE(window.ui.items.Find(item), nullptr);
    window.ui.Click(item, window.draw);
    EXPECT_EQ(window.ui.LastCommand<SelectSite>().site_id, 2U);
    EXPECT_FALSE(window.fly.maps.probe.pinned.has_value());
  }
}

TEST(Letters, OfTheRingStandBesideItOnTheMapsAtEverySizeAndSelectItsSite) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    for (const char* item :
         {"letter/map/slope/A", "letter/map/safe_distance/A", "letter/map/slope/B"}) {
      SCOPED_TRACE(item);
      FlyWindow window(size.x, size.y, fake::Snapshot(MissionState::kProposed));
      ASSERT_NE(window.ui.items.Find(item), nullptr);
      window.ui.Click(item, window.draw);
      EXPECT_EQ(window.ui.CountCommands<SelectSite>(), 1);
      EXPECT_FALSE(window.fly.maps.probe.pinned.has_value());
    }
  }
}

TEST(Letters, OfTheRingSelectsItsSiteAndAMapClickBesideThemPins) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  window.ui.Click("letter/picture/A", window.draw);
  EXPECT_EQ(window.ui.LastCommand<SelectSite>().site_id, 1U);
  const Rect map = window.ui.items.Find("map/slope")->rect;
  window.ui.MoveTo(ImVec2{map.x + 12, map.bottom() - 12});
  window.Run(0.05);
  window.ui.Button(true);
  window.Run(0.05);
  window.ui.Button(false);
  window.Run(0.05);
  EXPECT_TRUE(window.fly.maps.probe.pinned.has_value());
}

TEST(Letters, SelectNothingWhereNothingMayBeSelected) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed, SourceKind::kReplay));
  EXPECT_FALSE(window.ui.items.Find("letter/picture/B")->enabled);
  window.ui.Click("letter/picture/B", window.draw);
  EXPECT_EQ(window.ui.CountCommands<SelectSite>(), 0);
}

/// A site of the list moves to where a point of a window of that size shows it.
void MoveSiteTo(ImVec2 point, ImVec2 size, std::size_t index, EngineSnapshot& snap) {
  const FlyLayout layout =
      ComputeFlyLayout(static_cast<double>(size.x), static_cast<double>(size.y), 1, false);
  const UiHarness sizes(size.x, size.y);
  const Rect image = LeftCameraImage(snap, layout.left_camera, sizes.style);
  const PinholeCamera camera = fake::Camera();
  const Eigen::Vector2d pixel((point.x - image.x) / image.w * camera.width,
                              (point.y - image.y) / image.h * camera.height);
  const Eigen::Vector3d ray_C((pixel.x() - camera.cx_px) / camera.fx_px,
                              (pixel.y() - camera.cy_px) / camera.fy_px, 1);
  auto decision = std::make_shared<TerrainDecision>(*snap.terrain->applied);
  decision->selection.sites[index].p_WS = snap.sensors->X_WC * Eigen::Vector3d(ray_C * 38);
  snap.terrain.Edit().applied = decision;
}

TEST(Legend, HidesNoRing) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
    const Rect before = FlyWindow(size.x, size.y, snap).ui.items.Find("legend")->rect;
    // The ring reaches below it, its letter stands beside it.
    MoveSiteTo({before.right() - 4, before.bottom() + 8}, size, 0, snap);
    FlyWindow window(size.x, size.y, snap);
    const Item* ring = window.ui.items.Find("ring");
    ASSERT_NE(ring, nullptr);
    EXPECT_TRUE(Touch(ring->rect, before)) << size.x;
    EXPECT_FALSE(Touch(ring->rect, window.ui.items.Find("legend")->rect)) << size.x;
  }
}

TEST(Legend, HidesNoLetterOfASite) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
    const Rect before = FlyWindow(size.x, size.y, snap).ui.items.Find("legend")->rect;
    MoveSiteTo({before.x + 12, before.y + 12}, size, 1, snap);
    FlyWindow window(size.x, size.y, snap);
    const Rect after = window.ui.items.Find("legend")->rect;
    int letters = 0;
    for (const Item& item : window.ui.items.items()) {
      if (item.name == "site_mark") {
        ++letters;
        EXPECT_FALSE(Touch(item.rect, after)) << item.text << " at " << size.x;
      }
    }
    EXPECT_GE(letters, 2);
  }
}

// A legend that moves whenever a letter has passed cannot be read.
TEST(Legend, StaysWhereItIsWhileItHidesNothingAndCoversNoButton) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    const EngineSnapshot as_it_was = fake::Snapshot(MissionState::kProposed);
    FlyWindow window(size.x, size.y, as_it_was);
    const Rect before = window.ui.items.Find("legend")->rect;
    MoveSiteTo({before.x + 12, before.y + 12}, size, 1, window.snap);
    window.ui.Frame(window.draw);
    const Rect after = window.ui.items.Find("legend")->rect;
    EXPECT_FALSE(Touch(before, after)) << size.x;
    EXPECT_FALSE(Touch(after, window.ui.items.Find("depth")->rect)) << size.x;
    if (size.x < 1920) {
      continue;  // a ring fills so small a picture: where none hides it a legend goes
    }
    window.snap = as_it_was;
    window.ui.Frame(window.draw);
    const Rect later = window.ui.items.Find("legend")->rect;
    EXPECT_EQ(later.x, after.x);
    EXPECT_EQ(later.y, after.y);
  }
}

/// The words of the flags stand somewhere, over no letter and not over the other plate.
void ExpectFlagsNamed(const ItemRecord& items) {
  const Item *words = items.Find("flag_legend"), *hatches = items.Find("legend");
  ASSERT_NE(words, nullptr);
  ASSERT_NE(hatches, nullptr);
  EXPECT_FALSE(Touch(words->rect, hatches->rect));
  for (const Item& item : items.items()) {
    EXPECT_FALSE(item.name == "site_mark" && Touch(item.rect, words->rect)) << item.text;
  }
}

// What a triangle or a cross means must be read where it is drawn: over dense ground letters stand
// in most corners.
TEST(Legend, NamesTheFlagsThatOccurBesideLetters) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  const FlyWindow free(1920, 1080, snap);
  ExpectFlagsNamed(free.ui.items);
  const Rect before = free.ui.items.Find("flag_legend")->rect;
  MoveSiteTo({before.x + 12, before.centre().y + 8}, {1920, 1080}, 1, snap);
  ExpectFlagsNamed(FlyWindow(1920, 1080, snap).ui.items);
  // A small picture has no room for them in a row.
  ExpectFlagsNamed(FlyWindow(1280, 720, fake::Snapshot(MissionState::kLanded)).ui.items);
}

// The letter of the leading site stands beside its ring's cross, where a neighbour's may be.
TEST(Letters, OfTheLeadingSiteCoversNoNeighbour) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
    FlyWindow before(size.x, size.y, snap);
    const Rect leader = before.ui.items.Find("letter/picture/A")->rect;
    MoveSiteTo(leader.centre(), size, 1, snap);
    FlyWindow window(size.x, size.y, snap);
    int neighbours = 0;
    for (const Item& item : window.ui.items.items()) {
      if (item.name == "site_mark" && item.text != "A") {
        neighbours += Touch(item.rect, leader);
        EXPECT_FALSE(Touch(item.rect, window.ui.items.Find("letter/picture/A")->rect)) << size.x;
      }
    }
    EXPECT_EQ(neighbours, 1) << size.x;
    window.ui.Click("letter/picture/B", window.draw);
    EXPECT_EQ(window.ui.CountCommands<SelectSite>(), 1) << size.x;
  }
}

TEST(Maps, ALetterOfTwoCharactersStaysInItsMark) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  auto decision = std::make_shared<TerrainDecision>(*snap.terrain->applied);
  decision->selection.sites[1].letter = "W5";  // the widest
  snap.terrain.Edit().applied = decision;
  FlyWindow window(1920, 1080, snap);
  const float half = LetterHalfWidth(window.ui.style, "W5", 9);
  int marks = 0;
  for (const Item& item : window.ui.items.items()) {
    const bool mark = item.name == "site_mark" || item.name.rfind("letter/map/", 0) == 0;
    if (!mark || item.text != "W5") {
      continue;
    }
    ++marks;
    const float x = item.rect.centre().x, y = item.rect.centre().y;
    for (const Item& text : window.ui.items.items()) {
      if (text.name == "text" && text.text == "W5" && item.rect.Contains(text.rect.centre())) {
        EXPECT_TRUE(Inside(text.rect, {x - half, y - 9, 2 * half, 18}, 0)) << item.name;
      }
    }
  }
  EXPECT_GE(marks, 2);
}

TEST(Maps, NameTheSiteThatTheEvidenceNames) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  window.ui.highlighted_site = 3;
  window.ui.Frame(window.draw);
  window.ui.highlighted_site = 3;
  window.ui.Frame(window.draw);
  EXPECT_TRUE(HasText(window.ui.items, "Evidence for site C"));
  for (const char* map : {"Slope", "Roughness", "Safe distance"}) {
    const Rect panel = window.ui.items.Find(std::string("panel/") + map)->rect;
    const Rect head{panel.x, panel.y, panel.w, 28};
    int letters = 0;
    for (const Item& item : window.ui.items.items()) {
      letters += item.name == "text" && item.text == "C" && Inside(item.rect, head) ? 1 : 0;
    }
    EXPECT_EQ(letters, 1) << map;
  }
}

/// Drags the tick of the slope map by some pixels.
void DragTick(FlyWindow& window, float dx) {
  window.ui.MoveTo("tick/slad.max_slope_deg");
  window.Run(0.05);
  const ImVec2 from = window.ui.items.Find("tick/slad.max_slope_deg")->rect.centre();
  window.ui.Button(true);
  window.Run(0.05);
  window.ui.MoveTo(ImVec2{from.x + dx, from.y});
  window.Run(0.05);
  window.ui.Button(false);
  window.Run(0.05);
}

TEST(LimitTickOnFly, AsksBeforeItMovesALimit) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    SCOPED_TRACE(size.x);
    FlyWindow window(size.x, size.y, fake::Snapshot(MissionState::kProposed));
    DragTick(window, -20);
    EXPECT_EQ(window.ui.CountCommands<SetSetting>(), 0);
    ASSERT_NE(window.ui.items.Find("tick_question"), nullptr);
    EXPECT_TRUE(HasText(window.ui.items, "Applies at once"));
    window.ui.Click("tick_keep", window.draw);
    window.Run(0.05);
    EXPECT_EQ(window.ui.CountCommands<SetSetting>(), 0);
    EXPECT_EQ(window.ui.items.Find("tick_question"), nullptr);
    DragTick(window, -20);
    window.ui.Click("tick_set", window.draw);
    window.Run(0.05);
    ASSERT_EQ(window.ui.CountCommands<SetSetting>(), 1);
    EXPECT_LT(window.ui.LastCommand<SetSetting>().value, 10);
    EXPECT_EQ(window.ui.items.Find("tick_question"), nullptr);
  }
}

TEST(LimitTickOnFly, SaysInTheDescentThatNothingIsApplied) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kDescending));
  window.fly.tab = PlotTab::kMaps;
  window.ui.Frame(window.draw);
  DragTick(window, -20);
  EXPECT_TRUE(HasText(window.ui.items, "Only a preview: the descent keeps its limits."));
  EXPECT_FALSE(HasText(window.ui.items, "applied on Tune"));
}

TEST(OldMap, IsVeiledAndConfirmsNothing) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  {
    FlyWindow fresh(1920, 1080, snap);
    EXPECT_EQ(fresh.ui.items.Find("old/slope"), nullptr);
    EXPECT_TRUE(HasText(fresh.ui.items, "Confirmed"));
  }
  snap.time = AddSeconds(snap.terrain->applied->map_time, 11);
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    FlyWindow old(size.x, size.y, snap);
    for (const char* key : {"elevation", "slope", "roughness", "cost", "safe_distance"}) {
      const Item* item = old.ui.items.Find(std::string("old/") + key);
      ASSERT_NE(item, nullptr) << key;
      EXPECT_EQ(item->text, "11.0 s old");
    }
    EXPECT_FALSE(HasText(old.ui.items, "Confirmed"));
    EXPECT_TRUE(HasText(old.ui.items, "Old map"));
    EXPECT_TRUE(HasText(old.ui.items, "Map 11.0 s old"));
    ExpectTextsInPanels(old.ui.items);
  }
}

// Nothing is approved on ground last measured so long ago, whatever it was called then.
TEST(SiteRow, OfGroundThatLeftTheViewIsNotCalledConfirmed) {
  for (const auto& [age_s, word] :
       {std::pair{1.9, "Confirmed"}, std::pair{2.1, "Not all in view"}}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
    auto decision = std::make_shared<TerrainDecision>(*snap.terrain->applied);
    for (LandingSite& site : decision->selection.sites) {
      site.confirmed = true;
      site.age_s = age_s;
    }
    snap.terrain.Edit().applied = decision;
    for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
      FlyWindow window(size.x, size.y, snap);
      EXPECT_EQ(HasText(window.ui.items, "Confirmed"), word == std::string("Confirmed"));
      EXPECT_TRUE(HasText(window.ui.items, word));
      ExpectTextsInPanels(window.ui.items);
    }
  }
}

TEST(WaveOffPanel, SaysThatTheVehicleIsSilentAndStaysOffered) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  ChannelHealth& status = snap.sensors.Edit().channels[6];
  status.state = ChannelHealth::State::kStale;
  status.age_s = 4.2;
  FlyWindow window(1280, 720, snap);
  EXPECT_EQ(window.ui.items.Find("wave_off")->text, "WAVE OFF | Silent for 4.2 s");
  window.ui.Click("wave_off", window.draw);
  EXPECT_EQ(window.ui.CountCommands<WaveOff>(), 1);
}

TEST(Ages, GrowWhileNothingIsPublished) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  UiHarness ui(1920, 1080);
  FlyState fly;
  FrameState bar;
  const auto draw = [&](double silent_s) {
    ui.Frame([&](UiFrame& f) {
      f.silent_s = silent_s;
      const FlyLayout layout = ComputeFlyLayout(1920, 1080, 1, false);
      DrawFrameBar(snap, layout.frame, bar, f);
      DrawFlyWorkspace(snap, layout, fly, f);
    });
  };
  draw(0);
  EXPECT_EQ(ui.items.Find("channel/IMU")->text, "4 ms   200 Hz");
  draw(7);
  EXPECT_EQ(ui.items.Find("channel/IMU")->text, "7.0 s   –– Hz");
  EXPECT_TRUE(HasText(ui.items, "Frozen 10.2 s ago"));
  EXPECT_TRUE(HasText(ui.items, "Link 7.0 s"));
}

TEST(Plots, UncertaintyThatIsNotKnownFillsThePlotAndAnEndIsHatched) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  auto history = *snap.flight->history;
  history.back().estimate_sigma_m = Eigen::Vector3d::Constant(NAN);
  snap.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
  EXPECT_GT(DescentPlots(snap, Palette{})[0].series[0].band.back(), 1000.0f);
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("plot_unknown/height"), nullptr);
  for (std::size_t i = history.size() - 50; i < history.size(); ++i) {
    history[i].height_above_site_m = NAN;
  }
  snap.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
  EXPECT_NE(FlyWindow(1920, 1080, snap).ui.items.Find("plot_unknown/height"), nullptr);
}

TEST(SiteList, SaysThatMoreSitesAreBelow) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  auto decision = std::make_shared<TerrainDecision>(*snap.terrain->applied);
  for (int i = 0; i < 6; ++i) {
    decision->selection.sites.push_back(decision->selection.sites[1]);
    decision->selection.sites.back().id = 10 + static_cast<std::uint64_t>(i);
    decision->selection.sites.back().letter = static_cast<char>('E' + i);
  }
  snap.terrain.Edit().applied = decision;
  EXPECT_TRUE(HasText(FlyWindow(1280, 720, snap).ui.items, "10 found, "));
}

TEST(AfterAJump, NothingIsPromisedThatTheRecordDoesNotHold) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending, SourceKind::kReplay);
  snap.flight.Edit().mission.rechecks.clear();
  snap.session.Edit().role = SessionRole::kReplayed;
  EXPECT_TRUE(HasText(FlyWindow(1920, 1080, snap).ui.items, "not yet"));
  snap.session.Edit().role = SessionRole::kReplayedAfterJump;
  EXPECT_TRUE(HasText(FlyWindow(1920, 1080, snap).ui.items, "not told after a jump"));

  EXPECT_EQ(NoMapWords(snap), "No map yet");
  snap.terrain.Edit().why_no_map = "On the ground no map is made";
  EXPECT_EQ(NoMapWords(snap), "On the ground no map is made");
  snap.terrain.Edit().applied.reset();
  FlyWindow window(1920, 1080, snap);
  EXPECT_FALSE(HasText(window.ui.items, "No map yet"));
}

}  // namespace
}  // namespace palace
