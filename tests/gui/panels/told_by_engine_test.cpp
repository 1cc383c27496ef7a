// The window tells what the engine says and enforces, and nothing beside it: limits that nobody
// enforces forbid nothing, ages are judged by the channel's state, words follow source and role.
#include <algorithm>

#include <gtest/gtest.h>

#include "gui/panels/fly_panels.h"
#include "gui/panels/review/review.h"
#include "gui/panels/tune/tune.h"
#include "gui/widgets/number_text.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

LimitRow& Row(EngineSnapshot& snap, LimitId id) {
  auto& rows = snap.flight.Edit().mission.limits;
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](auto& row) { return row.id == id; });
  EXPECT_NE(found, rows.end());
  return *found;
}

TEST(PlotLimits, ForbidOnlyWhatSomebodyEnforces) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  Row(snap, LimitId::kCoherence).enforced_by = EnforcedBy::kNobody;
  FlyWindow window(1920, 1080, snap);
  const Item* rate = window.ui.items.Find("plot_limit/rate");
  const Item* coherence = window.ui.items.Find("plot_limit/coherence");
  ASSERT_TRUE(rate != nullptr && coherence != nullptr);
  EXPECT_TRUE(rate->enabled);
  EXPECT_EQ(rate->text, "Limit 1.50 m/s");
  EXPECT_FALSE(coherence->enabled);
  EXPECT_EQ(coherence->text, "For information: 0.70");
}

TEST(PlotLimits, TheDistanceFromTheCentreHasALimitWhileTheEngineSaysSo) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("plot_limit/distance"), nullptr);
  snap.flight.Edit().mission.limits[0] = {.id = LimitId::kFromCentre,
                                          .label = "From centre",
                                          .value = 0.1,
                                          .limit = 0.7,
                                          .unit = "m",
                                          .enforced_by = EnforcedBy::kAlarm};
  auto history = *snap.flight->history;
  for (std::size_t i = history.size() - 50; i < history.size(); ++i) {
    history[i].centre_limited = true;
  }
  snap.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
  FlyWindow window(1920, 1080, snap);
  const Item* limit = window.ui.items.Find("plot_limit/distance");
  ASSERT_NE(limit, nullptr);
  EXPECT_EQ(limit->text, "Limit 0.7 m");
  EXPECT_TRUE(limit->enabled);
  // It began 4.9 s ago, of the 40 s of past and 24 s of future that the plot holds.
  const Rect plot = window.ui.items.Find("plot/distance")->rect;
  EXPECT_NEAR(limit->rect.x, plot.x + 52 + (plot.w - 66) * (40 - 4.9f) / 64, 2);
}

TEST(StatusBar, TellsWhatIsInjectedIntoTheFlightAndNothingWhileNothingIs) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("status/Faults"), nullptr);
  snap.session.Edit().injected_faults = {"GPS jump 3 m"};
  FlyWindow one(1920, 1080, snap);
  EXPECT_EQ(one.ui.items.Find("status/Faults")->text, "1 fault injected: GPS jump 3 m");
  snap.session.Edit().injected_faults.emplace_back("laser stuck");
  for (const int width_px : {1920, 1280}) {
    FlyWindow two(width_px, 1080, snap);
    const Item* chip = two.ui.items.Find("status/Faults");
    EXPECT_EQ(chip->text, "2 faults injected: GPS jump 3 m, laser stuck");
    const Rect bar = two.ui.items.Find("panel/Status bar")->rect;
    EXPECT_GE(chip->rect.y, bar.y);
    EXPECT_LE(chip->rect.bottom(), bar.bottom());
  }
}

TEST(Evidence, OfAnArmedSiteStandsUnderTheLimitsItWasArmedUnder) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  snap.session.Edit().preview_settings.slad.limits.max_slope_deg = 1;
  snap.terrain.Edit().preview =
      fake::Decision(snap.sensors->X_WC, snap.session->preview_settings.slad, 0x91c07e);
  FlyWindow window(1920, 1080, snap);
  EXPECT_EQ(window.ui.items.Find("evidence/Slope")->text, "Slope 1.9 ± 0.3° max 10°, guard");
}

// Where nothing that is enforced is known, nothing is inside.
TEST(LimitsInForce, ClaimNothingOfWhatIsNotMeasured) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  for (LimitRow& row : snap.flight.Edit().mission.limits) {
    row.value = NAN;
    row.enforced_by = EnforcedBy::kNobody;
  }
  const FlyWindow window(1920, 1080, snap);
  EXPECT_TRUE(HasText(window.ui.items, "Nothing measured"));
  EXPECT_FALSE(HasText(window.ui.items, "All inside"));
}

