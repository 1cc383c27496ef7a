// Review: texts stay in their panels; the timeline seeks; differences are found.
#include "gui/panels/fly_panels.h"
#include "gui/panels/review/review.h"
#include "gui/widgets/number_text.h"
#include "tests/gui/panels/panel_checks.h"
#include "tests/support/fake_snapshot.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

constexpr double kStart_s = static_cast<double>(fake::kNow_us) * 1e-6 - 252;

/// A flight of 338 s, one sample each half second.
FlightRecord Record() {
  FlightRecord record;
  record.path = "logs/flight.log";
  record.start_s = kStart_s;
  record.duration_s = 338;
  record.has_settings = true;
  for (int i = 0; i < 676; ++i) {
    FlightRecordSample sample;
    const double t = 0.5 * i;
    sample.time = {static_cast<std::int64_t>((kStart_s + t) * 1e6)};
    sample.state = t < 60    ? MissionState::kSearch
                   : t < 180 ? MissionState::kProposed
                   : t < 220 ? MissionState::kArmed
                             : MissionState::kDescending;
    sample.best_site = t < 20 ? "" : (t < 230 ? "B" : "A");
    sample.best_safe_distance_m = t < 20 ? NAN : 4.6;
    sample.height_above_site_m = t < 220 ? 38 : std::max(0.0, 38 - 0.6 * (t - 220));
    sample.height_m = sample.height_above_site_m;
    record.samples.push_back(sample);
  }
  record.events = fake::Events();
  record.events.push_back({{fake::kNow_us - 60'000'000}, EventKind::kBookmark, "Skid contact"});
  return record;
}

/// What other limits chose, 10 maps a second: A in place of B from 100 s to 130 s and from 212 s to
/// 230 s, A as in the flight until 240 s.
std::shared_ptr<const std::vector<RedecidedSample>> Redecided() {
  auto samples = std::make_shared<std::vector<RedecidedSample>>();
  for (int i = 1000; i <= 2400; ++i) {
    if (i > 1300 && i < 2120) {
      continue;  // not judged again
    }
    RedecidedSample sample;
    sample.time = {static_cast<std::int64_t>((kStart_s + 0.1 * i) * 1e6)};
    sample.recorded = i < 2300 ? "B" : "A";
    sample.best_site = "A";
    sample.best_safe_distance_m = 4.1;
    sample.differs = sample.recorded != sample.best_site;
    samples->push_back(sample);
  }
  return samples;
}

EngineSnapshot Replay(bool redecided) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed, SourceKind::kReplay);
  if (redecided) {
    snap.terrain.Edit().recorded = snap.terrain->applied;
    snap.terrain.Edit().redecided = Redecided();
    snap.session.Edit().settings.slad.limits.max_slope_deg =
        snap.session.Edit().preview_settings.slad.limits.max_slope_deg = 6;
    auto applied = std::make_shared<TerrainDecision>(
        *fake::Decision(snap.sensors->X_WC, snap.session->settings.slad, 0x91c07e));
    std::swap(applied->selection.sites[0], applied->selection.sites[1]);
    snap.terrain.Edit().applied = applied;
  }
  return snap;
}

std::vector<PlaybackControl> Playbacks(const Intents& intents) {
  std::vector<PlaybackControl> found;
  for (const Intent& intent : intents) {
    if (const auto* control = std::get_if<PlaybackControl>(&intent)) {
      found.push_back(*control);
    }
  }
  return found;
}

TEST(ReviewWorkspace, TextsStayInTheirPanels) {
  const FlightRecord record = Record();
  const EngineSnapshot as_recorded = Replay(false), redecided = Replay(true);
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
  const EngineSnapshot snap = Replay(false);
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

TEST(ReviewWorkspace, ClickOnTheTimelineSeeksThere) {
  const FlightRecord record = Record();
  for (const char* strip : {"timeline", "overview"}) {
    SCOPED_TRACE(strip);
    UiHarness ui(1920, 1080);
    const EngineSnapshot snap = Replay(false);
    ReviewState state;
    const auto draw = [&](UiFrame& f) {
      DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f);
    };
    ui.Frame(draw);
    const Rect r = ui.items.Find(strip)->rect;
    ui.MoveTo(ImVec2{r.x + r.w / 4, r.centre().y});
    ui.Frame(draw);
    ui.Button(true);
    ui.Frame(draw);
    auto asked = Playbacks(ui.intents);
    ASSERT_EQ(asked.size(), 1U);
    EXPECT_EQ(asked[0].kind, PlaybackControl::Kind::kSeek);
    EXPECT_NEAR(asked[0].value, 338.0 / 4, 0.5);
    ui.Frame(draw);  // holding still asks nothing more
    EXPECT_EQ(Playbacks(ui.intents).size(), 1U);
    ui.MoveTo(ImVec2{r.x + r.w / 2, r.centre().y});  // scrubbing follows
    ui.Frame(draw);
    asked = Playbacks(ui.intents);
    ASSERT_EQ(asked.size(), 2U);
    EXPECT_NEAR(asked[1].value, 338.0 / 2, 0.5);
    ui.Button(false);
    ui.Frame(draw);
    EXPECT_EQ(Playbacks(ui.intents).size(), 2U);
  }
}

