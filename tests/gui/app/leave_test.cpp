// Who closes the window over a flying vehicle is asked, told what the vehicle does, and can wave
// off.
#include <gtest/gtest.h>

#include "engine/mission/leaving.h"
#include "gui/app/dispatch.h"
#include "gui/app/keys.h"
#include "gui/app/leave_dialog.h"
#include "tests/support/fake_snapshot.h"
#include "tests/support/ui_harness.h"

namespace palace {
namespace {

EngineSnapshot Flying(MissionState state, bool on_ground = false) {
  EngineSnapshot snapshot = fake::Snapshot(state);
  snapshot.sensors.Edit().vehicle->on_ground = on_ground;
  snapshot.sensors.Edit().vehicle->flies_on_vision = state == MissionState::kDescending;
  return snapshot;
}

TEST(Leaving, TheWordsFollowWhatTheVehicleWillDo) {
  struct Case {
    MissionState state;
    const char* says;
  };
  for (const Case& c : {Case{MissionState::kSearch, "hovers where it is"},
                        Case{MissionState::kArmed, "hovers where it is"},
                        Case{MissionState::kApproved, "holds by itself"},
                        Case{MissionState::kDescending, "climbs away by itself after 2.0 s"},
                        Case{MissionState::kAborting, "is waving off"}}) {
    SCOPED_TRACE(MissionStateName(c.state));
    const std::string words = WhatTheVehicleDoesAlone(Flying(c.state));
    EXPECT_NE(words.find(c.says), std::string::npos) << words;
    EXPECT_EQ(WhatTheVehicleDoesAlone(Flying(c.state, /*on_ground=*/true)), "");
  }
  EngineSnapshot climbing = Flying(MissionState::kAborting);
  climbing.flight.Edit().mission.wave_off.phase = WaveOffReport::Phase::kClimbs;
  EXPECT_NE(WhatTheVehicleDoesAlone(climbing).find("is climbing away"), std::string::npos);
  EXPECT_EQ(WhatTheVehicleDoesAlone(fake::Snapshot(MissionState::kDescending, SourceKind::kReplay)),
            "");
}

TEST(Leaving, OnlyWhoCommandsIsAsked) {
  for (const auto& [standing, asked] :
       {std::pair(AuthorityStanding::kNone, true), std::pair(AuthorityStanding::kHeld, true),
        std::pair(AuthorityStanding::kOther, false), std::pair(AuthorityStanding::kNoKey, false),
        std::pair(AuthorityStanding::kReleased, false)}) {
    EngineSnapshot snapshot = Flying(MissionState::kDescending);
    snapshot.session.Edit().authority.standing = standing;
    EXPECT_EQ(!WhatTheVehicleDoesAlone(snapshot).empty(), asked) << static_cast<int>(standing);
  }
}

TEST(Leaving, AnOldWordIsToldWithItsAge) {
  EngineSnapshot snapshot = Flying(MissionState::kSearch);
  EXPECT_EQ(WhatTheVehicleDoesAlone(snapshot).rfind("The vehicle is in the air.", 0), 0U);
  const std::string later = WhatTheVehicleDoesAlone(snapshot, /*silent_s=*/36.6);
  EXPECT_EQ(later.rfind("The vehicle was heard last 37.0 s ago.", 0), 0U) << later;
}

TEST(Leaving, EachButtonDoesItsOwn) {
  struct Case {
    const char* button;
    LeaveAnswer answer;
    int wave_offs;
  };
  for (const Case& c :
       {Case{"leave/wave_off", LeaveAnswer::kStay, 1}, Case{"leave/stay", LeaveAnswer::kStay, 0},
        Case{"leave/leave", LeaveAnswer::kLeave, 0}}) {
    SCOPED_TRACE(c.button);
    UiHarness ui(1280, 720);
    LeaveAnswer answer = LeaveAnswer::kNone;
    const auto draw = [&](UiFrame& frame) {
      const LeaveAnswer now = DrawLeaveDialog(
          {0, 80, 1280, 600}, WhatTheVehicleDoesAlone(Flying(MissionState::kDescending)), frame);
      answer = now == LeaveAnswer::kNone ? answer : now;
    };
    ui.Frame(draw);
    ui.Click(c.button, draw);
    EXPECT_EQ(answer, c.answer);
    EXPECT_EQ(ui.CountCommands<WaveOff>(), c.wave_offs);
  }
}

TEST(Leaving, WhileItIsOpenOnlyTheWaveOffAndEscapeWorkFromTheKeyboard) {
  const EngineSnapshot snapshot = Flying(MissionState::kDescending);
  UiState state;
  state.leave_asked = true;
  EXPECT_EQ(IntentsOfKey("Shift+Escape", &snapshot, state, false).size(), 1u);
  EXPECT_TRUE(IntentsOfKey("Ctrl+Q", &snapshot, state, false).empty());
  EXPECT_TRUE(IntentsOfKey("F4", &snapshot, state, false).empty());
  Reduce(state, CloseTop{});
  EXPECT_FALSE(state.leave_asked);
}

class SilentSource final : public Source {
 public:
  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token) override {
    return Error{ErrorCode::kEnd, "nothing"};
  }
  bool IsLockstep() const override { return true; }
  SourceStatus Status() const override { return {}; }
  void Control(const PlaybackControl&) override {}
};

TEST(Leaving, OnTheGroundNobodyIsAsked) {
  EngineParts parts;
  parts.source = std::make_shared<SilentSource>();
  Engine engine(std::move(parts), /*threaded=*/false);
  const auto after = [&](const EngineSnapshot* snapshot) {
    UiState state;
    Dispatch({UiAction(QuitProgram{})}, CommandOrigin::kOperator, snapshot, {1, NAN}, engine,
             state);
    return state;
  };
  const EngineSnapshot flying = Flying(MissionState::kSearch);
  const EngineSnapshot landed = Flying(MissionState::kLanded, /*on_ground=*/true);
  EXPECT_TRUE(after(&flying).leave_asked);
  EXPECT_FALSE(after(&flying).quit);
  EXPECT_TRUE(after(&landed).quit);
  EXPECT_TRUE(after(nullptr).quit);
}

}  // namespace
}  // namespace palace
