// Who commands a live vehicle: said on the screen, asked for, taken over and given back there.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "gui/panels/session_words.h"
#include "tests/gui/panels/fly_window.h"

namespace palace {
namespace {

using Standing = AuthorityStanding;

EngineSnapshot Live(Standing standing, bool silent = false) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed, SourceKind::kLive);
  snap.flight.Edit().mission.armed.reset();
  AuthorityStatus& authority = snap.session.Edit().authority;
  authority.standing = standing;
  authority.can_ask = standing == Standing::kOther || standing == Standing::kReleased;
  authority.fingerprint = standing == Standing::kNoKey ? "" : "3F2A-91C0-77B4-E0D2";
  authority.holder = standing == Standing::kOther ? "bravo 0000-0000-0000-0007" : "";
  authority.holder_is_silent = silent;
  authority.why_not = standing == Standing::kHeld ? "" : "Station bravo commands this vehicle";
  return snap;
}

TEST(Command, TheStatusBarNamesWhoCommandsAndTheKey) {
  const struct {
    Standing standing;
    const char* wide;
  } rows[] = {
      {Standing::kHeld, "In control: this station, key 3F2A-91C0-77B4-E0D2"},
      {Standing::kOther, "In control: bravo 0000-0000-0000-0007"},
      {Standing::kNoKey, "View only: no key"},
      {Standing::kAsking, "Asking for command, key 3F2A-91C0-77B4-E0D2"},
      {Standing::kReleased, "Nobody in control, key 3F2A-91C0-77B4-E0D2"},
      {Standing::kNoGrant, "View only: the vehicle grants no command, key 3F2A-91C0-77B4-E0D2"}};
  for (const auto& row : rows) {
    EXPECT_EQ(CommandText(Live(row.standing), false), row.wide);
    EXPECT_EQ(CommandText(Live(row.standing), true).find("key 3"), std::string::npos);
  }
}

TEST(Command, IsAskedForByAClickAndTakenFromAnotherByAHoldOnly) {
  FlyWindow free(1920, 1080, Live(Standing::kReleased));
  free.ui.Click("ask_for_command", free.draw);
  ASSERT_EQ(free.ui.CountCommands<AskForCommand>(), 1);
  EXPECT_FALSE(free.ui.LastCommand<AskForCommand>().take_over);

  FlyWindow silent(1920, 1080, Live(Standing::kOther, /*silent=*/true));
  EXPECT_NE(silent.ui.items.Find("ask_for_command"), nullptr);

  FlyWindow other(1920, 1080, Live(Standing::kOther));
  ASSERT_NE(other.ui.items.Find("take_over"), nullptr);
  other.ui.Click("take_over", other.draw);
  EXPECT_EQ(other.ui.CountCommands<AskForCommand>(), 0);
  other.ui.MoveTo("take_over");
  other.ui.Button(true);
  other.Run(1.2);
  other.ui.Button(false);
  other.Run(0.1);
  ASSERT_EQ(other.ui.CountCommands<AskForCommand>(), 1);
  EXPECT_TRUE(other.ui.LastCommand<AskForCommand>().take_over);
}

TEST(Command, IsGivenBackWhileNothingIsArmed) {
  FlyWindow held(1920, 1080, Live(Standing::kHeld));
  held.ui.Click("release_command", held.draw);
  EXPECT_EQ(held.ui.CountCommands<ReleaseCommand>(), 1);
  EngineSnapshot simulated = fake::Snapshot(MissionState::kProposed);
  EXPECT_EQ(FlyWindow(1920, 1080, simulated).ui.items.Find("release_command"), nullptr);
}

}  // namespace
}  // namespace palace
