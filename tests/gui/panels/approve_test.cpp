// The panel of Approve: what it offers, when each press means something, and what it says of it.
#include <utility>

#include <gtest/gtest.h>

#include "gui/panels/fly_panels.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

TEST(FlyApprove, AFullHoldApprovesTheArmedSiteOnTheSnapshotSeen) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kArmed));
  window.ui.MoveTo("approve");
  window.Run(0.05);
  window.ui.Button(true);
  window.Run(0.9);
  EXPECT_TRUE(window.ui.intents.empty());
  window.Run(0.2);
  window.ui.Button(false);
  window.Run(0.2);
  EXPECT_EQ(window.ui.intents.size(), 1u);
  EXPECT_EQ(window.ui.LastCommand<ApproveSite>().site_id, 1u);
  EXPECT_EQ(window.ui.LastCommand<ApproveSite>().snapshot_sequence, window.snap.sequence);
}

/// It covers sites and evidence: it is not there again when the selection it was opened for has
/// ended, nor after a flight on which nobody saw it.
TEST(FlyApprove, TheListOfChecksEndsWithItsSelection) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kArmed));
  window.ui.Click("show_checks", window.draw);
  window.Run(0.1);
  ASSERT_TRUE(window.fly.approve.show_guards);
  window.snap = fake::Snapshot(MissionState::kDescending);
  window.Run(0.1);
  window.snap = fake::Snapshot(MissionState::kProposed);
  window.Run(0.1);
  EXPECT_FALSE(window.fly.approve.show_guards);
}

// What stands against an approval without blocking it must not hide behind a tick.
TEST(FlyApprove, ACautionAgainstTheApprovalStandsBesideItsChecks) {
  struct Row {
    AlarmId id;
    const char *text, *words;
  };
  for (const Row& row :
       {Row{AlarmId::kTailwind, "Tailwind 4.2 m/s on the approach, limit 2.5 m/s. Take another.",
            "Tailwind 4.2 m/s on the approach; all "},
        Row{AlarmId::kUnusualLimits, "Max roughness 100.0 cm (usually 2.0 cm to 30.0 cm). See.",
            "Max roughness 100.0 cm; all "}}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
    MissionStatus& m = snap.flight.Edit().mission;
    m.armed->confirmed = true;
    const std::string all = std::to_string(m.guards.size()) + " checks pass";
    const auto words = [&] {
      FlyWindow window(1920, 1080, snap);
      ExpectTextsInPanels(window.ui.items);
      return window.ui.items.Find("show_checks")->text;
    };
    EXPECT_EQ(words(), "All " + all);
    m.alarms.push_back(
        {.kind = row.id, .level = AlarmLevel::kCaution, .text = row.text, .active = true});
    EXPECT_EQ(words(), row.words + all);
    m.alarms.back().active = false;
    EXPECT_EQ(words(), "All " + all) << "it is over";
  }
}

TEST(FlyApprove, NeverFiresWhenBlockedUnarmedPreviewingOrInReplay) {
  EngineSnapshot blocked = fake::Snapshot(MissionState::kArmed);
  blocked.flight.Edit().mission.can_approve = false;
  blocked.flight.Edit().mission.cannot_approve_reason = "Left camera stale, 1.8 s";
  EngineSnapshot preview = fake::Snapshot(MissionState::kArmed);
  preview.terrain.Edit().preview = preview.terrain->applied;
  for (const EngineSnapshot& snap : {blocked, preview, fake::Snapshot(MissionState::kProposed),
                                     fake::Snapshot(MissionState::kArmed, SourceKind::kReplay)}) {
    FlyWindow window(1920, 1080, snap);
    window.ui.MoveTo("approve");
    window.Run(0.05);
    window.ui.Button(true);
    window.Run(3);
    EXPECT_EQ(window.ui.CountCommands<ApproveSite>(), 0) << window.ui.items.Find("approve")->text;
    EXPECT_FALSE(window.ui.items.Find("approve")->enabled);
  }
}

// A selection that ends by itself puts the turns where the look stood: a press on its way to the
// look turns nothing.
TEST(FlyApprove, WhatComesUpUnderThePointerTakesNoPressAtOnce) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  snap.flight.Edit().mission.look_from_m = 12;
  const EngineSnapshot ended = fake::Snapshot(MissionState::kProposed);
  const ImVec2 turn = FlyWindow(1920, 1080, ended).ui.items.Find("turn_left")->rect.centre();
  FlyWindow window(1920, 1080, snap);
  window.ui.MoveTo(turn);
  window.ui.Frame(window.draw);
  window.snap = ended;
  window.ui.Frame(window.draw);
  ASSERT_NE(window.ui.items.Find("turn_left"), nullptr);
  EXPECT_FALSE(window.ui.items.Find("turn_left")->enabled);
  window.ui.Click("turn_left", window.draw);
  EXPECT_EQ(window.ui.CountCommands<FlyTo>(), 0);
  window.Run(1.1);
  EXPECT_TRUE(window.ui.items.Find("turn_left")->enabled);
  window.ui.Click("turn_left", window.draw);
  EXPECT_EQ(window.ui.CountCommands<FlyTo>(), 1);
}

