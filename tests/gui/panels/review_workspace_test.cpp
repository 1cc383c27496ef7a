// Review: texts stay in their panels; the transport asks; what has no record offers none.
#include "gui/panels/fly_panels.h"
#include "gui/panels/review/review.h"
#include "tests/gui/panels/panel_checks.h"
#include "tests/gui/panels/review_flight.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

TEST(ReviewWorkspace, TextsStayInTheirPanels) {
  const FlightRecord record = fake::Record();
  const EngineSnapshot as_recorded = fake::Replay(false), redecided = fake::Replay(true);
  for (const WindowSize& size : kWindowSizes) {
    UiHarness ui(size.width, size.height);
    const Rect body = BodyOf(size.width, size.height);
    for (const EngineSnapshot* snap : {&as_recorded, &redecided}) {
      for (const FlightRecord* with : {&record, static_cast<const FlightRecord*>(nullptr)}) {
        for (const auto picture : {ReviewPicture::kView3d, ReviewPicture::kRightCamera}) {
          SCOPED_TRACE(std::string(size.name) + (snap->terrain->recorded ? " re-decided" : ""));
          ReviewState state;
          state.picture = picture;
          ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(*snap, with, body, state, f); });
          ExpectTextsInPanels(ui.items);
          ExpectPanelsApart(ui.items, body);
        }
      }
    }
  }
}

/// What the app renders the 3-D picture for is where the panel shows it.
TEST(ReviewWorkspace, ThePictureOfTheViewLiesWhereTheLayoutSays) {
  const EngineSnapshot snap = fake::Replay(false);
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    UiHarness ui(size.width, size.height);
    const Rect body = BodyOf(size.width, size.height);
    ReviewState state;
    ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, nullptr, body, state, f); });
    const Rect drawn = ui.items.Find("view_3d")->rect;
    const Rect laid = View3dScene(LayReview(body, ui.style, state.picture).view_3d, ui.style);
    EXPECT_TRUE(drawn.x == laid.x && drawn.y == laid.y && drawn.w == laid.w && drawn.h == laid.h);
  }
}

TEST(ReviewWorkspace, WithoutASourceItSaysWhatToDo) {
  UiHarness ui(1920, 1080);
  const EngineSnapshot snap;
  ReviewState state;
  ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, nullptr, BodyOf(1920, 1080), state, f); });
  const Item* text = ui.items.Find("text");
  ASSERT_NE(text, nullptr);
  EXPECT_EQ(text->text.substr(0, 12), "No log open.");
}

TEST(ReviewWorkspace, TransportButtonsAskForTheirControl) {
  using Kind = PlaybackControl::Kind;
  const FlightRecord record = fake::Record();
  const struct {
    const char* item;
    Kind kind;
    double value;
  } table[] = {{"play", Kind::kPause, 0},
               {"step_back", Kind::kStepBack, 0},
               {"step_forward", Kind::kStepForward, 0},
               {"to_start", Kind::kSeek, 0},
               {"to_end", Kind::kSeek, 338},
               {"speed", Kind::kSpeed, 2}};
  for (const auto& row : table) {
    SCOPED_TRACE(row.item);
    UiHarness ui(1280, 720);
    const EngineSnapshot snap = fake::Replay(false);
    ReviewState state;
    const auto draw = [&](UiFrame& f) {
      DrawReviewWorkspace(snap, &record, BodyOf(1280, 720), state, f);
    };
    ui.Frame(draw);
    ui.Click(row.item, draw);
    const auto asked = Playbacks(ui.intents);
    ASSERT_EQ(asked.size(), 1U);
    EXPECT_EQ(asked[0].kind, row.kind);
    EXPECT_EQ(asked[0].value, row.value);
  }
}

TEST(ReviewWorkspace, OfALogInPartsTheNextIsOffered) {
  const FlightRecord record = fake::Record();
  EngineSnapshot snap = fake::Replay(false);
  const float wide = 1920, high = 1080;
  ReviewState state;
  const auto draw = [&](UiFrame& f) {
    DrawReviewWorkspace(snap, &record, BodyOf(wide, high), state, f);
  };
  UiHarness whole(wide, high);
  whole.Frame(draw);
  EXPECT_EQ(whole.items.Find("part"), nullptr);
  snap.session.Edit().source.parts = 2;
  for (const int part : {1, 2}) {
    snap.session.Edit().source.part = part;
    UiHarness ui(wide, high);
    ui.Frame(draw);
    EXPECT_EQ(ui.items.Find("part")->text, "Part " + std::to_string(part) + " of 2");
    ui.Click("part", draw);
    ASSERT_EQ(ui.intents.size(), 1U);
    const auto& next = std::get<NextFlight>(std::get<UiAction>(ui.intents[0]));
    EXPECT_EQ(next.kind, NextFlight::Kind::kReview);
    EXPECT_EQ(next.log, snap.session->source.name);
    EXPECT_EQ(next.part, part % 2 + 1);
  }
}

