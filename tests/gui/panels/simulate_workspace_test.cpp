// Simulate: texts stay in their panels; time, changes, views and the next flight ask for the right
// thing; what is shown is what is in force.
#include "gui/panels/frame_bar.h"
#include "gui/panels/simulate/simulate.h"
#include "tests/gui/panels/panel_checks.h"
#include "tests/support/fake_snapshot.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

EngineSnapshot Simulated(MissionState state) {
  EngineSnapshot snap = fake::Snapshot(state, SourceKind::kSimulation);
  SourceStatus& source = snap.session.Edit().source;
  source.simulation.emplace();
  ReadRig(*snap.sensors->rig, source.simulation->began);
  source.simulation->in_force = source.simulation->asked = source.simulation->began;
  source.position_s = 12.3;
  source.duration_s = 600;
  source.speed = 1;
  source.speed_reached = 0.98;
  source.paused = false;
  return snap;
}

SimulateState State() {
  SimulateState state;
  state.offered.scenarios = {"runway", "rocks", "obstacles", "ditches", "config/worlds/yard.toml"};
  state.offered.vehicles = {"r50", "multirotor"};
  state.choice = {"runway", 1, "r50"};
  const FaultOffer jump{.name = "gps_jump",
                        .words = "GPS jump",
                        .what = "Every fix is off by this",
                        .has_value = true,
                        .unit = "m",
                        .default_value = 3,
                        .least = 0,
                        .most = 100};
  const FaultOffer missing{.name = "missing",
                           .words = "Missing",
                           .what = "Nothing comes",
                           .channels = {{"GPS", "GPS"}, {"IMU", "IMU"}}};
  state.offered.faults.assign(32, jump);
  state.offered.faults.push_back(missing);
  return state;
}

struct Window {
  explicit Window(EngineSnapshot snapshot, float width = 1920, float height = 1080)
      : ui(width, height), snap(std::move(snapshot)), body(BodyOf(width, height)) {
    ui.Frame(draw);
  }
  std::string TextOf(const char* item) const {
    const Item* found = ui.items.Find(item);
    return found == nullptr ? "not drawn" : found->text;
  }
  template <typename T>
  std::vector<T> Asked() const {
    std::vector<T> asked;
    for (const Intent& intent : ui.intents) {
      if (const T* one = std::get_if<T>(&intent)) {
        asked.push_back(*one);
      }
    }
    return asked;
  }
  template <typename T>
  std::optional<T> LastAction() const {
    std::optional<T> last;
    for (const UiAction& action : Asked<UiAction>()) {
      if (const T* one = std::get_if<T>(&action)) {
        last = *one;
      }
    }
    return last;
  }
  UiHarness ui;
  EngineSnapshot snap;
  Rect body;
  SimulateState state = State();
  std::function<void(UiFrame&)> draw = [this](UiFrame& f) {
    DrawSimulateWorkspace(snap, body, state, f);
  };
};

TEST(SimulateWorkspace, TextsStayInTheirPanels) {
  for (const WindowSize& size : kWindowSizes) {
    for (const SimulateTab tab :
         {SimulateTab::kChanges, SimulateTab::kFlight, SimulateTab::kFaults}) {
      for (const MissionState mission : {MissionState::kProposed, MissionState::kDescending}) {
        for (const bool waits : {false, true}) {
          SCOPED_TRACE(std::string(size.name) + " " + MissionStateName(mission));
          EngineSnapshot snap = Simulated(mission);
          if (waits) {
            SimulationSetup& asked = snap.session.Edit().source.simulation->asked;
            asked.wind_mps = 12.5;
            asked.field_of_view_deg = 100;
          }
          Window window(std::move(snap), size.width, size.height);
          window.state.tab = tab;
          window.state.choosing_fault = waits;
          for (int i = 1; i <= 12; ++i) {
            window.state.faults.push_back({i, "Camera overexposed 4 times on both cameras",
                                           "Camera overexposed", 10, i > 6 ? INFINITY : 20, i < 9});
          }
          // 22 families and a file, as the program offers them.
          window.state.offered.scenarios.assign(23, "obstacles");
          window.ui.Frame(window.draw);
          ExpectTextsInPanels(window.ui.items);
          ExpectPanelsApart(window.ui.items, window.body);
        }
      }
    }
  }
}

TEST(SimulateWorkspace, OfAnotherSourceItSaysWhyNot) {
  EngineSnapshot live = fake::Snapshot(MissionState::kSearch, SourceKind::kLive);
  Window window(live);
  EXPECT_TRUE(HasText(window.ui.items, "Only the built-in simulation"));
  EXPECT_EQ(window.ui.items.Find("sim/play"), nullptr);
}