TEST(FlyApprove, OnePressLooksFromWhereTheSiteWouldBeSure) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("look"), nullptr);
  snap.flight.Edit().mission.look_from_m = 12;
  for (const auto& [w, h] : {std::pair{1920, 1080}, {1280, 720}}) {
    FlyWindow window(w, h, snap);
    ASSERT_NE(window.ui.items.Find("look"), nullptr);
    EXPECT_EQ(window.ui.items.Find("look")->text, "Look from 12 m");
    window.ui.Click("look", window.draw);
    EXPECT_EQ(window.ui.intents.size(), 1u);
    EXPECT_EQ(window.ui.LastCommand<LookAtSite>().site_id, 1u);
    EXPECT_EQ(window.ui.LastCommand<LookAtSite>().snapshot_sequence, window.snap.sequence);
    EXPECT_EQ(window.ui.LastCommand<LookAtSite>().stop_height_m, 12);
    const Rect& look = window.ui.items.Find("look")->rect;
    for (const char* other : {"approve", "refuse", "deselect"}) {
      const Rect& rect = window.ui.items.Find(other)->rect;
      EXPECT_TRUE(look.bottom() < rect.y || look.right() + 8 < rect.x) << other << " at " << w;
    }
  }
  EngineSnapshot sure = snap;
  sure.flight.Edit().mission.armed_now = sure.flight->mission.armed;
  sure.flight.Edit().mission.armed_now->confirmed = true;
  EXPECT_EQ(FlyWindow(1920, 1080, sure).ui.items.Find("look"), nullptr);
  snap.flight.Edit().mission.can_approve = false;
  FlyWindow blocked(1920, 1080, snap);
  blocked.ui.Click("look", blocked.draw);
  EXPECT_EQ(blocked.ui.CountCommands<LookAtSite>(), 0);
  FlyWindow searching(1920, 1080, fake::Snapshot(MissionState::kProposed));
  EXPECT_EQ(searching.ui.items.Find("look"), nullptr);
}

TEST(FlyApprove, OnePressTurnsTheApproachToTheNextClearSide) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  MissionStatus& mission = snap.flight.Edit().mission;
  mission.look_from_m = 12;
  mission.approach = ApproachPlan{};
  mission.approach_sides = {kStraightApproach};
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("turn"), nullptr) << "there is no other";
  mission.approach_sides = {2, kStraightApproach, 5};
  const struct {
    int now, next;
  } rows[] = {{2, kStraightApproach}, {kStraightApproach, 5}, {5, 2}, {7, 2}};
  for (const auto& row : rows) {
    mission.approach->side = row.now;
    for (const auto& [w, h] : {std::pair{1920, 1080}, {1280, 720}}) {
      FlyWindow window(w, h, snap);
      ASSERT_NE(window.ui.items.Find("turn"), nullptr);
      window.ui.Click("turn", window.draw);
      EXPECT_EQ(window.ui.intents.size(), 1u);
      EXPECT_EQ(window.ui.LastCommand<TurnApproach>().site_id, 1u);
      EXPECT_EQ(window.ui.LastCommand<TurnApproach>().side, row.next) << "from " << row.now;
      const Rect& turn = window.ui.items.Find("turn")->rect;
      EXPECT_GT(turn.x, window.ui.items.Find("look")->rect.right()) << w;
      EXPECT_LT(turn.right(), window.ui.items.Find("deselect")->rect.x) << w;
    }
  }
}

TEST(FlyApprove, IsBlockedWhileTheScreenIsBehindTheEngine) {
  for (const double silent_s : {0.4, 0.6}) {
    FlyWindow window(1280, 720, fake::Snapshot(MissionState::kArmed));
    window.silent_s = silent_s;
    window.Run(0.05);
    window.ui.MoveTo("approve");
    window.ui.Button(true);
    window.Run(1.3);
    const bool behind = silent_s > 0.5;
    EXPECT_EQ(window.ui.CountCommands<ApproveSite>(), behind ? 0 : 1) << silent_s;
    EXPECT_EQ(HasText(window.ui.items, "Screen 0.6 s behind, limit 0.5 s"), behind)
        << window.ui.items.Find("approve")->text;
    EXPECT_EQ(HasText(window.ui.items, "checks pass"), !behind);
  }
}

