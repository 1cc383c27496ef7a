// A preset has the name and place that were chosen, and nothing is written over unseen.
#include "gui/app/presets.h"

#include <unistd.h>

#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

class Presets : public testing::Test {
 protected:
  Presets() : folder_(OwnPath()) {}
  ~Presets() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path folder_;
};

TEST_F(Presets, AreSavedWhereChosenAndNotOverAnotherUnasked) {
  const fs::path file = folder_ / "new" / "field.toml";
  Settings now;
  EXPECT_FALSE(LookAt(file, now).exists);
  EXPECT_NE(LookAt(file, now).problem.find("no such file"), std::string::npos);
  ASSERT_TRUE(SavePresetFile(file, now, false));
  EXPECT_TRUE(LookAt(file, now).exists);
  EXPECT_EQ(LookAt(file, now).problem, "");
  EXPECT_TRUE(LookAt(file, now).differences.empty());
  Settings moved = now;
  moved.slad.limits.max_slope_deg = 6;
  const Status refused = SavePresetFile(file, moved, false);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("is there already"), std::string::npos);
  EXPECT_TRUE(LookAt(file, now).differences.empty()) << "it was written over";
  ASSERT_TRUE(SavePresetFile(file, moved, true));
  const PresetLook look = LookAt(file, now);
  ASSERT_EQ(look.differences.size(), 1u);
  EXPECT_EQ(look.differences[0].name, "slad.max_slope_deg");
  EXPECT_EQ(look.differences[0].before, now.slad.limits.max_slope_deg);
  EXPECT_EQ(look.differences[0].after, 6);
}

TEST_F(Presets, ABrokenFileSaysWhere) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "a.toml") << "[slad]\nmax_slope_deg = 900\n";
  const PresetLook look = LookAt(folder_ / "a.toml", Settings{});
  EXPECT_NE(look.problem.find("a.toml:2"), std::string::npos) << look.problem;
}

}  // namespace
}  // namespace palace