TEST(ReviewWorkspace, TransportButtonsAskForTheirControl) {
  using Kind = PlaybackControl::Kind;
  const FlightRecord record = Record();
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
    const EngineSnapshot snap = Replay(false);
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
  const FlightRecord record = Record();
  EngineSnapshot snap = Replay(false);
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

TEST(ReviewWorkspace, FindsWhereTheDecisionsDiffer) {
  const FlightRecord record = Record();
  const auto found = FindDifferences(Replay(true), &record);
  ASSERT_EQ(found.size(), 2U);
  for (const ReviewDifference& difference : found) {
    EXPECT_EQ(difference.recorded, "B");
    EXPECT_EQ(difference.now, "A");
  }
  EXPECT_NEAR(found[0].at_s, 100, 0.01);
  EXPECT_NEAR(found[0].to_s, 130, 0.01);
  EXPECT_NEAR(found[1].at_s, 212, 0.01);
  EXPECT_NEAR(found[1].to_s, 229.9, 0.01);
}

// The history of the replay names other letters than the record all along; that is no difference.
TEST(ReviewWorkspace, NothingDiffersWhereNoLimitWasMoved) {
  const FlightRecord record = Record();
  const EngineSnapshot snap = Replay(false);
  EXPECT_TRUE(FindDifferences(snap, &record).empty());
  EXPECT_EQ(LimitsMoved(snap), 0);
  const TimelineView view = MakeTimeline(snap, &record, {}, MakeDarkPalette(), true);
  ASSERT_EQ(view.lanes.size(), 6U);
  EXPECT_EQ(view.lanes[2].name, "Re-decided site");
  EXPECT_TRUE(view.lanes[2].segments.empty());
  EXPECT_NE(WhyNoDifference(snap, &record).find("No limit differs"), std::string::npos);
}

TEST(ReviewWorkspace, WhatWasNotJudgedAgainStaysEmpty) {
  const FlightRecord record = Record();
  const TimelineView view = MakeTimeline(Replay(true), &record, {}, MakeDarkPalette(), true);
  const std::vector<LaneSegment>& now = view.lanes[2].segments;
  ASSERT_EQ(now.size(), 2U);
  EXPECT_NEAR(now[0].from_s, 100, 0.01);
  EXPECT_NEAR(now[0].to_s, 130, 0.01);
  EXPECT_NEAR(now[1].from_s, 212, 0.01);
  EXPECT_NEAR(now[1].to_s, 240, 0.01);
  // The record's own lane is whole.
  EXPECT_NEAR(view.lanes[1].segments.back().to_s, 337.5, 0.01);
}

TEST(ReviewWorkspace, TheDecisionIsTheRecordsOwnAndSaysTheStateAsTheChain) {
  const FlightRecord record = Record();
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch, SourceKind::kReplay);
  const auto read = [&](const char* item) {
    UiHarness ui(1920, 1080);
    ReviewState state;
    ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f); });
    return ui.items.Find(item)->text;
  };
  EXPECT_EQ(read("decision/recorded"), "A, Search");  // A by the record; the map here may say B
  snap.terrain.Edit().maps_to_rebuild = 4;
  EXPECT_EQ(read("decision/recorded"), "A, Search");
  snap = Replay(true);
  EXPECT_EQ(read("decision/recorded"), "A, Armed A");
  snap.terrain.Edit().maps_to_rebuild = 4;
  EXPECT_EQ(read("decision/now"), "––, ––");
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

