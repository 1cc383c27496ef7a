// Settings files: what is written is read back, and every bad value is refused by name.
#include "engine/runtime/settings_io.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"

namespace palace {
namespace {

TEST(SettingsIo, FileReadsBackToEqualSettings) {
  Settings settings;
  settings.slad.limits.max_slope_deg = 7.25;
  settings.slad.mode = SladMode::kThesis;
  settings.stereo.num_disparities = 96;
  settings.mission.descent_rate_mps = 0.6;
  const auto read = ParseSettings(SettingsToToml(settings), "x.toml", Settings{});
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, settings);
  EXPECT_EQ(HashOf(*read), HashOf(settings));
}

struct BadFile {
  const char* name;
  const char* text;
  std::vector<const char*> message_holds;
};

class BadSettings : public testing::TestWithParam<BadFile> {};

TEST_P(BadSettings, AreRefusedNamingFileLineKeyAndLimit) {
  const auto read = ParseSettings(GetParam().text, "limits.toml", Settings{});
  ASSERT_FALSE(read);
  for (const char* part : GetParam().message_holds) {
    EXPECT_NE(read.error().message.find(part), std::string::npos) << read.error().message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadSettings,
    testing::Values(
        BadFile{"out_of_range",
                "[slad]\n\nmax_slope_deg = 90\n",
                {"limits.toml:3:", "slad.max_slope_deg", "90", "0.5 to 45"}},
        BadFile{"unknown_key", "[slad]\nmax_slop = 9\n", {"limits.toml:2:", "slad.max_slop"}},
        BadFile{"unknown_section", "[land]\nx = 1\n", {"limits.toml:2:", "land.x"}},
        BadFile{"outside_a_section", "max_slope_deg = 9\n", {"limits.toml:1:", "[slad]"}},
        BadFile{"wrong_type",
                "[slad]\nmax_slope_deg = true\n",
                {"limits.toml:2:", "= true is not a number"}},
        BadFile{"text_for_number",
                "[slad]\nmax_slope_deg = \"9\"\n",
                {"limits.toml:2:", "max_slope_deg"}},
        BadFile{"unknown_word", "[slad]\nmode = \"magic\"\n", {"limits.toml:2:", "thesis, modern"}},
        BadFile{
            "not_a_number", "[slad]\nmax_slope_deg = nan\n", {"limits.toml:2:", "out of range"}},
        BadFile{"fraction", "[slad]\ngrid_rows = 10.5\n", {"limits.toml:2:", "whole number"}},
        BadFile{"even_block", "[stereo]\nblock_size_px = 6\n", {"limits.toml:2:", "odd"}},
        BadFile{"not_toml", "[slad\nx\n", {"limits.toml:1:"}},
        BadFile{"bounds_reversed",
                "[slad]\nbounds = \"given\"\nx_min_m = 5\nx_max_m = -5\n",
                {"limits.toml", "x_min_m = 5", "x_max_m = -5"}},
        BadFile{"up_vector_down",
                "[slad]\nup_vector_ned = [0, 0, 1]\n",
                {"limits.toml:2:", "up_vector_ned"}}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(SettingsIo, UpVectorBecomesTiltAndAzimuth) {
  const auto read = ParseSettings("[slad]\nup_vector_ned = [0, -0.1, -1]\n", "x.toml", Settings{});
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_NEAR((read->slad.lander.up_W() - Eigen::Vector3d(0, -0.1, -1).normalized()).norm(), 0,
              1e-9);
}

TEST(SettingsIo, AssignmentsAsOnTheCommandLine) {
  EXPECT_EQ(ApplySettingText(Settings{}, "slad.max_slope_deg=8")->slad.limits.max_slope_deg, 8);
  EXPECT_EQ(ApplySettingText(Settings{}, "slad.mode=thesis")->slad.mode, SladMode::kThesis);
  for (const char* bad : {"slad.max_slope_deg", "slad.nothing=1", "slad.max_slope_deg=8x",
                          "slad.max_slope_deg=", "slad.max_slope_deg=800"}) {
    const auto result = ApplySettingText(Settings{}, bad);
    ASSERT_FALSE(result) << bad;
    EXPECT_EQ(result.error().code, ErrorCode::kUsage) << bad;
  }
}

TEST(SettingsIo, ACommandLineIsAFileUnderAssignmentsUnderTheRules) {
  const std::filesystem::path file = OwnPath(".toml");
  std::ofstream(file) << "[slad]\nmax_slope_deg = 5\nmax_deviation_m = 0.04\n";
  Settings base;
  base.slad.lander.nav_error_m = 0.7;
  const auto settings =
      SettingsOfCommandLine(base, file, {"slad.max_slope_deg=6", "slad.max_slope_deg=8"});
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->slad.limits.max_slope_deg, 8);
  EXPECT_EQ(settings->slad.limits.max_deviation_m, 0.04);
  EXPECT_EQ(settings->slad.lander.nav_error_m, 0.7);
  EXPECT_EQ(*SettingsOfCommandLine(base, {}, {}), base);
  const struct {
    std::filesystem::path file;
    std::vector<std::string> set;
    const char* said;
  } rows[] = {{"/no/such/file.toml", {"slad.max_slope_deg=8"}, "/no/such/file.toml"},
              {{}, {"slad.max_slope_deg=8", "slad.nothing=1"}, "--set slad.nothing=1: "},
              {{}, {"slad.bounds=given", "slad.x_min_m=5", "slad.x_max_m=-5"}, "--set"}};
  for (const auto& row : rows) {
    const auto refused = SettingsOfCommandLine(base, row.file, row.set);
    ASSERT_FALSE(refused) << row.said;
    EXPECT_NE(refused.error().message.find(row.said), std::string::npos) << refused.error().message;
  }
  std::filesystem::remove(file);
}

TEST(SettingsIo, MissingFileAndUnwritableFolderSayWhatToDo) {
  EXPECT_FALSE(LoadSettingsFile("/no/such/file.toml", Settings{}));
  const Status saved = SaveSettingsFile("/no/such/folder/preset.toml", Settings{});
  ASSERT_FALSE(saved);
  EXPECT_NE(saved.error().message.find("/no/such/folder/preset.toml"), std::string::npos);
}

}  // namespace
}  // namespace palace
