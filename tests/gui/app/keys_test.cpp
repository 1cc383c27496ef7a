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

TEST(Keys, OnlyTheWaveOffWorksWhileTyping) {
  EngineSnapshot snapshot;
  for (const KeyBinding& binding : KeyTable()) {
    const bool works = !IntentsOfKey(binding.keys, &snapshot, UiState{}, true).empty();
    EXPECT_EQ(works, binding.keys == "Shift+Escape") << binding.keys;
  }
}

TEST(Keys, WaveOffWorksOverAPopup) {
  UiState state;
  state.key_help = true;
  EXPECT_EQ(IntentsOfKey("Shift+Escape", nullptr, state, false).size(), 1u);
  EXPECT_TRUE(IntentsOfKey("F3", nullptr, state, false).empty());
}

TEST(UiStateReduce, UndoRestoresTheValueBeforeTheGesture) {
  UiState state;
  Settings before;
  RememberChange(state, {"slad.max_slope_deg", 9}, before, false);
  RememberChange(state, {"slad.max_slope_deg", 8}, before, true);
  RememberChange(state, {"slad.max_slope_deg", 7}, before, true);
  ASSERT_EQ(state.undo.size(), 1u);
  UiRequest request = Reduce(state, UndoSetting{});
  ASSERT_EQ(request.settings.size(), 1u);
  EXPECT_EQ(request.settings[0].value, 10);
  request = Reduce(state, RedoSetting{});
  ASSERT_EQ(request.settings.size(), 1u);
  EXPECT_EQ(request.settings[0].value, 7);
}

}  // namespace
}  // namespace palace