TEST(ReviewWorkspace, AGapIsDrawnAndNamedAndEndsALane) {
  FlightRecord record = Record();
  record.gaps = {{90, 130}};
  std::erase_if(record.samples, [](const FlightRecordSample& sample) {
    const double t = static_cast<double>(sample.time.us) * 1e-6 - kStart_s;
    return t > 90 && t < 130;
  });
  const EngineSnapshot snap = Replay(false);
  const TimelineView view = MakeTimeline(snap, &record, {}, MakeDarkPalette(), true);
  ASSERT_EQ(view.lanes[0].segments[1].text, "Proposed");
  EXPECT_NEAR(view.lanes[0].segments[1].to_s, 90, 0.01);
  EXPECT_NEAR(view.lanes[0].segments[2].from_s, 130, 0.01);
  UiHarness ui(1920, 1080);
  ReviewState state;
  ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f); });
  ASSERT_NE(ui.items.Find("gap/0"), nullptr);
  EXPECT_EQ(ui.items.Find("gap/0")->text, "No data, 40.0 s");
}

TEST(ReviewWorkspace, TheWheelZoomsOverTheStripToo) {
  const FlightRecord record = Record();
  const EngineSnapshot snap = Replay(false);
  for (const char* strip : {"overview", "timeline"}) {
    UiHarness ui(1920, 1080);
    ReviewState state;
    const auto draw = [&](UiFrame& f) {
      DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f);
    };
    ui.Frame(draw);
    ui.MoveTo(strip);
    ui.Frame(draw);
    FeedMouseWheel(2);
    ui.Frame(draw);
    ui.Frame(draw);
    EXPECT_TRUE(state.timeline.zoomed) << strip;
    EXPECT_LT(state.timeline.to_s - state.timeline.from_s, 300) << strip;
  }
}

TEST(RedecideRun, TellsItsProgressAndSetsTheSpeedBack) {
  using Kind = PlaybackControl::Kind;
  const auto kinds = [](const Intents& intents) {
    std::string text;
    for (const PlaybackControl& control : Playbacks(intents)) {
      text += control.kind == Kind::kSeek    ? "seek "
              : control.kind == Kind::kSpeed ? "speed " + Fixed(control.value, 0) + " "
              : control.kind == Kind::kPlay  ? "play "
                                             : "pause ";
    }
    return text;
  };
  SourceStatus source;
  source.paused = true;
  source.speed = 2;
  source.duration_s = 100;
  source.position_s = 80;
  RedecideRun run;
  EXPECT_EQ(kinds(run.Begin(source, 10)), "seek speed 0 play ");
  EXPECT_EQ(kinds(run.Follow(source, 10.1)), "") << "the old status is no end";
  EXPECT_TRUE(run.running());
  source.paused = false;
  source.speed = 0;
  source.position_s = 25;
  EXPECT_EQ(kinds(run.Follow(source, 15)), "");
  EXPECT_DOUBLE_EQ(run.share(), 0.25);
  EXPECT_DOUBLE_EQ(run.left_s().value(), 15);
  RedecideRun stopped = run;
  EXPECT_EQ(kinds(stopped.Stop()), "pause speed 2 ");
  EXPECT_FALSE(stopped.running());
  EXPECT_FALSE(stopped.took_s());
  source.position_s = 100;
  source.ended = true;
  EXPECT_EQ(kinds(run.Follow(source, 30)), "speed 2 ");
  EXPECT_FALSE(run.running());
  EXPECT_DOUBLE_EQ(run.took_s().value(), 20);
}

TEST(ReviewWorkspace, TheRecordIsReadOncePerSnapshot) {
  FlightRecord record = Record();
  EngineSnapshot snap = Replay(true);
  ReviewDigest digest;
  const Palette palette = MakeDarkPalette();
  const auto site = [&] {
    return DigestOf(snap, &record, palette, true, digest).timeline.lanes[1].segments.back().text;
  };
  ASSERT_EQ(site(), "A");
  for (FlightRecordSample& sample : record.samples) {
    sample.best_site = "C";
  }
  EXPECT_EQ(site(), "A");  // kept
  ++snap.sequence;
  EXPECT_EQ(site(), "C");
}

TEST(ReviewWorkspace, ClickOnADifferenceSeeksToIt) {
  const FlightRecord record = Record();
  UiHarness ui(1920, 1080);
  const EngineSnapshot snap = Replay(true);
  ReviewState state;
  const auto draw = [&](UiFrame& f) {
    DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f);
  };
  ui.Frame(draw);
  ui.Click("difference/0", draw);
  const auto asked = Playbacks(ui.intents);
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_NEAR(asked[0].value, 100, 0.2);
}