TEST(SimulateWorkspace, TimeAsksForWhatItsButtonsSay) {
  using Kind = PlaybackControl::Kind;
  Window window(Simulated(MissionState::kProposed));
  EXPECT_EQ(window.TextOf("sim/time"), "12.3 s");
  EXPECT_EQ(window.TextOf("sim/state"), "Runs");
  EXPECT_EQ(window.TextOf("sim/reached"), "reached 0.98× real time");
  for (const char* item : {"sim/play", "sim/step", "sim/run_to", "sim/speed/50", "sim/speed/0.1",
                           "sim/speed/fastest"}) {
    window.ui.Click(item, window.draw);
  }
  const std::vector<PlaybackControl> asked = window.Asked<PlaybackControl>();
  ASSERT_EQ(asked.size(), 6U);
  EXPECT_EQ(asked[0].kind, Kind::kPause);
  EXPECT_EQ(asked[1].kind, Kind::kStepForward);
  EXPECT_EQ(asked[2].kind, Kind::kRunTo);
  EXPECT_EQ(asked[2].value, 20) << "the next whole ten seconds are offered";
  EXPECT_EQ(asked[3].value, 50);
  EXPECT_EQ(asked[4].value, 0.1);
  EXPECT_EQ(asked[5].value, 0);

  SourceStatus& source = window.snap.session.Edit().source;
  source.simulation->run_to_s = 20;
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.TextOf("sim/state"), "Runs to 20.0 s");
  source.paused = true;
  source.simulation->run_to_s.reset();
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.TextOf("sim/state"), "Paused");
  EXPECT_EQ(window.TextOf("sim/reached"), "reached ––") << "nothing runs";
}

TEST(SimulateWorkspace, AMomentThatHasPassedIsRefusedWithTheReasonAndKept) {
  Window window(Simulated(MissionState::kProposed));
  window.state.run_to_s = 12;
  window.state.run_to_typed = true;
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.TextOf("field/simulation.run_to_s"), "12.0 s") << "as it was typed";
  EXPECT_EQ(window.TextOf("sim/run_to_refused"), "has passed");
  window.ui.Click("sim/run_to", window.draw);
  EXPECT_TRUE(window.Asked<PlaybackControl>().empty());
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.state.run_to_s, 12);

  window.state.run_to_s = 15;
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.ui.items.Find("sim/run_to_refused"), nullptr);
  window.ui.Click("sim/run_to", window.draw);
  ASSERT_EQ(window.Asked<PlaybackControl>().size(), 1U);
  EXPECT_EQ(window.Asked<PlaybackControl>()[0].value, 15);
  window.snap.session.Edit().source.position_s = 15;
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.TextOf("field/simulation.run_to_s"), "20.0 s") << "it was run to: the next one";
}

TEST(SimulateWorkspace, AChangeIsShownAsAskedAndInForce) {
  Window window(Simulated(MissionState::kProposed));
  window.ui.MoveTo("limit/simulation.wind_mps");
  window.ui.Frame(window.draw);
  window.ui.Button(true);
  window.ui.Frame(window.draw);
  window.ui.MoveTo(ImVec2(window.ui.items.Find("limit/simulation.wind_mps")->rect.centre().x + 40,
                          window.ui.items.Find("limit/simulation.wind_mps")->rect.centre().y));
  window.ui.Frame(window.draw);
  window.ui.Button(false);
  window.ui.Frame(window.draw);
  const std::vector<SimulationChange> asked = window.Asked<SimulationChange>();
  ASSERT_FALSE(asked.empty());
  EXPECT_EQ(asked.back().name, "simulation.wind_mps");
  EXPECT_GT(asked.back().value, 1);
  EXPECT_LE(asked.back().value, 20);

  EXPECT_EQ(window.TextOf("in_force/simulation.wind_mps"), "0.0 m/s");
  EXPECT_FALSE(HasText(window.ui.items, "now 0.0 m/s"));
  window.snap.session.Edit().source.simulation->asked.wind_mps = 8;
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.TextOf("in_force/simulation.wind_mps"), "0.0 m/s");
  EXPECT_TRUE(HasText(window.ui.items, "now 0.0 m/s"));
  EXPECT_TRUE(HasText(window.ui.items, "From the next pictures on"));
}

TEST(SimulateWorkspace, TheRigIsHeldWhileASiteIsFlownToAndWindIsNot) {
  Window window(Simulated(MissionState::kDescending));
  for (const SimulationRow& row : SimulationTable()) {
    const Item* item = window.ui.items.Find("limit/" + row.info.name);
    ASSERT_NE(item, nullptr) << row.info.name;
    EXPECT_EQ(item->enabled, !row.of_rig) << row.info.name;
  }
  EXPECT_TRUE(HasText(window.ui.items, "until the landing is over"));
}

