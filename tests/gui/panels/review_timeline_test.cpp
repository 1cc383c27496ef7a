// The timeline of Review: it seeks and zooms; lanes, marks and lines tell what the record holds.
#include "gui/panels/review/review.h"
#include "tests/gui/panels/panel_checks.h"
#include "tests/gui/panels/review_flight.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

TEST(ReviewWorkspace, ClickOnTheTimelineSeeksThere) {
  const FlightRecord record = fake::Record();
  for (const char* strip : {"timeline", "overview"}) {
    SCOPED_TRACE(strip);
    UiHarness ui(1920, 1080);
    const EngineSnapshot snap = fake::Replay(false);
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

TEST(ReviewWorkspace, TheWheelZoomsOverTheStripToo) {
  const FlightRecord record = fake::Record();
  const EngineSnapshot snap = fake::Replay(false);
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

TEST(TimelineStrip, LabelsRoundAsClocksDo) {
  EXPECT_EQ(TimeLabel(59.96, true), "01:00.0");
  EXPECT_EQ(TimeLabel(193.4, true), "03:13.4");
  EXPECT_EQ(TimeLabel(59.6, false), "01:00");
  EXPECT_EQ(TimeLabel(NAN, true), "00:00.0");
}

TEST(ReviewWorkspace, LanesHoldTheStatesInOrder) {
  const FlightRecord record = fake::Record();
  const TimelineView view = MakeTimeline(fake::Replay(false), &record, {}, MakeDarkPalette(), true);
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

TEST(ReviewWorkspace, AGapIsDrawnAndNamedAndEndsALane) {
  FlightRecord record = fake::Record();
  record.gaps = {{90, 130}};
  std::erase_if(record.samples, [](const FlightRecordSample& sample) {
    const double t = static_cast<double>(sample.time.us) * 1e-6 - fake::kStart_s;
    return t > 90 && t < 130;
  });
  const EngineSnapshot snap = fake::Replay(false);
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

TEST(ReviewWorkspace, AlarmMarksHaveTheirLevelAndTheHeaviestIsOnTop) {
  FlightRecord record = fake::Record();
  const auto at = [&](double s) { return AddSeconds({0}, fake::kStart_s + s); };
  const auto alarm = [&](double s, std::optional<AlarmLevel> level, const char* text) {
    return Event{.time = at(s), .kind = EventKind::kAlarm, .text = text, .level = level};
  };
  record.events = {alarm(20, AlarmLevel::kAdvisory, "No cautions, 2.6 m"),
                   alarm(100, AlarmLevel::kCaution, "GPS lost"),
                   alarm(180, AlarmLevel::kWarning, "Left camera stale. Wave off"),
                   alarm(180.5, AlarmLevel::kCaution, "Laser lost"),
                   alarm(300, std::nullopt, "Acknowledged: gps_lost")};
  const Palette p = MakeDarkPalette();
  const EngineSnapshot snap = fake::Replay(false);
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
  FlightRecord record = fake::Record();
  const auto at = [&](double s) { return AddSeconds({0}, fake::kStart_s + s); };
  record.events = {{at(20), EventKind::kFault, "Fault injected: GPS jump 3 m"},
                   {at(90), EventKind::kAlarm, "GPS lost", 0, AlarmLevel::kCaution}};
  const EngineSnapshot snap = fake::Replay(false);
  UiHarness ui(1280, 800);
  ReviewState state;
  ui.Frame([&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(1280, 800), state, f); });
  ASSERT_NE(ui.items.Find("mark/Alarms and marks/0"), nullptr);
  EXPECT_EQ(ui.items.Find("mark/Alarms and marks/0")->text, "CAUTION GPS lost");
  ASSERT_NE(ui.items.Find("mark/Alarms and marks/1"), nullptr);
  EXPECT_EQ(ui.items.Find("mark/Alarms and marks/1")->text, "Fault injected: GPS jump 3 m");
}

TEST(ReviewWorkspace, MarksTheWaveOffAndWhy) {
  FlightRecord record = fake::Record();
  const auto at = [&](double s) { return AddSeconds({0}, fake::kStart_s + s); };
  record.events = {{at(20), EventKind::kState, "DESCENDING: Aligned"},
                   {at(40), EventKind::kState, "ABORTING: Waved off by the operator"}};
  const Lane marks =
      MakeTimeline(fake::Replay(false), &record, {}, MakeDarkPalette(), true).lanes[5];
  ASSERT_EQ(marks.marks.size(), 1u);
  EXPECT_EQ(marks.marks[0].text, "Wave-off");
  EXPECT_EQ(marks.marks[0].hint, "Wave-off: Waved off by the operator");
  EXPECT_NEAR(marks.marks[0].at_s, 40, 1e-3);
}

TEST(ReviewWorkspace, MarksWhereFaultsWereInjectedAndEnded) {
  FlightRecord record = fake::Record();
  const auto at = [&](double s) { return AddSeconds({0}, fake::kStart_s + s); };
  record.events = {{at(20), EventKind::kFault, "Fault injected: GPS jump 3 m"},
                   {at(40), EventKind::kFault, "Fault ended: GPS jump 3 m"}};
  const Lane marks =
      MakeTimeline(fake::Replay(false), &record, {}, MakeDarkPalette(), true).lanes[5];
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

// The map here says 4.8 m.
TEST(ReviewWorkspace, TheFigureAboveThePlotIsTheOneInIt) {
  FlightRecord record = fake::Record();
  for (FlightRecordSample& sample : record.samples) {
    sample.best_safe_distance_m = sample.time <= Timestamp{fake::kNow_us} ? 4.4 : 2;
  }
  EngineSnapshot snap = fake::Replay(false);
  EXPECT_EQ(MakeReviewPlots(snap, &record, MakeDarkPalette()).clear_radius.current, "4.4 m");
  EXPECT_EQ(MakeReviewPlots(snap, nullptr, MakeDarkPalette()).clear_radius.current, "4.8 m");
  snap = fake::Replay(true);  // under other limits B is the best
  EXPECT_EQ(MakeReviewPlots(snap, &record, MakeDarkPalette()).clear_radius.current, "4.4 / 4.2 m");
  // How old it is says the record, too: the map that was rebuilt may be of another time.
  snap.session.Edit().role = SessionRole::kReplayedAfterJump;
  record.proposals = {{AddSeconds(snap.time, -12), {}}};
  EXPECT_EQ(MakeReviewPlots(snap, &record, MakeDarkPalette()).clear_radius.current,
            "4.4 / 4.2 m, 12 s old");
}

TEST(ReviewWorkspace, LinesBreakWhereNothingWasMeasured) {
  FlightRecord record = fake::Record();
  for (FlightRecordSample& sample : record.samples) {
    const double t = static_cast<double>(sample.time.us) * 1e-6 - fake::kStart_s;
    sample.best_site = "A";
    sample.best_safe_distance_m = 4.6;
    sample.new_map = t <= 100 || (t >= 140 && t < 300);  // bundles come all the time
  }
  const EngineSnapshot snap = fake::Replay(false);
  ReviewPlots plots = MakeReviewPlots(snap, &record, MakeDarkPalette());
  const PlotTrace& clear = plots.clear_radius.series.back();
  ASSERT_EQ(BreaksOf(clear).size(), 1U);
  EXPECT_NEAR(BreaksOf(clear)[0], 100, 0.1);
  EXPECT_NEAR(clear.points.back().x, 299.5, 0.1) << "no map was made after that";
  EXPECT_TRUE(BreaksOf(plots.height.series[0]).empty());
  EXPECT_TRUE(std::isnan(SeriesValueAt(clear, 120)));
  // No bundle at all: nothing was measured of the height either.
  std::erase_if(record.samples, [](const FlightRecordSample& sample) {
    const double t = static_cast<double>(sample.time.us) * 1e-6 - fake::kStart_s;
    return t > 200 && t < 210;
  });
  plots = MakeReviewPlots(snap, &record, MakeDarkPalette());
  EXPECT_EQ(BreaksOf(plots.height.series[0]).size(), 1U);
  const TimelineView view = MakeTimeline(snap, &record, {}, MakeDarkPalette(), true);
  EXPECT_EQ(std::count_if(view.height.begin(), view.height.end(),
                          [](const ImVec2& point) { return std::isnan(point.y); }),
            1);
}

TEST(ReviewWorkspace, TellsHowLargeTheLogIsAndWhetherItIsWhole) {
  FlightRecord record = fake::Record();
  record.file_bytes = 1'930'000'000;
  record.gaps = {{10, 12}, {40, 45}};
  EngineSnapshot snap = fake::Replay(false);
  snap.session.Edit().source.name = "/logs/2026-05-04_1432/flight.lcm";
  const auto draw = [&](float width, float height) {
    UiHarness ui(width, height);
    ReviewState state;
    ui.Frame(
        [&](UiFrame& f) { DrawReviewWorkspace(snap, &record, BodyOf(width, height), state, f); });
    ExpectTextsInPanels(ui.items);
    return std::vector<bool>{HasText(ui.items, "2026-05-04_1432/flight.lcm"),
                             HasText(ui.items, "1.9 GB"), HasText(ui.items, "whole, 2 gaps"),
                             HasText(ui.items, "damaged, 2 gaps")};
  };
  EXPECT_EQ(draw(1920, 1080), (std::vector<bool>{true, true, true, false}));
  snap.session.Edit().source.damage = "512 bytes unreadable";
  EXPECT_EQ(draw(1920, 1080), (std::vector<bool>{true, true, false, true}));
  EXPECT_TRUE(draw(1280, 720)[3]) << "that goes before all else";
}

}  // namespace
}  // namespace palace