TEST(FlyApprove, ChecksThatPassMakeNoConfirmedSite) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  const auto says = [&](const char* words) {
    FlyWindow window(1280, 720, snap);
    window.Run(0.05);
    return HasText(window.ui.items, words);
  };
  EXPECT_TRUE(says("All 11 checks pass"));
  LandingSite& armed = *snap.flight.Edit().mission.armed;
  armed.confirmed = false;
  armed.frames_fused = 1;
  EXPECT_TRUE(says("Provisional; all 11 checks pass"));
  armed.height_m.three_sigma = 0.2;
  EXPECT_TRUE(says("Look first; all 11 checks pass"));
}

TEST(FlyApprove, AHoldThatTheScreenCutShortSaysSo) {
  FlyWindow window(1280, 720, fake::Snapshot(MissionState::kArmed));
  window.ui.MoveTo("approve");
  window.ui.Button(true);
  window.Run(0.5);
  window.silent_s = 0.7;
  window.Run(0.1);
  window.silent_s = 0;
  window.Run(1.5);  // still pressed
  EXPECT_EQ(window.ui.CountCommands<ApproveSite>(), 0);
  EXPECT_TRUE(HasText(window.ui.items, "Hold cut: Screen 0.7 s behind"));
  window.Run(5);
  EXPECT_FALSE(HasText(window.ui.items, "Hold cut"));
}

TEST(FlyApprove, RefuseNamesTheNextSiteThatIsNotRefused) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);  // A is armed
  snap.flight.Edit().mission.refused_sites = {2};
  FlyWindow window(1920, 1080, snap);
  EXPECT_TRUE(HasText(window.ui.items, "then site C"));
}

// It stays to be looked at again, below what is offered, and whoever approves it is told.
TEST(FlyApprove, ARefusedSiteComesLastAndIsToldWhenItIsSelected) {
  for (const auto& [w, h] : {std::pair{1920, 1080}, {1280, 720}}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);  // A is armed
    FlyWindow offered(w, h, snap);
    EXPECT_TRUE(HasText(offered.ui.items, "the vehicle to land on site A."));
    snap.flight.Edit().mission.refused_sites = {1};
    FlyWindow window(w, h, snap);
    EXPECT_TRUE(HasText(window.ui.items, "to land on A, which you refused."));
    EXPECT_GT(window.ui.items.Find("site/A")->rect.y, window.ui.items.Find("site/B")->rect.y);
    ExpectTextsInPanels(window.ui.items);
  }
}

TEST(FlyApprove, SaysWhereASiteIsApprovedThatAMapCalledItUnsafe) {
  for (const int width : {1280, 1920}) {
    SCOPED_TRACE(width);
    EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);  // A is armed
    TerrainDecision map = *snap.terrain->applied;
    ASSERT_EQ(map.selection.sites.front().id, snap.flight->mission.armed->id);
    map.selection.sites.front().called_unsafe_s = 28;
    snap.terrain.Edit().applied = std::make_shared<const TerrainDecision>(map);
    FlyWindow window(width, width * 9 / 16, snap);
    EXPECT_TRUE(HasText(window.ui.items, "A map called it unsafe 28 s ago"));
  }
}

TEST(FlyApprove, TellsTheHeadingThatWillBeSigned) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  snap.flight.Edit().mission.approach = ApproachPlan{Rad(-20), Rad(45), 0.8};
  FlyWindow window(1920, 1080, snap);
  std::string all;
  for (const Item& item : window.ui.items.items()) {
    all += item.text + " ";
  }
  EXPECT_NE(all.find("heading 340°"), std::string::npos);
  EXPECT_NE(all.find("at 0.8 m/s"), std::string::npos);
}

TEST(Approve, WhatIsSaidOfTheButtonDoesNotCoverIt) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
    snap.flight.Edit().mission.can_approve = false;
    snap.flight.Edit().mission.cannot_approve_reason =
        "Attitude is 3.0° off gravity, limit 1.5° (or the accelerometer errs): wait until it is "
        "known again";
    FlyWindow window(size.x, size.y, snap);
    const Rect button = window.ui.items.Find("approve")->rect;
    window.ui.MoveTo("approve");
    window.ui.Frame(window.draw);
    window.ui.Frame(window.draw);
    const Item* told = window.ui.items.Find("tooltip");
    ASSERT_NE(told, nullptr);
    EXPECT_EQ(told->text, snap.flight->mission.cannot_approve_reason);
    EXPECT_FALSE(Touch(told->rect, button)) << size.x;
    EXPECT_TRUE(Inside(told->rect, {0, 0, size.x, size.y})) << size.x;
  }
}

}  // namespace
}  // namespace palace
