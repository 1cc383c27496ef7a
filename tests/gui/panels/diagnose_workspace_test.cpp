// Diagnose: counters, losses, the bus and stereo health, from a snapshot.
#include "gui/panels/diagnose/diagnose.h"
#include "gui/panels/fly_panels.h"
#include "gui/widgets/number_text.h"
#include "tests/gui/panels/panel_checks.h"
#include "tests/support/fake_snapshot.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

TEST(DiagnoseWorkspace, EachCameraHasItsCounters) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed, SourceKind::kCameras);
  snap.session.Edit().source.cameras = {
      {"Camera left", "", 1234, 7, 3, 1, 29.97, 0.02},
      {"Camera right", "/dev/video2: unplugged", 1200, 0, 0, 0, NAN, 3.2}};
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    UiHarness ui(size.width, size.height);
    DiagnoseState state;
    const Rect body = BodyOf(size.width, size.height);
    ui.Frame([&](UiFrame& f) { DrawDiagnoseWorkspace(snap, body, state, f); });
    ExpectTextsInPanels(ui.items);
    ExpectPanelsApart(ui.items, body);
    const Item* left = ui.items.Find("camera/left");
    const Item* right = ui.items.Find("camera/right");
    ASSERT_TRUE(left != nullptr && right != nullptr);
    EXPECT_EQ(left->text,
              "Camera left, unpaired 7, dropped 3, reopened 1, pictures " + Fixed(1234, 0));
    EXPECT_NE(right->text.find("/dev/video2: unplugged"), std::string::npos) << right->text;
  }
}

// "Vehicle did not restart" with a cross would read as its opposite.
TEST(DiagnoseWorkspace, AGuardOfASiteFailsOnlyOnceASiteIsSelected) {
  for (const MissionState state : {MissionState::kProposed, MissionState::kArmed}) {
    EngineSnapshot snap = fake::Snapshot(state);
    GuardResult& guard = snap.flight.Edit().mission.guards[8];
    guard.pass = false;
    guard.reason = "Select a site first";
    UiHarness ui(1920, 1080);
    DiagnoseState diagnose;
    ui.Frame([&](UiFrame& f) { DrawDiagnoseWorkspace(snap, BodyOf(1920, 1080), diagnose, f); });
    EXPECT_EQ(ui.items.Find("guard/G9")->text,
              guard.name + (state == MissionState::kArmed ? " fails: " : ": ") + guard.reason);
  }
}

TEST(DiagnoseWorkspace, EveryLossHasItsCountAndItsMeaning) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  const auto draw = [&](UiHarness& ui, const WindowSize& size) {
    DiagnoseState state;
    const Rect body = BodyOf(size.width, size.height);
    ui.Frame([&](UiFrame& f) { DrawDiagnoseWorkspace(snap, body, state, f); });
    ExpectTextsInPanels(ui.items);
    ExpectPanelsApart(ui.items, body);
  };
  const auto count = [](const UiHarness& ui) {
    return std::count_if(ui.items.items().begin(), ui.items.items().end(),
                         [](const Item& item) { return item.name.rfind("loss/", 0) == 0; });
  };
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    UiHarness quiet(size.width, size.height);
    snap.session.Edit().losses = {};
    draw(quiet, size);
    EXPECT_EQ(count(quiet), 0);
    snap.session.Edit().losses = {.pairs_replaced = 31,
                                  .pictures_unpaired = 2,
                                  .pairs_without_rig = 3,
                                  .bundles_missing = 4,
                                  .samples_missing = 5,
                                  .samples_overflowed = 6,
                                  .datagrams_refused = 7,
                                  .undecodable = {{"CAMERA_LEFT", 8}, {"VEHICLE_POSE", 1}},
                                  .messages_unsent = 10,
                                  .records_dropped = 11};
    UiHarness ui(size.width, size.height);
    draw(ui, size);
    EXPECT_EQ(count(ui), 10);
    ASSERT_NE(ui.items.Find("loss/Undecodable"), nullptr);
    EXPECT_EQ(ui.items.Find("loss/Undecodable")->text, "9: Refused: CAMERA_LEFT 8, VEHICLE_POSE 1");
    ASSERT_NE(ui.items.Find("loss/Pairs overtaken"), nullptr);
    EXPECT_EQ(ui.items.Find("loss/Pairs overtaken")->text.rfind("31: ", 0), 0u);
  }
}

