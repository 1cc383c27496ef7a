// What stands on the screen after a press: what was really sent, heard and refused.
#include <algorithm>

#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

EngineSnapshot WavedOff(WaveOffReport report) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kAborting);
  snap.flight.Edit().mission.wave_off = report;
  return snap;
}

TEST(WaveOffPanel, TellsWhatTheVehicleSaidAfterThePressAndItsAge) {
  using Phase = WaveOffReport::Phase;
  const struct {
    WaveOffReport report;
    const char* words;
    bool search_again;
  } table[] = {
      {{Phase::kSent, 0.4}, "Sent", false},
      {{Phase::kUnanswered, 37}, "No answer, 37.0 s", false},
      {{Phase::kAccepted, 0.2}, "Accepted 200 ms ago", false},
      {{Phase::kFlies, 0.3}, "Under way", false},
      {{Phase::kClimbs, 0.3}, "Climbing", false},
      {{Phase::kDone, 0.3, true}, "Hovering", true},
      {{Phase::kStands, 0.3, true}, "On the ground", true},
  };
  for (const auto& row : table) {
    for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
      SCOPED_TRACE(row.words);
      // The newest status may say "hover" all along: that is no answer.
      FlyWindow window(size.x, size.y, WavedOff(row.report));
      window.snap.sensors.Edit().vehicle->mode = VehicleMode::kHover;
      window.Run(2);
      EXPECT_EQ(window.ui.items.Find("wave_off")->text, std::string("WAVE OFF | ") + row.words);
      EXPECT_EQ(window.ui.items.Find("acknowledge_wave_off")->enabled, row.search_again);
      ExpectTextsInPanels(window.ui.items);
    }
  }
}

TEST(WaveOffPanel, OnTheGroundItIsNotOfferedAndSaysWhy) {
  FlyWindow window(1280, 720, fake::Snapshot(MissionState::kLanded));
  window.snap.flight.Edit().mission.why_no_wave_off = "Vehicle on the ground";
  window.ui.Frame(window.draw);
  EXPECT_FALSE(window.ui.items.Find("wave_off")->enabled);
  EXPECT_EQ(window.ui.items.Find("wave_off")->text, "WAVE OFF | Vehicle on the ground");
  window.ui.Click("wave_off", window.draw);
  EXPECT_EQ(window.ui.CountCommands<WaveOff>(), 0);
}

TEST(Landed, OffersTheNextFlightItsReviewAndTheReport) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    SCOPED_TRACE(size.x);
    FlyWindow window(size.x, size.y, fake::Snapshot(MissionState::kLanded));
    window.snap.session.Edit().recording_path = "logs/2026-11-20_14-32-07/flight.lcm";
    window.snap.flight.Edit().mission.touchdown_miss_m = 0.46;
    window.ui.Frame(window.draw);
    ExpectTextsInPanels(window.ui.items);
    EXPECT_EQ(window.ui.items.Find("hold_here"), nullptr);
    for (const char* item : {"new_flight", "review_flight", "open_report"}) {
      window.ui.Click(item, window.draw);
    }
    ASSERT_EQ(window.ui.intents.size(), 3U);
    const auto kind = [&](std::size_t i) {
      return std::get<NextFlight>(std::get<UiAction>(window.ui.intents[i])).kind;
    };
    EXPECT_EQ(kind(0), NextFlight::Kind::kFlyAgain);
    EXPECT_EQ(kind(1), NextFlight::Kind::kReview);
    EXPECT_EQ(kind(2), NextFlight::Kind::kOpenReport);
    window.snap.session.Edit().recording_path.clear();
    window.ui.Frame(window.draw);
    EXPECT_TRUE(window.ui.items.Find("new_flight")->enabled);
    EXPECT_FALSE(window.ui.items.Find("review_flight")->enabled);
  }
}

TEST(Landed, InAReviewItOffersTheWayBackToFlying) {
  FlyWindow window(1280, 720, fake::Snapshot(MissionState::kLanded, SourceKind::kReplay));
  const auto draw = [&](UiFrame& frame) {
    frame.after_review = {"Back to live", "Ends the review and listens again"};
    window.draw(frame);
  };
  window.ui.Frame(draw);
  ExpectTextsInPanels(window.ui.items);
  EXPECT_EQ(window.ui.items.Find("new_flight")->text, "Back to live");
  EXPECT_FALSE(window.ui.items.Find("review_flight")->enabled);
  window.ui.Click("new_flight", draw);
  ASSERT_EQ(window.ui.intents.size(), 1U);
  EXPECT_EQ(std::get<NextFlight>(std::get<UiAction>(window.ui.intents[0])).kind,
            NextFlight::Kind::kFlyAgain);
}

