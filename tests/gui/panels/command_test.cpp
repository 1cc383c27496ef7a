// Who commands a live vehicle: said on the screen, asked for, taken over and given back there.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "gui/panels/session_words.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

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

TEST(Command, ItsWordsStayInTheirPanelsAtEverySize) {
  for (const WindowSize& size : kWindowSizes) {
    for (const Standing standing : {Standing::kNoKey, Standing::kNoGrant, Standing::kAsking,
                                    Standing::kHeld, Standing::kOther, Standing::kReleased}) {
      SCOPED_TRACE(std::string(size.name) + " " + std::to_string(static_cast<int>(standing)));
      EngineSnapshot snap = Live(standing);
      if (standing == Standing::kNoKey) {
        snap.session.Edit().authority.why_not =
            "No key for this vehicle: run palacectl trust make and give its public half to the "
            "vehicle, then start the station anew";
        snap.flight.Edit().mission.may_select = false;
        snap.flight.Edit().mission.cannot_approve_reason = snap.session->authority.why_not;
      }
      FlyWindow window(size.width, size.height, snap);
      ExpectTextsInPanels(window.ui.items);
      // Nothing is drawn over a button but its own words.
      for (const char* button :
           {"approve", "refuse", "release_command", "ask_for_command", "take_over", "wave_off"}) {
        const Item* item = window.ui.items.Find(button);
        for (const Item& text : window.ui.items.items()) {
          if (item != nullptr && text.name == "text" && Touch(text.rect, item->rect)) {
            EXPECT_TRUE(Inside(text.rect, item->rect, 0.5f))
                << "'" << text.text << "' leaves " << button;
          }
        }
      }
    }
  }
}

TEST(Command, WhyThereIsNoneIsToldInFull) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    EngineSnapshot snap = Live(Standing::kNoKey);
    snap.flight.Edit().mission.may_select = false;
    snap.session.Edit().authority.why_not =
        "No key for this vehicle: run palacectl trust make, and give the vehicle the file";
    FlyWindow window(size.x, size.y, snap);
    std::string all;
    for (const Item& item : window.ui.items.items()) {
      all += item.name == "text" ? item.text + " " : "";
    }
    EXPECT_NE(all.find("and give the vehicle the file."), std::string::npos) << all;
  }
}

TEST(Approve, ALongReasonStaysAboveTheButtons) {
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    EngineSnapshot snap = Live(Standing::kHeld);
    snap.flight.Edit().mission.selection_ended =
        "Selection of site A ended: Left camera stale for 5.2 s, limit 5.0 s, the picture is "
        "frozen "
        "and nothing that rests on it stands any more. Select the site again.";
    FlyWindow window(size.width, size.height, snap);
    ExpectTextsInPanels(window.ui.items);
    const Item* approve = window.ui.items.Find("approve");
    for (const Item& text : window.ui.items.items()) {
      if (text.name == "text" && Touch(text.rect, approve->rect)) {
        EXPECT_TRUE(Inside(text.rect, approve->rect, 0.5f)) << text.text;
      }
    }
  }
}

TEST(Approve, AsksForAClickOnlyWhereAClickSelects) {
  const struct {
    MissionState state;
    const char* why;
    const char* words;
  } table[] = {{MissionState::kProposed, "", "Click a letter"},
               {MissionState::kSearch, "", "Selectable once one site has led"},
               {MissionState::kNoLive, "Cameras stale for 5.2 s", "Cameras stale for 5.2 s."}};
  for (const auto& row : table) {
    EngineSnapshot snap = fake::Snapshot(row.state);
    snap.flight.Edit().mission.why = row.why;
    FlyWindow window(1920, 1080, snap);
    bool told = false, asked = false;
    for (const Item& item : window.ui.items.items()) {
      told = told || (item.name == "text" && item.text.rfind(row.words, 0) == 0);
      asked = asked || (item.name == "text" && item.text.rfind("Click a letter", 0) == 0);
    }
    EXPECT_TRUE(told) << row.words;
    EXPECT_EQ(asked, row.state == MissionState::kProposed);
  }
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