// A slow station speaks of itself; what it has not looked at yet says nothing of a channel.
TEST(DiagnoseWorkspace, AnOldScreenIsNotLaidToTheChannels) {
  const EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  for (const double silent_s : {0.0, 0.3, 0.7}) {
    SCOPED_TRACE(silent_s);
    UiHarness ui(1920, 1080);
    DiagnoseState state;
    ui.Frame([&](UiFrame& f) {
      f.silent_s = silent_s;
      DrawDiagnoseWorkspace(snap, BodyOf(1920, 1080), state, f);
    });
    const auto said = [&](const std::string& text) {
      return std::any_of(ui.items.items().begin(), ui.items.items().end(), [&](const Item& item) {
        return item.name == "text" && item.text == text;
      });
    };
    EXPECT_EQ(said("200.0 Hz"), silent_s <= 0.5) << "the IMU's rate";
    EXPECT_EQ(said("Screen 0.7 s behind, limit 0.5 s"), silent_s > 0.5);
  }
}

TEST(DiagnoseWorkspace, TheBusIsShownBySenderAndByChannel) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  BusTraffic& bus = snap.session.Edit().losses.bus;
  for (const char* name : {"CAMERA_LEFT", "CAMERA_RIGHT", "CAMERA_RIG", "COMMAND_ACK", "GPS", "IMU",
                           "LASER_RANGE", "TRUTH", "VEHICLE_POSE", "VEHICLE_STATUS"}) {
    bus.channels.push_back({.channel = name, .received = 40, .sender = "10.0.0.2:7001"});
  }
  bus.channels[8].lost = 3;
  bus.channels[8].overflowed = 4;
  bus.channels[8].duplicated = 2;
  bus.channels[8].reordered = 1;
  bus.channels[8].refused = 9;
  bus.senders = {{.address = "10.0.0.2:7001", .used = true, .received = 400, .lost = 5},
                 {.address = "10.0.0.9:6666", .refused = 9},
                 {.address = "10.0.0.1:5000", .foreign = 70}};
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    UiHarness ui(size.width, size.height);
    DiagnoseState state;
    const Rect body = BodyOf(size.width, size.height);
    ui.Frame([&](UiFrame& f) { DrawDiagnoseWorkspace(snap, body, state, f); });
    ExpectTextsInPanels(ui.items);
    ExpectPanelsApart(ui.items, body);
    const auto text = [&](const char* row) {
      const Item* item = ui.items.Find(row);
      return item != nullptr ? item->text : std::string();
    };
    EXPECT_EQ(text("bus/From 10.0.0.2:7001"),
              "From 10.0.0.2:7001: Received 400, Lost 5, Twice 0, Late 0, Refused 0");
    EXPECT_EQ(text("bus/Stranger 10.0.0.9:6666"),
              "Stranger 10.0.0.9:6666: Received 0, Lost 0, Twice 0, Late 0, Refused 9");
    EXPECT_EQ(ui.items.Find("bus/Stranger 10.0.0.1:5000"), nullptr) << "nothing of ours";
    if (size.height >= 1080) {
      EXPECT_EQ(text("bus/VEHICLE_POSE"),
                "VEHICLE_POSE: Received 40, Lost 3, Twice 2, Late 1, Refused 9")
          << "four that waited too long here came: they are among the losses";
    }
  }
}

