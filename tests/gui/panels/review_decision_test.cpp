// Decisions in Review: the record's own, and those under other limits; where they differ; how the
// flight is judged anew.
#include "gui/panels/review/review.h"
#include "gui/widgets/number_text.h"
#include "tests/gui/panels/panel_checks.h"
#include "tests/gui/panels/review_flight.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

TEST(ReviewWorkspace, TheDecisionIsTheRecordsOwnAndSaysTheStateAsTheChain) {
  const FlightRecord record = fake::Record();
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
  snap = fake::Replay(true);
  EXPECT_EQ(read("decision/recorded"), "A, Armed A");
  snap.terrain.Edit().maps_to_rebuild = 4;
  EXPECT_EQ(read("decision/now"), "––, ––");
}

/// The map that was built anew after the jump says 4.8 m of A, the flight's said 4.4 m.
TEST(ReviewWorkspace, AfterAJumpTheRecordedFiguresAreThoseOfTheRecord) {
  FlightRecord record = fake::Record();
  record.proposals = {
      {AddSeconds({fake::kNow_us}, -0.1), {{1, "A", {3, 5.1}, 4.4, {Rad(1.7), 0}, {0, 0.016}}}}};
  EngineSnapshot snap = fake::Replay(true);
  snap.session.Edit().role = SessionRole::kReplayedAfterJump;
  const auto read = [&](const char* item) {
    UiHarness ui(1920, 1080);
    ReviewState state;
    ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f); });
    ExpectTextsInPanels(ui.items);
    return ui.items.Find(item)->text;
  };
  EXPECT_EQ(read("decision/figures"), "4.4 m, 1.7°, under 1.6 cm, ––");
  const std::string rebuilt = "On this map, rebuilt after a jump, the flight's limits give 4.8 m";
  EXPECT_EQ(read("decision/reason").rfind(rebuilt, 0), 0U) << read("decision/reason");
  record.proposals[0].places[0].safe_distance_m = 4.8;
  EXPECT_EQ(read("decision/reason").find("rebuilt"), std::string::npos);
  record.proposals.clear();  // what no message tells is unknown
  EXPECT_EQ(read("decision/figures"), "––, ––, ––, ––");
  snap.session.Edit().role = SessionRole::kReplayed;  // seen from its start: the same maps
  EXPECT_EQ(read("decision/figures").rfind("4.8 m, ", 0), 0U);
}

TEST(ReviewWorkspace, TheRecordedSiteIsTheOneFlownTo) {
  FlightRecord record = fake::Record();
  LandingSite flown;
  flown.letter = "H";
  record.armed_sites = {flown};
  for (FlightRecordSample& sample : record.samples) {
    sample.armed = sample.state >= MissionState::kArmed ? 0 : -1;
  }
  EngineSnapshot snap = fake::Replay(false);
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

/// Under the limits tried A still holds, but B ranks before it: both are said.
TEST(ReviewWorkspace, APlaceThatIsKeptAndNoLongerFirstIsSaidSo) {
  const FlightRecord record = fake::Record();
  EngineSnapshot snap = fake::Replay(true);
  snap.flight.Edit().mission.armed.reset();
  snap.flight.Edit().mission.state = MissionState::kSearch;
  const auto decision = [&](const char* letter, bool kept) {
    snap.terrain.Edit().site_review = SiteReview{letter, kept, "Slope 3.0°."};
    UiHarness ui(1920, 1080);
    ReviewState state;
    ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f); });
    return ui.items.Find("decision/now")->text + ": " + ui.items.Find("decision/reason")->text;
  };
  EXPECT_EQ(decision("A", true), "B, Keeps A: B ranks first. Slope 3.0°.");
  EXPECT_EQ(decision("B", true), "B, Keeps B: Slope 3.0°.");
  EXPECT_EQ(decision("A", false), "B, Refuses A: Slope 3.0°.");
}

TEST(ReviewWorkspace, TheRecordIsReadOncePerSnapshot) {
  FlightRecord record = fake::Record();
  EngineSnapshot snap = fake::Replay(true);
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

TEST(ReviewWorkspace, FindsWhereTheDecisionsDiffer) {
  const FlightRecord record = fake::Record();
  const auto found = FindDifferences(fake::Replay(true), &record);
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
  const FlightRecord record = fake::Record();
  const EngineSnapshot snap = fake::Replay(false);
  EXPECT_TRUE(FindDifferences(snap, &record).empty());
  EXPECT_EQ(LimitsMoved(snap), 0);
  const TimelineView view = MakeTimeline(snap, &record, {}, MakeDarkPalette(), true);
  ASSERT_EQ(view.lanes.size(), 6U);
  EXPECT_EQ(view.lanes[2].name, "Re-decided site");
  EXPECT_TRUE(view.lanes[2].segments.empty());
  EXPECT_NE(WhyNoDifference(snap, {}).find("No limit differs"), std::string::npos);
}

TEST(ReviewWorkspace, WhatWasNotJudgedAgainStaysEmpty) {
  const FlightRecord record = fake::Record();
  const TimelineView view = MakeTimeline(fake::Replay(true), &record, {}, MakeDarkPalette(), true);
  const std::vector<LaneSegment>& now = view.lanes[2].segments;
  ASSERT_EQ(now.size(), 2U);
  EXPECT_NEAR(now[0].from_s, 100, 0.01);
  EXPECT_NEAR(now[0].to_s, 130, 0.01);
  EXPECT_NEAR(now[1].from_s, 212, 0.01);
  EXPECT_NEAR(now[1].to_s, 240, 0.01);
  // The record's own lane is whole.
  EXPECT_NEAR(view.lanes[1].segments.back().to_s, 337.5, 0.01);
}

TEST(ReviewWorkspace, ClickOnADifferenceRunsInToIt) {
  const FlightRecord record = fake::Record();
  UiHarness ui(1920, 1080);
  const EngineSnapshot snap = fake::Replay(true);
  ReviewState state;
  const auto draw = [&](UiFrame& f) {
    DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f);
  };
  ui.Frame(draw);
  ui.Click("difference/0", draw);
  const auto asked = Playbacks(ui.intents);
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_EQ(asked[0].kind, PlaybackControl::Kind::kSeek);
  EXPECT_NEAR(asked[0].value, 98, 0.2) << "two seconds before, for the map";
  EXPECT_EQ(asked[1].kind, PlaybackControl::Kind::kPlay);
  EXPECT_TRUE(state.run_in.running());
}