TEST(LimitsInForce, CountAndShowWhateverIsOver) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  Row(snap, LimitId::kExposure).over = true;  // stands in no list of the panel
  Row(snap, LimitId::kSlope).over = true;     // a narrow window leaves it out
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    SCOPED_TRACE(size.x);
    FlyWindow window(size.x, size.y, snap);
    EXPECT_TRUE(HasText(window.ui.items, "2 over a limit"));
    EXPECT_FALSE(HasText(window.ui.items, "All inside"));
    const Rect panel = window.ui.items.Find("panel/Limits in force")->rect;
    for (const char* name : {"evidence/Brighter over darker picture", "evidence/Slope"}) {
      const Item* row = window.ui.items.Find(name);
      ASSERT_NE(row, nullptr) << name;
      EXPECT_TRUE(Inside(row->rect, panel)) << name;
    }
  }
}

TEST(LimitsInForce, SayHowManyAreUnknownAlsoOfThoseNotListed) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  Row(snap, LimitId::kRangeScale).value = NAN;
  FlyWindow window(1920, 1080, snap);
  EXPECT_TRUE(HasText(window.ui.items, "1 unknown"));
}

TEST(VehiclePanel, PositionErrorIsOfTheEstimateInForce) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  snap.flight.Edit().navigation.vision.estimate.sigma_p_m = {0.03, 0, 0};
  snap.flight.Edit().navigation.gps.estimate.sigma_p_m = {1, 0, 0};
  snap.flight.Edit().navigation.handover = NavigationStatus::Handover::kSettling;
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("readout/Position error")->text,
            "3.00 m, 3σ");
  snap.flight.Edit().navigation.handover = NavigationStatus::Handover::kVision;
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("readout/Position error")->text,
            "0.09 m, 3σ");
}

TEST(Freshness, IsTheChannelsStateWhateverItsAge) {
  using State = ChannelHealth::State;
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  auto& channels = snap.sensors.Edit().channels;
  const auto set = [&](ChannelId id, State state, double age_s) {
    auto& channel = channels[static_cast<std::size_t>(id)];
    channel.state = state;
    channel.age_s = age_s;
  };
  set(ChannelId::kVehicleStatus, State::kFresh, 7);  // sent every 10 s: nothing is late
  set(ChannelId::kCameraLeft, State::kFresh, 1.6);
  {
    FlyWindow window(1920, 1080, snap);
    EXPECT_FALSE(HasText(window.ui.items, "s old"));
  }
  set(ChannelId::kCameraLeft, State::kStale, 0.6);  // a fast camera that stopped
  {
    FlyWindow window(1920, 1080, snap);
    EXPECT_TRUE(HasText(window.ui.items, "0.6 s old"));
  }
}

TEST(ChannelStrip, TheStateDecidesAndTheAgeIsAlwaysShown) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  ChannelHealth& gps = snap.sensors.Edit().channels[4];
  gps.state = ChannelHealth::State::kFresh;
  gps.age_s = 0.1;
  gps.note = "limit";
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("channel/GPS")->text,
            "100 ms   5.0 Hz   limit");
}

TEST(Pictures, ACameraThatRepeatsItsPictureIsNamedWhereItIsShown) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  snap.terrain.Edit().stereo_quality.right_frozen = true;
  FlyWindow window(1920, 1080, snap);
  EXPECT_EQ(window.ui.items.Find("channel/Camera right")->text, "Repeats its picture");
  EXPECT_NE(window.ui.items.Find("channel/Camera left")->text, "Repeats its picture");
  const auto plates = [&] {
    int count = 0;
    for (const Item& item : window.ui.items.items()) {
      count += item.name == "text" && item.text == "Repeats its picture" ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(plates(), 2) << "on the tile and over the picture";
  window.snap.session.Edit().role = SessionRole::kPictures;
  window.Run(0.1);
  EXPECT_EQ(plates(), 0) << "a folder repeats its last pair";
  window.snap.session.Edit().role = snap.session->role;
  window.snap.terrain.Edit().stereo_quality.left_blank = true;
  window.snap.terrain.Edit().stereo_quality.left_frozen = true;  // black twice
  window.Run(0.1);
  EXPECT_EQ(window.ui.items.Find("channel/Camera left")->text, "Shows nothing");
}

TEST(ChannelStrip, AGpsThatJumpedIsNoGoodOne) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  snap.sensors.Edit().channels[4].state = ChannelHealth::State::kFresh;
  FlyWindow window(1920, 1080, snap);
  EXPECT_NE(window.ui.items.Find("channel/GPS")->text, "Off the prediction");
  Alarm jump;
  jump.kind = AlarmId::kGpsJump;
  window.snap.flight.Edit().mission.alarms.push_back(jump);
  window.Run(0.1);
  EXPECT_EQ(window.ui.items.Find("channel/GPS")->text.rfind("Off the prediction", 0), 0u);
}

