// One table binds, documents and tests every key.
#include "gui/app/keys.h"

#include <set>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace palace