TEST(ReviewWorkspace, LanesHoldTheStatesInOrder) {
  const FlightRecord record = Record();
  const TimelineView view = MakeTimeline(Replay(false), &record, {}, MakeDarkPalette(), true);
  ASSERT_EQ(view.lanes.size(), 6U);
  const auto& states = view.lanes[0].segments;
  ASSERT_EQ(states.size(), 4U);
  EXPECT_EQ(states[0].text + states[1].text + states[2].text + states[3].text,
            "SearchProposedArmedDescending");
  EXPECT_NEAR(states[1].from_s, 60, 0.01);
  EXPECT_NEAR(states[1].to_s, 180, 0.01);
  EXPECT_EQ(view.lanes[1].segments[0].text, "none");
  EXPECT_TRUE(view.lanes[1].segments[0].dashed);
}

TEST(TimelineStrip, LabelsRoundAsClocksDo) {
  EXPECT_EQ(TimeLabel(59.96, true), "01:00.0");
  EXPECT_EQ(TimeLabel(193.4, true), "03:13.4");
  EXPECT_EQ(TimeLabel(59.6, false), "01:00");
  EXPECT_EQ(TimeLabel(NAN, true), "00:00.0");
}

/// What the decision panel says in a replay that was entered by a jump.
std::string ReasonAfterJump(const FlightRecord& record, int missing,
                            const std::string& why_no_map) {
  EngineSnapshot snap = Replay(false);
  snap.terrain.Edit().maps_to_rebuild = missing;
  snap.terrain.Edit().why_no_map = why_no_map;
  UiHarness ui(1920, 1080);
  ReviewState state;
  ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f); });
  ExpectTextsInPanels(ui.items);
  return ui.items.Find("decision/reason")->text;
}

TEST(ReviewWorkspace, AfterAJumpItPromisesOnlyMapsThatCome) {
  FlightRecord record = Record();
  EXPECT_EQ(ReasonAfterJump(record, 4, ""),
            "After the jump the map is built anew: 4 frames still to come. Play on.");
  EXPECT_EQ(ReasonAfterJump(record, 4, "On the ground no map is made"),
            "On the ground no map is made; after a jump none is here to show. Go back and play.");
  for (const double ahead_s : {-1.0, 1.0, 2.0}) {
    record.proposals.push_back({AddSeconds({fake::kNow_us}, ahead_s), {}});
  }
  EXPECT_EQ(ReasonAfterJump(record, 2, ""),
            "After the jump the map is built anew: 2 frames still to come. Play on.");
  EXPECT_EQ(ReasonAfterJump(record, 4, ""),
            "After the jump the map lacks 4 frames, and 2 follow in this log. Go back and play.");
  record.proposals.resize(1);
  EXPECT_EQ(
      ReasonAfterJump(record, 4, ""),
      "After the jump the map lacks 4 frames, and none follows in this log. Go back and play.");
}