TEST(StatusBar, TellsWhatWasNeverHeardFromWhatIsStale) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  auto& channels = snap.sensors.Edit().channels;
  channels[4].state = ChannelHealth::State::kStale;
  channels[5].state = ChannelHealth::State::kNever;
  FlyWindow window(1280, 720, snap);
  EXPECT_TRUE(HasText(window.ui.items, "6 fresh, 1 late or stale, 1 never heard"));
}

// What comes in time and shows nothing new, or half of the time, is not well.
TEST(StatusBar, CountsNoChannelAsFreshThatRepeatsOrLoses) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  auto& channels = snap.sensors.Edit().channels;
  for (ChannelHealth& channel : channels) {
    channel.state = ChannelHealth::State::kFresh;
    channel.lost_share = 0.1;  // the limit itself
  }
  EXPECT_TRUE(HasText(FlyWindow(1280, 720, snap).ui.items, "Channels: 8 fresh"));
  channels[2].lost_share = 0.6;
  channels[7].lost_share = 0.6;  // the station's own estimate: it is made, not sent
  snap.terrain.Edit().stereo_quality.left_frozen = true;
  snap.terrain.Edit().stereo_quality.right_frozen = true;
  FlyWindow window(1280, 720, snap);
  EXPECT_TRUE(HasText(window.ui.items, "Channels: 5 fresh, 3 wrong or lossy"));
  FlyWindow wide(1920, 1080, snap);
  EXPECT_EQ(wide.ui.items.Find("channel/Vehicle pose")->text.rfind("60 % lost", 0), 0u);
}

TEST(SiteList, OffersNothingWhereTheSessionMayNotSelect) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kProposed, SourceKind::kReplay));
  EXPECT_FALSE(window.ui.items.Find("site/A")->enabled);
  EXPECT_TRUE(HasText(window.ui.items, "Sites cannot be selected here."));
  window.ui.Click("site/A", window.draw);
  EXPECT_EQ(window.ui.CountCommands<SelectSite>(), 0);
}

TEST(LinkWords, FollowTheSource) {
  const struct {
    SourceKind kind;
    const char* words;
  } table[] = {{SourceKind::kReplay, "No link in replay"},
               {SourceKind::kImages, "No vehicle, pictures only"},
               {SourceKind::kCameras, "No vehicle, cameras only"},
               {SourceKind::kVideo, "No vehicle in a video"},
               {SourceKind::kLive, "No link"}};
  for (const auto& row : table) {
    SCOPED_TRACE(row.words);
    EngineSnapshot snap = fake::Snapshot(MissionState::kDescending, row.kind);
    snap.session.Edit().can_transmit = false;
    FlyWindow flying(1920, 1080, snap);
    EXPECT_EQ(flying.ui.items.Find("wave_off")->text, std::string("WAVE OFF | ") + row.words);
    flying.ui.MoveTo("hold_here");
    flying.Run(1);
    EXPECT_TRUE(HasText(flying.ui.items, row.words));
    snap = fake::Snapshot(MissionState::kProposed, row.kind);
    snap.session.Edit().can_transmit = false;
    snap.flight.Edit().mission.cannot_approve_reason = row.words;
    FlyWindow proposed(1920, 1080, snap);
    EXPECT_NE(proposed.ui.items.Find("approve")->text.find(row.words), std::string::npos)
        << proposed.ui.items.Find("approve")->text;
  }
}

TEST(BestSite, IsTheBestThatStands) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  EXPECT_EQ(BestSite(snap, snap.terrain->applied.get())->letter, "A");
  snap.flight.Edit().mission.refused_sites = {1};
  EXPECT_EQ(BestSite(snap, snap.terrain->applied.get())->letter, "B");
  EXPECT_EQ(FactsOf(snap).best_shown->letter, "B");
  UiHarness ui(1920, 1080);
  TuneState state;
  ui.Frame([&](UiFrame& f) { DrawTuneWorkspace(snap, BodyOf(1920, 1080), state, f); });
  EXPECT_NE(ui.items.Find("panel/Site chosen"), nullptr);
  EXPECT_TRUE(HasText(
      ui.items, Fixed(snap.terrain->applied->selection.sites[1].safe_distance_m, 1) + " m clear"));
}