TEST(SimulateWorkspace, ASmallViewChangesPlacesWithTheMainOne) {
  Window window(Simulated(MissionState::kProposed));
  window.ui.Click("swap/chase", window.draw);
  ASSERT_TRUE(window.LastAction<ShowWorldView>());
  EXPECT_EQ(window.LastAction<ShowWorldView>()->eye, WorldEye::kChase);
  window.ui.Click("world_view/orbit", window.draw);
  EXPECT_EQ(window.LastAction<ShowWorldView>()->eye, WorldEye::kOrbit);

  SimulateState state;
  ShowEye(WorldEye::kChase, state);
  EXPECT_EQ(state.eyes[0], WorldEye::kChase);
  EXPECT_EQ(state.eyes[2], WorldEye::kBirdsEye) << "where the chase was";
  ShowEye(WorldEye::kOrbit, state);
  EXPECT_EQ(state.eyes[0], WorldEye::kOrbit) << "from outside the column: it takes the main place";
}

TEST(SimulateWorkspace, AFaultIsInjectedFromNowAndEnded) {
  Window window(Simulated(MissionState::kProposed));
  window.ui.Click("fault/inject", window.draw);
  ASSERT_TRUE(window.LastAction<InjectFault>());
  EXPECT_EQ(window.LastAction<InjectFault>()->text, "gps_jump=3.000000:0-10.000000");
  window.ui.Click("fault/kind", window.draw);
  window.ui.Frame(window.draw);  // the list of kinds
  window.ui.Click("fault/kind/missing", window.draw);
  window.ui.Frame(window.draw);
  window.ui.Click("fault/channel/next", window.draw);
  window.ui.Click("fault/channel/next", window.draw);
  window.state.fault.for_s = 0;
  window.ui.Click("fault/inject", window.draw);
  EXPECT_EQ(window.LastAction<InjectFault>()->text, "missing@IMU:0-");

  window.state.faults = {{1, "GPS jump 3 m", "GPS jump", 2, 12, false, true},
                         {2, "Missing on IMU", "Missing", 12.3, INFINITY, true, false}};
  window.ui.Frame(window.draw);
  EXPECT_EQ(window.ui.items.Find("fault/1"), nullptr) << "it is over";
  EXPECT_EQ(window.TextOf("fault/2"), "Missing on IMU, until ended");
  window.ui.Click("fault/end/2", window.draw);
  ASSERT_TRUE(window.LastAction<EndFault>());
  EXPECT_EQ(window.LastAction<EndFault>()->number, 2);
}

TEST(SimulateWorkspace, EveryFaultThatActsCanBeEnded) {
  for (const auto& [width, height] : {std::pair(1920.0F, 1080.0F), std::pair(1280.0F, 800.0F)}) {
    Window window(Simulated(MissionState::kProposed), width, height);
    window.state.tab = SimulateTab::kFaults;
    for (int i = 1; i <= 40; ++i) {
      window.state.faults.push_back({i, "GPS jump 3 m", "GPS jump", 2, INFINITY, true, false});
    }
    window.ui.Frame(window.draw);
    EXPECT_EQ(window.ui.items.Find("fault/end/40"), nullptr);
    const ImVec2 list = window.ui.items.Find("fault/1")->rect.centre();
    for (int n = 1; n <= 40; ++n) {
      const std::string end = "fault/end/" + std::to_string(n);
      for (int turn = 0; turn < 40 && window.ui.items.Find(end) == nullptr; ++turn) {
        window.ui.MoveTo(list);
        FeedMouseWheel(-1);
        window.ui.Frame(window.draw);
      }
      window.ui.Click(end, window.draw);
      ASSERT_TRUE(window.LastAction<EndFault>()) << n;
      EXPECT_EQ(window.LastAction<EndFault>()->number, n);
    }
  }
}

TEST(SimulateWorkspace, AnotherWorldIsANewFlight) {
  Window window(Simulated(MissionState::kProposed));
  window.ui.Click("scenario/yard", window.draw);
  window.ui.Click("vehicle/multirotor", window.draw);
  window.ui.Click("fly_world", window.draw);
  const auto next = window.LastAction<NextFlight>();
  ASSERT_TRUE(next && next->choice);
  EXPECT_EQ(next->kind, NextFlight::Kind::kFlyAgain);
  EXPECT_EQ(next->choice->scenario, "config/worlds/yard.toml");
  EXPECT_EQ(next->choice->vehicle, "multirotor");
}

}  // namespace
}  // namespace palace