TEST(ReviewWorkspace, WhatIsAliveIsNotOfferedToWait) {
  for (const SourceKind kind : {SourceKind::kLive, SourceKind::kCameras, SourceKind::kSimulation}) {
    const EngineSnapshot snap = fake::Snapshot(MissionState::kProposed, kind);
    UiHarness ui(1920, 1080);
    ReviewState state;
    ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, nullptr, BodyOf(1920, 1080), state, f); });
    for (const char* button : {"play", "step_forward", "speed"}) {
      EXPECT_EQ(ui.items.Find(button)->enabled, kind == SourceKind::kSimulation) << button;
    }
  }
}

TEST(ReviewWorkspace, ABookmarkIsOfferedWhereSomethingIsRecorded) {
  for (const SourceKind kind : {SourceKind::kReplay, SourceKind::kSimulation}) {
    UiHarness ui(1920, 1080);
    const EngineSnapshot snap = fake::Snapshot(MissionState::kProposed, kind);
    ReviewState state;
    const auto draw = [&](UiFrame& f) {
      DrawReviewWorkspace(snap, nullptr, BodyOf(1920, 1080), state, f);
    };
    ui.Frame(draw);
    ui.Click("bookmark", draw);
    EXPECT_EQ(ui.CountCommands<AddBookmark>(), kind == SourceKind::kReplay ? 0 : 1);
  }
}

TEST(ReviewWorkspace, AFlightUnderWayHasNothingRecordedBesideIt) {
  const EngineSnapshot snap = fake::Snapshot(MissionState::kProposed, SourceKind::kSimulation);
  UiHarness ui(1920, 1080);
  ReviewState state;
  ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, nullptr, BodyOf(1920, 1080), state, f); });
  for (const Item& item : ui.items.items()) {
    EXPECT_EQ(item.text.find("Recorded"), std::string::npos) << item.name << ": " << item.text;
    EXPECT_NE(item.text.rfind("of ", 0), 0u) << item.text;
  }
  EXPECT_FALSE(ui.items.Find("redecide")->enabled);
}

TEST(ReviewWorkspace, AfterAJumpThePictureOfTheRecordIsNotCalledMissing) {
  EngineSnapshot snap = fake::Replay(false);
  snap.sensors.Edit().channels[0].state = ChannelHealth::State::kStale;
  snap.sensors.Edit().channels[0].age_s = 3.2;
  EXPECT_EQ(NoPictureWords(snap), "No picture here, the last came 3.2 s before");
  snap.sensors.Edit().channels[0].state = ChannelHealth::State::kNever;
  EXPECT_EQ(NoPictureWords(snap), "No picture yet");
}

TEST(ReviewWorkspace, TheWayBackToFlyingIsBesideTheTransport) {
  const FlightRecord record = fake::Record();
  EngineSnapshot snap = fake::Replay(false);
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    UiHarness ui(size.width, size.height);
    ReviewState state;
    WayOut way_out{"Back to cameras", "Ends the review and opens them again"};
    const auto draw = [&](UiFrame& f) {
      f.after_review = way_out;
      DrawReviewWorkspace(snap, &record, BodyOf(size.width, size.height), state, f);
    };
    snap = fake::Replay(false);
    snap.session.Edit().source.parts = 2;
    ui.Frame(draw);
    ExpectTextsInPanels(ui.items);
    ui.Click("end_review", draw);
    ASSERT_EQ(ui.intents.size(), 1U);
    EXPECT_EQ(std::get<NextFlight>(std::get<UiAction>(ui.intents[0])).kind,
              NextFlight::Kind::kFlyAgain);
    snap = fake::Snapshot(MissionState::kProposed, SourceKind::kSimulation);
    ui.Frame(draw);
    EXPECT_EQ(ui.items.Find("end_review"), nullptr) << "a flight is no review";
  }
}

}  // namespace
}  // namespace palace
