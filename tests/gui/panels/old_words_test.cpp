// What was true once and is no more: a site off the map, a vehicle that fell silent, old pictures.
#include "gui/panels/tune/tune.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

TEST(SiteList, TheRowThatLeftTheMapIsTheOneThatSaysSo) {
  const struct {
    bool now;  ///< the place is still on the newest map
    SiteVerdict verdict;
    const char* word;
  } table[] = {{false, SiteVerdict::kLost, "Z Off the map Cells unknown"},
               {true, SiteVerdict::kLost, "Z Lost Cells unknown"},
               {true, SiteVerdict::kHolds, "Z Confirmed"}};
  for (const auto& row : table) {
    SCOPED_TRACE(row.word);
    EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
    MissionStatus& m = snap.flight.Edit().mission;
    m.armed->id = 99;
    m.armed->letter = 'Z';
    m.armed_now = row.now ? m.armed : std::nullopt;
    m.armed_verdict = row.verdict;
    m.armed_why = row.verdict == SiteVerdict::kHolds ? "" : "Cells unknown";
    FlyWindow window(1920, 1080, snap);
    EXPECT_EQ(window.ui.items.Find("site/Z")->text.rfind(row.word, 0), 0U)
        << window.ui.items.Find("site/Z")->text;
    EXPECT_FALSE(window.ui.items.Find("site/Z")->enabled);
    EXPECT_EQ(window.ui.items.Find("site/A")->text.rfind("A Confirmed", 0), 0U);
    window.ui.MoveTo("panel/Sites");
    window.fly.sites.scroll = 1e6f;  // to the last
    window.ui.Frame(window.draw);
    const Item* last = window.ui.items.Find("site/D");
    EXPECT_TRUE(last->enabled);
    EXPECT_EQ(last->text.rfind("D Provisional", 0), 0U) << last->text;
    window.ui.MoveTo("wave_off");
    window.ui.Frame(window.draw);
    window.ui.Frame(window.draw);
    EXPECT_NE(window.ui.items.Find("site/Z"), nullptr) << "back in sight";
    EXPECT_EQ(window.ui.items.Find("site/D"), nullptr);
  }
}

TEST(SiteList, AListedSiteThatIsSelectedSaysWhenItHoldsNoLonger) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  MissionStatus& m = snap.flight.Edit().mission;
  m.armed_verdict = SiteVerdict::kDegraded;
  m.armed_why = "Room 0.1 m, armed with 2.2 m";
  FlyWindow window(1920, 1080, snap);
  EXPECT_EQ(window.ui.items.Find("site/A")->text.rfind(
                std::string("A ") + SiteVerdictWord(SiteVerdict::kDegraded) + " Room 0.1 m", 0),
            0U);
  EXPECT_TRUE(HasText(window.ui.items, "Room 0.1 m"));
}

// A landing that is played back was recorded: the panel says where.
TEST(LandedPanel, OfARecordSaysThatItIsOne) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kLanded);
  SessionPart& session = snap.session.Edit();
  session.role = SessionRole::kReplayed;
  session.recording_path.clear();
  session.source.name = "logs/2026-11-23_06-13-31/flight.lcm";
  const FlyWindow window(1920, 1080, snap);
  EXPECT_TRUE(HasText(window.ui.items, "This is the record 2026-11-23_06-13-31/flight.lcm"));
  EXPECT_FALSE(HasText(window.ui.items, "not recorded"));
}

TEST(WaveOffPanel, IsOfferedAgainWhenTheWordOfTheGroundIsOld) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kLanded);
  snap.flight.Edit().mission.why_no_wave_off = "Vehicle on the ground";
  FlyWindow window(1920, 1080, snap);
  EXPECT_FALSE(window.ui.items.Find("wave_off")->enabled);
  window.silent_s = 1.5;  // the engine publishes nothing more
  window.ui.Frame(window.draw);
  EXPECT_TRUE(window.ui.items.Find("wave_off")->enabled);
  window.ui.Click("wave_off", window.draw);
  EXPECT_EQ(window.ui.CountCommands<WaveOff>(), 1);
}

TEST(WaveOffPanel, AnOldScreenIsNotASilentVehicle) {
  FlyWindow window(1280, 720, fake::Snapshot(MissionState::kProposed));
  window.silent_s = 2.2;
  window.ui.Frame(window.draw);
  const Item* wave_off = window.ui.items.Find("wave_off");
  EXPECT_EQ(wave_off->text, "WAVE OFF | Screen 2.2 s behind, limit 0.5 s");
  EXPECT_TRUE(wave_off->enabled);
  ExpectTextsInPanels(window.ui.items);
}

TEST(Landing, AWaveOffIsToldWithTheAgeOfTheVehiclesWord) {
  const struct {
    WaveOffReport report;
    const char* headline;
  } table[] = {
      {{WaveOffReport::Phase::kDone, 37, false}, "Waved off, hovering, heard 37.0 s ago"},
      {{WaveOffReport::Phase::kFlies, 2.5, false}, "Wave-off under way, heard 2.5 s ago"},
      {{WaveOffReport::Phase::kClimbs, 2.5, false}, "Waved off, climbing, heard 2.5 s ago"}};
  for (const auto& row : table) {
    for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
      SCOPED_TRACE(row.headline);
      EngineSnapshot snap = fake::Snapshot(MissionState::kAborting);
      snap.flight.Edit().mission.wave_off = row.report;
      FlyWindow window(size.x, size.y, snap);
      EXPECT_TRUE(HasText(window.ui.items, row.headline));
      EXPECT_FALSE(window.ui.items.Find("acknowledge_wave_off")->enabled);
      ExpectTextsInPanels(window.ui.items);
    }
  }
}

