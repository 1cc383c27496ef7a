// One table binds, documents and tests every key.
#include "gui/app/keys.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/support/fake_snapshot.h"

namespace palace {
namespace {

TEST(Keys, EveryKeyIsBoundOnceAndDescribed) {
  std::set<std::string> seen;
  for (const KeyBinding& binding : KeyTable()) {
    EXPECT_TRUE(seen.insert(binding.keys).second) << binding.keys << " is bound twice";
    EXPECT_FALSE(binding.description.empty()) << binding.keys;
  }
}

TEST(Keys, NoKeyApprovesOnPress) {
  EngineSnapshot snapshot;
  for (const KeyBinding& binding : KeyTable()) {
    for (const Intent& intent : IntentsOfKey(binding.keys, &snapshot, UiState{}, false)) {
      const auto* command = std::get_if<CommandAction>(&intent);
      EXPECT_FALSE(command && (std::holds_alternative<ApproveSite>(*command) ||
                               std::holds_alternative<SelectSite>(*command)))
          << binding.keys;
    }
  }
}

TEST(Keys, WhileTypingOnlyKeysWorkThatPrintNothing) {
  EngineSnapshot snapshot;
  const std::set<std::string> silent = {"Shift+Escape", "F1", "F2",  "F3",
                                        "F4",           "F5", "F12", "Ctrl+Q"};
  for (const KeyBinding& binding : KeyTable()) {
    const bool works = !IntentsOfKey(binding.keys, &snapshot, UiState{}, true).empty();
    EXPECT_EQ(works, silent.count(binding.keys) != 0) << binding.keys;
  }
}

TEST(Keys, TheFocusedControlHasItsOwnKeys) {
  EngineSnapshot snapshot;
  snapshot.session.Edit().source.can_seek = true;
  UiState state;
  const auto works = [&](const char* keys) {
    return !IntentsOfKey(keys, &snapshot, state, false).empty();
  };
  const auto frame = [&](unsigned keys) {
    state.focus.BeginFrame();
    state.focus.Offer("a", {}, keys);
    state.focus.EndFrame({});
  };
  state.focus.Show("a");
  frame(kPressKeys);
  EXPECT_FALSE(works("Space"));
  EXPECT_TRUE(works("Left"));
  frame(kPressKeys | kSideKeys);
  EXPECT_FALSE(works("Left"));
  EXPECT_FALSE(works("Shift+Right"));
  EXPECT_TRUE(works("Ctrl+Left"));
  EXPECT_TRUE(works("Shift+Escape"));
  state.focus.Clear();
  frame(kPressKeys | kSideKeys);
  EXPECT_TRUE(works("Space"));
  EXPECT_TRUE(works("Left"));
}

TEST(Keys, WaveOffWorksOverAPopup) {
  UiState state;
  state.key_help = true;
  EXPECT_EQ(IntentsOfKey("Shift+Escape", nullptr, state, false).size(), 1u);
  EXPECT_TRUE(IntentsOfKey("F3", nullptr, state, false).empty());
}

TEST(Keys, SpacePlaysWhateverStandsStill) {
  using Kind = PlaybackControl::Kind;
  const struct {
    bool paused, ended;
    Kind asks;
  } table[] = {{false, false, Kind::kPause},
               {true, false, Kind::kPlay},
               {false, true, Kind::kPlay},
               {true, true, Kind::kPlay}};
  for (const auto& row : table) {
    EngineSnapshot snapshot = fake::Snapshot(MissionState::kSearch, SourceKind::kReplay);
    snapshot.session.Edit().source.paused = row.paused;
    snapshot.session.Edit().source.ended = row.ended;
    const Intents intents = IntentsOfKey("Space", &snapshot, UiState{}, false);
    ASSERT_EQ(intents.size(), 1u);
    EXPECT_EQ(std::get<PlaybackControl>(intents[0]).kind, row.asks) << row.paused << row.ended;
  }
}

TEST(Keys, DTakesTheSelectionBackAndNothingElse) {
  for (const MissionState state : {MissionState::kProposed, MissionState::kArmed,
                                   MissionState::kApproved, MissionState::kDescending}) {
    const EngineSnapshot snapshot = fake::Snapshot(state);
    const Intents intents = IntentsOfKey("D", &snapshot, UiState{}, false);
    ASSERT_EQ(intents.size(), state == MissionState::kArmed ? 1u : 0u) << MissionStateName(state);
    if (!intents.empty()) {
      EXPECT_TRUE(std::holds_alternative<DisarmSite>(std::get<CommandAction>(intents[0])));
    }
  }
}

TEST(Keys, WhatIsAliveIsNotAskedToWait) {
  for (const auto& [kind, obeys] :
       {std::pair(SourceKind::kLive, false), std::pair(SourceKind::kCameras, false),
        std::pair(SourceKind::kSimulation, true), std::pair(SourceKind::kReplay, true),
        std::pair(SourceKind::kImages, true), std::pair(SourceKind::kVideo, true)}) {
    const EngineSnapshot snapshot = fake::Snapshot(MissionState::kSearch, kind);
    for (const char* keys : {"Space", ".", "Ctrl+Right", "]", "[", "\\"}) {
      EXPECT_EQ(!IntentsOfKey(keys, &snapshot, UiState{}, false).empty(), obeys) << keys;
    }
  }
}

TEST(Keys, HoldHereIsSentWhereItsButtonStandsAlone) {
  for (const MissionState state :
       {MissionState::kSearch, MissionState::kArmed, MissionState::kApproved,
        MissionState::kDescending, MissionState::kAborting, MissionState::kLanded}) {
    EngineSnapshot snapshot = fake::Snapshot(state, SourceKind::kSimulation);
    snapshot.session.Edit().can_transmit = true;
    const Intents hold = IntentsOfKey("Shift+H", &snapshot, UiState{}, false);
    EXPECT_EQ(!hold.empty(), IsFlying(state)) << MissionStateName(state);
    if (!hold.empty()) {
      EXPECT_TRUE(std::holds_alternative<HoldHere>(std::get<CommandAction>(hold[0])));
    }
    snapshot.session.Edit().can_transmit = false;
    EXPECT_TRUE(IntentsOfKey("Shift+H", &snapshot, UiState{}, false).empty());
  }
  EngineSnapshot elsewhere = fake::Snapshot(MissionState::kSearch, SourceKind::kSimulation);
  elsewhere.session.Edit().can_transmit = true;
  elsewhere.flight.Edit().mission.going = Going{};
  EXPECT_FALSE(IntentsOfKey("Shift+H", &elsewhere, UiState{}, false).empty());
}

TEST(Keys, AcknowledgesTheFirstAlarmThatWaitsAndIsNotShelved) {
  EngineSnapshot snapshot = fake::Snapshot(MissionState::kSearch, SourceKind::kSimulation);
  auto& alarms = snapshot.flight.Edit().mission.alarms;
  Alarm done{.kind = AlarmId::kPose, .level = AlarmLevel::kCaution};
  done.id = "pose";
  done.acknowledged = true;
  Alarm shelved{.kind = AlarmId::kWind, .level = AlarmLevel::kCaution};
  shelved.id = "wind";
  Alarm waits{.kind = AlarmId::kCameraBlank, .level = AlarmLevel::kWarning};
  waits.id = "camera_blank";
  alarms = {done, shelved, waits};
  UiState state;
  state.frame.shelved.push_back({shelved.kind, shelved.level, shelved.since});
  const Intents answer = IntentsOfKey("A", &snapshot, state, false);
  ASSERT_EQ(answer.size(), 1U);
  EXPECT_EQ(std::get<AcknowledgeAlarm>(std::get<CommandAction>(answer[0])).alarm, "camera_blank");
  snapshot.session.Edit().role = SessionRole::kReplayed;
  EXPECT_TRUE(IntentsOfKey("A", &snapshot, state, false).empty()) << "past answering";
}

TEST(Keys, CtrlNEndsAReviewAndNothingElse) {
  EngineSnapshot snapshot;
  snapshot.session.Edit().role = SessionRole::kReplayedAfterJump;
  const Intents ends = IntentsOfKey("Ctrl+N", &snapshot, UiState{}, false);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(std::get<NextFlight>(std::get<UiAction>(ends[0])).kind, NextFlight::Kind::kFlyAgain);
  for (const SessionRole role :
       {SessionRole::kLive, SessionRole::kSimulated, SessionRole::kPictures, SessionRole::kNone}) {
    snapshot.session.Edit().role = role;
    EXPECT_TRUE(IntentsOfKey("Ctrl+N", &snapshot, UiState{}, false).empty());
  }
}

}  // namespace
}  // namespace palace