// Of a reason that is longer than its panel a person sees that it goes on.
TEST(Landing, AReasonThatDoesNotFitEndsWithAnEllipsis) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kHold);
  snap.flight.Edit().mission.why =
      "Image time off by 50 ms against attitude: pictures of the left camera are early, limit 35 "
      "ms, seen in three pictures in a row, and so are those of the right camera, by the same "
      "time, while the vehicle turned to the heading of its approach and then set off";
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    FlyWindow window(size.x, size.y, snap);
    ExpectTextsInPanels(window.ui.items);
    const auto& items = window.ui.items.items();
    EXPECT_TRUE(HasText(window.ui.items, " ago: Image time off by 50 ms")) << size.x;
    const Rect panel = window.ui.items.Find("panel/Landing")->rect;
    const bool cut = std::any_of(items.begin(), items.end(), [&](const Item& item) {
      return item.name == "text" && panel.Contains(item.rect.centre()) && item.text.ends_with("…");
    });
    EXPECT_EQ(cut, size.x < 1600) << size.x << ": a wide window has room for all";
  }
}

TEST(Landing, ASecondPressWhereApproveWasDoesNotStopTheDescent) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    FlyWindow armed(size.x, size.y, fake::Snapshot(MissionState::kArmed));
    const Rect approve = armed.ui.items.Find("approve")->rect;
    for (const MissionState state : {MissionState::kApproved, MissionState::kDescending}) {
      FlyWindow flying(size.x, size.y, fake::Snapshot(state));
      const Rect hold = flying.ui.items.Find("hold_here")->rect;
      EXPECT_FALSE(Touch(hold, approve)) << MissionStateName(state) << " at " << size.x;
    }
  }
}

TEST(Approve, ASelectionIsTakenBackByItsButton) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    FlyWindow window(size.x, size.y, fake::Snapshot(MissionState::kArmed));
    window.snap.flight.Edit().mission.may_select = true;
    window.ui.Frame(window.draw);
    ASSERT_NE(window.ui.items.Find("deselect"), nullptr);
    ExpectTextsInPanels(window.ui.items);
    window.ui.Click("deselect", window.draw);
    EXPECT_EQ(window.ui.CountCommands<DisarmSite>(), 1);
    window.snap = fake::Snapshot(MissionState::kProposed);
    window.ui.Frame(window.draw);
    EXPECT_EQ(window.ui.items.Find("deselect"), nullptr);
  }
}

TEST(Approve, AFullHoldIsAnsweredAtOnce) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kArmed));
  window.ui.MoveTo("approve");
  window.Run(0.05);
  window.ui.Button(true);
  window.Run(1.1);
  ASSERT_EQ(window.ui.CountCommands<ApproveSite>(), 1);
  EXPECT_EQ(window.ui.items.Find("approve")->text, "Approving A | Held in full, let go");
  window.Run(3);  // the engine has not taken it: the button comes back
  EXPECT_EQ(window.ui.items.Find("approve")->text.rfind("Hold to approve A", 0), 0U);
}

TEST(Approve, SaysWhyTheSelectionEnded) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    FlyWindow window(size.x, size.y, fake::Snapshot(MissionState::kProposed));
    window.snap.flight.Edit().mission.selection_ended =
        "Selection of site A ended: Arm window is over, select the site again.";
    window.ui.Frame(window.draw);
    EXPECT_TRUE(HasText(window.ui.items, "Selection of site A ended"));
    ExpectTextsInPanels(window.ui.items);
  }
}

TEST(TopBar, APausedSourceIsToldOverTheModeAndF1IsHinted) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    FlyWindow window(size.x, size.y,
                     fake::Snapshot(MissionState::kProposed, SourceKind::kSimulation));
    EXPECT_EQ(window.ui.items.Find("paused"), nullptr);
    window.snap.session.Edit().source.paused = true;
    window.ui.Frame(window.draw);
    EXPECT_NE(window.ui.items.Find("paused"), nullptr);
    EXPECT_TRUE(HasText(window.ui.items, "PAUSED · Space"));
    ExpectTextsInPanels(window.ui.items);
    window.ui.Click("keys", window.draw);
    ASSERT_EQ(window.ui.intents.size(), 1U) << size.x;
    EXPECT_TRUE(std::get<ShowKeyHelp>(std::get<UiAction>(window.ui.intents[0])).shown);
  }
}

}  // namespace
}  // namespace palace