TEST(ReviewWorkspace, AlarmMarksHaveTheirLevelAndTheHeaviestIsOnTop) {
  FlightRecord record = Record();
  const auto at = [&](double s) { return AddSeconds({0}, kStart_s + s); };
  const auto alarm = [&](double s, std::optional<AlarmLevel> level, const char* text) {
    return Event{.time = at(s), .kind = EventKind::kAlarm, .text = text, .level = level};
  };
  record.events = {alarm(20, AlarmLevel::kAdvisory, "No cautions, 2.6 m"),
                   alarm(100, AlarmLevel::kCaution, "GPS lost"),
                   alarm(180, AlarmLevel::kWarning, "Left camera stale. Wave off"),
                   alarm(180.5, AlarmLevel::kCaution, "Laser lost"),
                   alarm(300, std::nullopt, "Acknowledged: gps_lost")};
  const Palette p = MakeDarkPalette();
  const EngineSnapshot snap = Replay(false);
  const Lane alarms = MakeTimeline(snap, &record, {}, p, true).lanes[4];
  ASSERT_EQ(alarms.name, "Alarms");
  const struct {
    Icon icon;
    ImU32 colour;
    const char* hint;
  } table[] = {{Icon::kAdvisory, p.advisory, "ADVISORY No cautions, 2.6 m"},
               {Icon::kCaution, p.caution, "CAUTION GPS lost"},
               {Icon::kWarning, p.warning, "WARNING Left camera stale. Wave off"},
               {Icon::kCaution, p.caution, "CAUTION Laser lost"},
               {Icon::kNormal, p.text2, "Acknowledged: gps_lost"}};
  ASSERT_EQ(alarms.marks.size(), std::size(table));
  for (std::size_t i = 0; i < std::size(table); ++i) {
    EXPECT_EQ(alarms.marks[i].icon, table[i].icon) << i;
    EXPECT_EQ(alarms.marks[i].colour, table[i].colour) << i;
    EXPECT_EQ(alarms.marks[i].hint, table[i].hint) << i;
  }
  UiHarness ui(1920, 1080);
  ReviewState state;
  const auto draw = [&](UiFrame& f) {
    DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f);
  };
  ui.Frame(draw);
  EXPECT_NE(ui.items.Find("mark/Alarms/2"), nullptr);
  EXPECT_EQ(ui.items.Find("mark/Alarms/3"), nullptr) << "it lies under the warning";
  EXPECT_EQ(ui.items.Find("tooltip"), nullptr);
  ui.MoveTo("mark/Alarms/2");
  ui.Frame(draw);
  ui.Frame(draw);
  ASSERT_NE(ui.items.Find("tooltip"), nullptr);
  EXPECT_EQ(ui.items.Find("tooltip")->text,
            "03:00.0  WARNING Left camera stale. Wave off\n03:00.5  CAUTION Laser lost")
      << "what lies under it speaks with it";
}

TEST(ReviewWorkspace, ANarrowWindowHasOneLaneForAlarmsAndMarks) {
  FlightRecord record = Record();
  const auto at = [&](double s) { return AddSeconds({0}, kStart_s + s); };
  record.events = {{at(20), EventKind::kFault, "Fault injected: GPS jump 3 m"},
                   {at(90), EventKind::kAlarm, "GPS lost", 0, AlarmLevel::kCaution}};
  const EngineSnapshot snap = Replay(false);
  UiHarness ui(1280, 800);
  ReviewState state;
  ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(1280, 800), state, f); });
  ASSERT_NE(ui.items.Find("mark/Alarms and marks/0"), nullptr);
  EXPECT_EQ(ui.items.Find("mark/Alarms and marks/0")->text, "CAUTION GPS lost");
  ASSERT_NE(ui.items.Find("mark/Alarms and marks/1"), nullptr);
  EXPECT_EQ(ui.items.Find("mark/Alarms and marks/1")->text, "Fault injected: GPS jump 3 m");
}

TEST(ReviewWorkspace, MarksTheWaveOffAndWhy) {
  FlightRecord record = Record();
  const auto at = [&](double s) { return AddSeconds({0}, kStart_s + s); };
  record.events = {{at(20), EventKind::kState, "DESCENDING: Aligned"},
                   {at(40), EventKind::kState, "ABORTING: Waved off by the operator"}};
  const Lane marks = MakeTimeline(Replay(false), &record, {}, MakeDarkPalette(), true).lanes[5];
  ASSERT_EQ(marks.marks.size(), 1u);
  EXPECT_EQ(marks.marks[0].text, "Wave-off");
  EXPECT_EQ(marks.marks[0].hint, "Wave-off: Waved off by the operator");
  EXPECT_NEAR(marks.marks[0].at_s, 40, 1e-3);
}

TEST(ReviewWorkspace, MarksWhereFaultsWereInjectedAndEnded) {
  FlightRecord record = Record();
  const auto at = [&](double s) { return AddSeconds({0}, kStart_s + s); };
  record.events = {{at(20), EventKind::kFault, "Fault injected: GPS jump 3 m"},
                   {at(40), EventKind::kFault, "Fault ended: GPS jump 3 m"}};
  const Lane marks = MakeTimeline(Replay(false), &record, {}, MakeDarkPalette(), true).lanes[5];
  ASSERT_EQ(marks.marks.size(), 2u);
  EXPECT_EQ(marks.marks[0].text, "GPS jump 3 m");
  EXPECT_EQ(marks.marks[0].hint, "Fault injected: GPS jump 3 m");
  EXPECT_EQ(marks.marks[1].text, "GPS jump 3 m ended");
  EXPECT_NEAR(marks.marks[1].at_s, 40, 1e-3);
}