TEST(DiagnoseWorkspace, StereoHealthNamesWhatIsWrong) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  const auto health = [&](const char* row) {
    UiHarness ui(1920, 1080);
    DiagnoseState state;
    ui.Frame([&](UiFrame& f) { DrawDiagnoseWorkspace(snap, BodyOf(1920, 1080), state, f); });
    const Item* item = ui.items.Find(std::string("health/") + row);
    return item == nullptr ? std::string("not drawn")
                           : (item->enabled ? "fine: " : "bad: ") + item->text;
  };
  EXPECT_EQ(health("Pictures"), "fine: Pictures two different views");
  EXPECT_EQ(health("Range against the laser"), "fine: Range against the laser +0.4 % ± 0.3 %");
  snap.terrain.Edit().stereo_quality.suspect_swapped = true;
  EXPECT_EQ(health("Pictures"), "bad: Pictures left and right look exchanged");
  snap.terrain.Edit().stereo_quality.row_error_px = 0.83;
  for (LimitRow& row : snap.flight.Edit().mission.limits) {
    row.over = row.id == LimitId::kRowError;
  }
  EXPECT_EQ(health("Row error"), "bad: Row error 0.83 px");
  snap.terrain.Edit().range_agreement = {};
  EXPECT_EQ(health("Range against the laser"), "fine: Range against the laser ––");
}

// On the ground no pair is matched any more.
TEST(DiagnoseWorkspace, StereoHealthSaysHowOldItsPairIs) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kLanded);
  for (const auto& [age_us, words] :
       {std::pair{100'000, "100 ms old"}, {19'600'000, "19.6 s old"}}) {
    auto range = std::make_shared<RangeMap>(*snap.terrain->range);
    range->time = {snap.time.us - age_us};
    snap.terrain.Edit().range = range;
    UiHarness ui(1920, 1080);
    DiagnoseState state;
    ui.Frame([&](UiFrame& f) { DrawDiagnoseWorkspace(snap, BodyOf(1920, 1080), state, f); });
    const Item* age = ui.items.Find("health/age");
    ASSERT_NE(age, nullptr);
    EXPECT_EQ(age->text, words);
  }
}

TEST(DiagnoseWorkspace, TextsStayInTheirPanels) {
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    UiHarness ui(size.width, size.height);
    EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
    snap.session.Edit().diagnostics = {
        {DiagnosticLevel::kWarning, "stereo",
         "41 % of the picture has no depth, limit 30 %. Check the exposure of the "
         "right camera."},
        {DiagnosticLevel::kInfo, "slad", "Border filled."}};
    auto events = *snap.session->events;
    events.push_back({snap.time, EventKind::kDecision,
                      "Approve refused: Left camera stale, 1.8 s, and a very long explanation that "
                      "no panel of this program could ever hold in a single line of its list"});
    snap.session.Edit().events = std::make_shared<const std::vector<Event>>(events);
    DiagnoseState state;
    const Rect body = BodyOf(size.width, size.height);
    ui.Frame([&](UiFrame& f) { DrawDiagnoseWorkspace(snap, body, state, f); });
    ExpectTextsInPanels(ui.items);
    ExpectPanelsApart(ui.items, body);
  }
}

TEST(DiagnoseWorkspace, AnAlarmIsToldToItsEnd) {
  for (const WindowSize& size : kWindowSizes) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
    snap.flight.Edit().mission.alarms.resize(1);
    snap.flight.Edit().mission.alarms[0].text =
        "GPS horizontal error 2.6 m, limit 2.0 m, for 12 s and rising; the fixes are of six "
        "satellites only. Landing on vision, not GPS: watch the coherence.";
    UiHarness ui(size.width, size.height);
    DiagnoseState state;
    const Rect body = BodyOf(size.width, size.height);
    ui.Frame([&](UiFrame& f) { DrawDiagnoseWorkspace(snap, body, state, f); });
    if (ui.items.Find("panel/Alarms") == nullptr) {
      continue;  // a low window has no room for them; the strip's list tells them
    }
    bool end = false;
    for (const Item& item : ui.items.items()) {
      end = end || (item.name == "text" && item.text.find("coherence.") != std::string::npos);
    }
    EXPECT_TRUE(end) << size.name;
    ExpectTextsInPanels(ui.items);
  }
}

}  // namespace
}  // namespace palace