// Left and right pictures arrive, but none of one moment: what is shown is the last pair.
TEST(StalePicture, AnOldPairIsToldThoughEachCameraIsFresh) {
  for (const bool old : {false, true}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
    for (GuardResult& guard : snap.flight.Edit().mission.guards) {
      if (old && guard.id == GuardId::kCameras) {
        guard.pass = false;
        guard.reason = "Stereo pair stale, 5.2 s";
      }
    }
    const FlyWindow window(1920, 1080, snap);
    int plates = 0;
    for (const Item& item : window.ui.items.items()) {
      plates += item.text == "Stereo pair stale, 5.2 s" ? 1 : 0;
    }
    EXPECT_EQ(plates >= 2, old) << plates << ", over both pictures";
  }
}

TEST(StalePicture, IsVeiledOnTuneTooAndNoOldRangeIsTold) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  const auto tune = [&](double silent_s) {
    UiHarness ui(1920, 1080);
    ui.textures.left_camera = &ui;
    TuneState state;
    ui.Frame([&](UiFrame& f) {
      f.silent_s = silent_s;
      DrawTuneWorkspace(snap, BodyOf(1920, 1080), state, f);
    });
    return ui.items;
  };
  const ItemRecord fresh = tune(0);
  EXPECT_TRUE(HasText(fresh, "Laser 38.2 m"));
  EXPECT_TRUE(HasText(fresh, "Confirmed"));
  EXPECT_FALSE(HasText(fresh, "s old"));
  const ItemRecord silent = tune(11);  // nothing is published any more
  EXPECT_FALSE(HasText(silent, "Laser"));
  EXPECT_FALSE(HasText(silent, "Confirmed"));
  EXPECT_TRUE(HasText(silent, "Old map"));
  EXPECT_TRUE(HasText(silent, "11.0 s old"));
  for (ChannelHealth& channel : snap.sensors.Edit().channels) {
    channel.state = ChannelHealth::State::kStale;  // the engine goes on, the vehicle is silent
    channel.age_s = 9;
  }
  EXPECT_FALSE(HasText(tune(0), "Laser"));
  EXPECT_TRUE(HasText(tune(0), "9.0 s old"));
  EXPECT_FALSE(HasText(FlyWindow(1920, 1080, snap).ui.items, "Laser 38.2 m"));
}

TEST(Pins, GoWithTheStateInWhichTheyWereSet) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed));
  window.fly.maps.probe.pinned = Eigen::Vector2d(1, 2);
  window.ui.Frame(window.draw);
  EXPECT_TRUE(window.fly.maps.probe.pinned.has_value());
  window.snap = fake::Snapshot(MissionState::kArmed);
  window.ui.Frame(window.draw);
  EXPECT_FALSE(window.fly.maps.probe.pinned.has_value());
}

// Below the height to commit at no map is made: that its last one is old is no caution.
TEST(StaleMap, NearTheGroundItIsToldWhyNoneIsMade) {
  for (const bool near : {false, true}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
    const std::string why = "Below 3.0 m no map is made, the last verdict stands";
    snap.terrain.Edit().why_no_map = near ? why : "";
    auto decision = std::make_shared<TerrainDecision>(*snap.terrain->applied);
    decision->map_time = AddSeconds(snap.time, -30);
    snap.terrain.Edit().applied = decision;
    FlyWindow window(1920, 1080, snap);
    EXPECT_EQ(HasText(window.ui.items, ". Below 3.0 m no map is made, the last verdict stands"),
              near);
    EXPECT_TRUE(HasText(window.ui.items, "Last map 30 s old"));
    ExpectTextsInPanels(window.ui.items);
  }
}

TEST(FlyFrame, AHoldTellsItsCauseAsPast) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kHold);
  snap.flight.Edit().mission.why = "Left camera 1.2 s old, limit 0.5 s";
  snap.flight.Edit().mission.since = AddSeconds(snap.time, -12);
  FlyWindow window(1920, 1080, snap);
  EXPECT_TRUE(HasText(window.ui.items, "12.0 s ago: Left camera 1.2 s old, limit 0.5 s."));
}

TEST(FlyFrame, AHoldForWhatNoMapShowsAnyMoreSaysSo) {
  const struct {
    SiteVerdict now;
    const char* lost_for;
    bool over;
  } rows[] = {{SiteVerdict::kHolds, "Slope 14.0°, limit 10.0°", true},
              {SiteVerdict::kDegraded, "Slope 14.0°, limit 10.0°", false},
              {SiteVerdict::kHolds, "Roughness 12 cm, max 10 cm", false}};  // not what it held for
  for (const auto& row : rows) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kHold);
    MissionStatus& mission = snap.flight.Edit().mission;
    mission.why = "Slope 14.0°, limit 10.0°";
    mission.since = AddSeconds(snap.time, -12);
    mission.rechecks.resize(2);
    mission.rechecks[0].verdict = SiteVerdict::kLost;
    mission.rechecks[0].reason = row.lost_for;
    mission.rechecks[1].verdict = row.now;
    FlyWindow window(1920, 1080, snap);
    EXPECT_TRUE(HasText(window.ui.items, "12.0 s ago: Slope 14.0°, limit 10.0°."));
    EXPECT_EQ(HasText(window.ui.items, "limit 10.0°. No newer map shows it."), row.over);
  }
}

}  // namespace
}  // namespace palace