/// Where the line of a trace is broken: x of the last point before each break.
std::vector<float> BreaksOf(const PlotTrace& trace) {
  std::vector<float> at;
  for (const ImVec2& point : trace.points) {
    if (std::isnan(point.y)) {
      at.push_back(point.x);
    }
  }
  return at;
}

TEST(ReviewWorkspace, LinesBreakWhereNothingWasMeasured) {
  FlightRecord record = Record();
  for (FlightRecordSample& sample : record.samples) {
    const double t = static_cast<double>(sample.time.us) * 1e-6 - kStart_s;
    sample.best_site = "A";
    sample.best_safe_distance_m = 4.6;
    sample.new_map = t <= 100 || (t >= 140 && t < 300);  // bundles come all the time
  }
  const EngineSnapshot snap = Replay(false);
  ReviewPlots plots = MakeReviewPlots(snap, &record, MakeDarkPalette());
  const PlotTrace& clear = plots.clear_radius.series.back();
  ASSERT_EQ(BreaksOf(clear).size(), 1U);
  EXPECT_NEAR(BreaksOf(clear)[0], 100, 0.1);
  EXPECT_NEAR(clear.points.back().x, 299.5, 0.1) << "no map was made after that";
  EXPECT_TRUE(BreaksOf(plots.height.series[0]).empty());
  EXPECT_TRUE(std::isnan(SeriesValueAt(clear, 120)));
  // No bundle at all: nothing was measured of the height either.
  std::erase_if(record.samples, [](const FlightRecordSample& sample) {
    const double t = static_cast<double>(sample.time.us) * 1e-6 - kStart_s;
    return t > 200 && t < 210;
  });
  plots = MakeReviewPlots(snap, &record, MakeDarkPalette());
  EXPECT_EQ(BreaksOf(plots.height.series[0]).size(), 1U);
  const TimelineView view = MakeTimeline(snap, &record, {}, MakeDarkPalette(), true);
  EXPECT_EQ(std::count_if(view.height.begin(), view.height.end(),
                          [](const ImVec2& point) { return std::isnan(point.y); }),
            1);
}

TEST(ReviewWorkspace, TheRecordedSiteIsTheOneFlownTo) {
  FlightRecord record = Record();
  LandingSite flown;
  flown.letter = "H";
  record.armed_sites = {flown};
  for (FlightRecordSample& sample : record.samples) {
    sample.armed = sample.state >= MissionState::kArmed ? 0 : -1;
  }
  EngineSnapshot snap = Replay(false);
  const Lane lane = MakeTimeline(snap, &record, {}, MakeDarkPalette(), true).lanes[1];
  std::string letters;
  for (const LaneSegment& segment : lane.segments) {
    letters += segment.text + " ";
  }
  EXPECT_EQ(letters, "none B H ");
  EXPECT_NEAR(lane.segments.back().from_s, 180, 0.01);

  snap.flight.Edit().mission.state = MissionState::kLanded;
  snap.flight.Edit().mission.armed->letter = "H";
  UiHarness ui(1920, 1080);
  ReviewState state;
  ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f); });
  EXPECT_TRUE(HasText(ui.items, "Landing site"));
  EXPECT_EQ(ui.items.Find("decision/recorded")->text, "H, Landed H");
}

TEST(ReviewWorkspace, AfterAJumpThePictureOfTheRecordIsNotCalledMissing) {
  EngineSnapshot snap = Replay(false);
  snap.sensors.Edit().channels[0].state = ChannelHealth::State::kStale;
  snap.sensors.Edit().channels[0].age_s = 3.2;
  EXPECT_EQ(NoPictureWords(snap), "No picture here, the last came 3.2 s before");
  snap.sensors.Edit().channels[0].state = ChannelHealth::State::kNever;
  EXPECT_EQ(NoPictureWords(snap), "No picture yet");
}

TEST(ReviewWorkspace, TheWayBackToFlyingIsBesideTheTransport) {
  const FlightRecord record = Record();
  EngineSnapshot snap = Replay(false);
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    UiHarness ui(size.width, size.height);
    ReviewState state;
    WayOut way_out{"Back to cameras", "Ends the review and opens them again"};
    const auto draw = [&](UiFrame& f) {
      f.after_review = way_out;
      DrawReviewWorkspace(snap, &record, BodyOf(size.width, size.height), state, f);
    };
    snap = Replay(false);
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
