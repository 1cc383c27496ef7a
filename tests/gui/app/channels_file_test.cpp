// Which file names the channels, and what a bad one says.
#include "gui/app/channels_file.h"

#include <fstream>

#include <gtest/gtest.h>

#include "gui/app/session.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

class ChannelsFile : public testing::Test {
 protected:
  ChannelsFile() {
    folder_ = OwnPath();
    fs::create_directories(folder_);
  }
  ~ChannelsFile() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path Write(const fs::path& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  fs::path folder_;
};

TEST_F(ChannelsFile, OfACheckoutBeforeThatOfAnInstallation) {
  EXPECT_FALSE(FindChannelsFile(folder_ / "bin" / "palace").has_value());
  const fs::path installed = Write("share/palace/channels.toml", "");
  EXPECT_EQ(FindChannelsFile(folder_ / "bin" / "palace"), installed);
  const fs::path checkout = Write("config/channels.toml", "");
  EXPECT_EQ(FindChannelsFile(folder_ / "build" / "release" / "palace"), checkout);
}

TEST_F(ChannelsFile, ABadOneIsRefusedByFileLineAndKeyBeforeAnythingOpens) {
  AppOptions options;
  options.source = SourceChoice::kConnect;
  options.source_path = "memq://";
  options.record = false;
  const struct {
    const char* text;
    const char* says;
  } rows[] = {{"[channels]\nimu = \"IMU 2\"\n", "c.toml:2: channels.imu holds a blank"},
              {"[channels]\n\nspeed = \"X\"\n", "c.toml:3: unknown key 'channels.speed'"},
              {"[channels]\ngps = 7\n", "c.toml:2: channels.gps must be a text"},
              {"[channels\n", "c.toml:1"}};
  for (const auto& row : rows) {
    options.channels_file = Write("c.toml", row.text);
    const Result<Session> session = OpenSession(options, /*threaded=*/false);
    ASSERT_FALSE(session.ok()) << row.text;
    EXPECT_NE(session.error().message.find(row.says), std::string::npos) << session.error().message;
  }
  options.channels_file = folder_ / "missing.toml";
  const Result<Session> session = OpenSession(options, false);
  ASSERT_FALSE(session.ok());
  EXPECT_NE(session.error().message.find("missing.toml"), std::string::npos);
}

TEST_F(ChannelsFile, NamesTheChannelsOfTheSession) {
  AppOptions options;
  options.source = SourceChoice::kConnect;
  options.channels_file = Write("c.toml", "[channels]\nimu = \"HELI_IMU\"\n");
  EXPECT_EQ(ChannelsFor(options)->imu, "HELI_IMU");
  options.channels_file.clear();
  options.source = SourceChoice::kReplay;
  EXPECT_EQ(*ChannelsFor(options), ChannelNames());
}

}  // namespace
}  // namespace palace