TEST(Tune, SaysWhenLimitsApplyAsTheEngineDoes) {
  const struct {
    LimitsApply apply;
    bool drops, pending;
    const char* sentence;
  } table[] = {
      {LimitsApply::kAtOnce, false, false, "Limits apply at once."},
      {LimitsApply::kWhenApplied, true, true, "Applying ends the selection of A."},
      {LimitsApply::kWhenApplied, false, true, "1 change waits to be applied."},  // under HOLD
      {LimitsApply::kNotNow, false, true, "1 change, preview only."},
      {LimitsApply::kWhenApplied, true, false, "Nothing waits to be applied."},
  };
  for (const auto& row : table) {
    SCOPED_TRACE(row.sentence);
    EngineSnapshot snap =
        fake::Snapshot(MissionState::kArmed);  // the state tells the panel nothing
    snap.session.Edit().limits_apply = row.apply;
    snap.session.Edit().apply_drops = row.drops;
    if (row.pending) {
      snap.session.Edit().preview_settings.slad.limits.max_slope_deg = 6;
      snap.terrain.Edit().preview = snap.terrain->applied;
    }
    UiHarness ui(1920, 1080);
    TuneState state;
    ui.Frame([&](UiFrame& f) { DrawTuneWorkspace(snap, BodyOf(1920, 1080), state, f); });
    EXPECT_TRUE(HasText(ui.items, row.sentence));
    EXPECT_EQ(ui.items.Find("apply")->enabled,
              row.pending && row.apply == LimitsApply::kWhenApplied);
  }
}

TEST(Review, PlotsAndChangedCellsAreWorkedOutOnceASnapshot) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed, SourceKind::kReplay);
  snap.terrain.Edit().recorded = snap.terrain->applied;
  UiHarness ui(1920, 1080);
  ReviewState state;
  const auto draw = [&](UiFrame& f) {
    DrawReviewWorkspace(snap, nullptr, BodyOf(1920, 1080), state, f);
  };
  ui.Frame(draw);
  EXPECT_TRUE(HasText(ui.items, ClockText(snap.time) + " log"));
  EXPECT_FALSE(state.digest.changed_cells.empty());
  state.digest.plots.height.title = "Kept";
  ui.Frame(draw);
  EXPECT_EQ(ui.items.Find("plot/height")->text.rfind("Kept", 0), 0U);
  ++snap.sequence;
  ui.Frame(draw);
  EXPECT_EQ(ui.items.Find("plot/height")->text.rfind("Height", 0), 0U);
}

TEST(ModeBlock, IsNoLinkUntilSomethingIsHeardOfTheVehicle) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  snap.session.Edit().source.kind = SourceKind::kLive;
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("mode")->text, "LIVE");
  for (ChannelHealth& channel : snap.sensors.Edit().channels) {
    channel.state = ChannelHealth::State::kNever;
  }
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("mode")->text, "NO LINK");
}

TEST(DescentPlots, ABandIsOfItsOwnInstant) {
  // The estimate grows unsure now; what was known before stays as sure as it was.
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  auto history = *snap.flight->history;
  for (HistorySample& sample : history) {
    sample.estimate_sigma_m = {0.1, 0.1, 0.1};
    sample.descent_rate_sigma_mps = 0.1;
  }
  history.back().estimate_sigma_m = {9, 9, 9};
  history.back().descent_rate_sigma_mps = 9;
  snap.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
  int banded = 0;
  for (const PlotView& plot : DescentPlots(snap, Palette{})) {
    const std::vector<float>& band = plot.series.front().band;
    if (band.empty()) {
      continue;
    }
    ++banded;
    ASSERT_EQ(band.size(), plot.series.front().points.size());
    EXPECT_LT(band.front(), 0.6f) << plot.name;
    EXPECT_GT(band.back(), 20.0f) << plot.name;
  }
  EXPECT_EQ(banded, 4);
}

TEST(DepthTint, LiesOnThePictureItWasMeasuredInAndOnNoOther) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kSearch));
  window.ui.textures.range_tint = &window.ui;
  window.fly.camera.show_depth = true;
  auto range = std::make_shared<RangeMap>(*window.snap.terrain->range);
  range->time = window.snap.sensors->frame->time;
  window.snap.terrain.Edit().range = range;
  window.ui.Frame(window.draw);
  EXPECT_FALSE(HasText(window.ui.items, "Last depth"));
  auto old = std::make_shared<RangeMap>(*range);
  old->time = AddSeconds(window.snap.time, -9);
  window.snap.terrain.Edit().range = old;
  window.ui.Frame(window.draw);
  EXPECT_TRUE(HasText(window.ui.items, "Last depth 9.0 s ago"));
}

}  // namespace
}  // namespace palace