/// What the decision panel says in a replay that was entered by a jump.
std::string ReasonAfterJump(const FlightRecord& record, int missing,
                            const std::string& why_no_map) {
  EngineSnapshot snap = fake::Replay(false);
  snap.terrain.Edit().maps_to_rebuild = missing;
  snap.terrain.Edit().why_no_map = why_no_map;
  UiHarness ui(1920, 1080);
  ReviewState state;
  ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f); });
  ExpectTextsInPanels(ui.items);
  return ui.items.Find("decision/reason")->text;
}

TEST(ReviewWorkspace, AfterAJumpItPromisesOnlyMapsThatCome) {
  FlightRecord record = fake::Record();
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

/// However the log was played: done is what was judged under these limits.
TEST(ReviewWorkspace, WhichPartWasDecidedAgainIsWhatWasJudged) {
  FlightRecord record = fake::Record();
  const EngineSnapshot snap = fake::Replay(true);
  const auto redecided = *snap.terrain->redecided;
  const auto words = [&] {
    UiHarness ui(1920, 1080);
    ReviewState state;
    ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f); });
    ExpectTextsInPanels(ui.items);
    return ui.items.Find("redecide")->text;
  };
  for (const RedecidedSample& sample : redecided) {
    record.proposals.push_back({sample.time, {}});
    record.proposals.push_back({sample.time, {}});  // a limit moved in the flight: the same map
  }
  EXPECT_EQ(words(), "Re-decide whole flight");
  record.proposals.push_back({AddSeconds(redecided.back().time, 0.1), {}});
  const std::string judged = std::to_string(redecided.size());
  EXPECT_EQ(words(), "Re-decide all; " + judged + " of " + std::to_string(redecided.size() + 1) +
                         " maps done");
  EXPECT_EQ(WhyNoDifference(snap, {210, 352}),
            "None in the 210 of 352 maps judged under these limits so far.");
}

// Undone while it runs: there is nothing left to decide again.
TEST(RedecideRun, EndsWhenTheLimitsAreThoseOfTheFlightAgain) {
  const FlightRecord record = fake::Record();
  ReviewState state;
  state.redecide.Begin(SourceStatus{}, 0);
  const auto draw = [&](bool moved) {
    const EngineSnapshot snap = fake::Replay(moved);
    UiHarness ui(1920, 1080);
    ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(1920, 1080), state, f); });
    return Playbacks(ui.intents);
  };
  draw(true);
  EXPECT_TRUE(state.redecide.running());
  const std::vector<PlaybackControl> asked = draw(false);
  EXPECT_FALSE(state.redecide.running());
  ASSERT_FALSE(asked.empty());
  EXPECT_EQ(asked.front().kind, PlaybackControl::Kind::kPause);
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
  EXPECT_EQ(kinds(run.Follow(source, 10.2)), "") << "nor is a status from before the jump";
  source.jumps = 1;
  source.position_s = 25;
  EXPECT_EQ(kinds(run.Follow(source, 15)), "");
  EXPECT_DOUBLE_EQ(run.share(), 0.25);
  EXPECT_DOUBLE_EQ(run.left_s().value(), 15);
  RedecideRun stopped = run;
  EXPECT_EQ(kinds(stopped.Stop()), "pause speed 2 ");
  EXPECT_FALSE(stopped.running());
  EXPECT_FALSE(stopped.took_s());
  RedecideRun dragged = run;
  SourceStatus elsewhere = source;
  elsewhere.jumps = 2;
  elsewhere.position_s = 90;
  EXPECT_EQ(kinds(dragged.Follow(elsewhere, 16)), "speed 2 ") << "it would skip what lies between";
  EXPECT_FALSE(dragged.running());
  EXPECT_FALSE(dragged.took_s());
  source.position_s = 100;
  source.ended = true;
  EXPECT_EQ(kinds(run.Follow(source, 30)), "speed 2 ");
  EXPECT_FALSE(run.running());
  EXPECT_DOUBLE_EQ(run.took_s().value(), 20);
}

}  // namespace
}  // namespace palace
