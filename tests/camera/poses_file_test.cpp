// POSES.csv: what is read, and what is refused with file, line, column, value and limit.
#include "engine/camera/files/poses_file.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

const std::string kHeader = "file,time,north,east,down,roll,pitch,heading\n";

class PosesFileTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }
  Result<PosesFile> Load(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return LoadPosesFile(path_);
  }
  const std::filesystem::path path_ = OwnPath(".csv");
};

TEST_F(PosesFileTest, ReadsRowsInAnyOrderOfColumnsWithCommentsAndBlanks) {
  const auto file = Load(
      "\xEF\xBB\xBF# a survey\r\n\r\n"
      "heading, pitch,roll,down,east,north,time,file\r\n"
      "90, -2, +1.5, -30.25, -4, 2e1, 1000.5, l 1  # first\r\n"
      "\t\r\n"
      "0,0,0,-30,0,0,1000.500001,l2");
  ASSERT_TRUE(file.ok()) << file.error().message;
  ASSERT_EQ(file->poses.size(), 2u);
  const SurveyedPose* first = file->Find("l 1");
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->time_s, 1000.5);
  EXPECT_EQ(first->X_WB.p, Eigen::Vector3d(20, -4, -30.25));
  EulerAngles attitude;
  attitude.roll_rad = Rad(1.5);
  attitude.pitch_rad = Rad(-2);
  attitude.yaw_rad = Rad(90);
  EXPECT_EQ(first->X_WB.R, RotationFromEuler(attitude));
  EXPECT_EQ(file->Find("l3"), nullptr);
  EXPECT_EQ(file->last_line, 6);
}

TEST_F(PosesFileTest, BadFilesAreRefusedByLineColumnValueAndLimit) {
  const std::string good = "l1,0,0,0,-30,0,0,0\n";
  struct Row {
    const char* name;
    std::string text;
    std::vector<std::string> said;
  };
  const Row rows[] = {
      {"empty", "", {"no header row", "file,time,north"}},
      {"header only", kHeader, {"no pose", "a row for each left picture"}},
      {"no header", good, {":1:", "unknown column 'l1'"}},
      {"unknown column",
       "file,time,north,east,down,roll,pitch,yaw\n" + good,
       {":1:", "unknown column 'yaw'", "heading"}},
      {"column missing",
       "file,time,north,east,down,roll,pitch\n",
       {":1:", "column heading is missing"}},
      {"column twice",
       "file,time,time,north,east,down,roll,pitch,heading\n",
       {":1:", "column time stands twice"}},
      {"too few values", kHeader + "l1,0,0,0,-30,0,0\n", {":2:", "7 values", "8 columns"}},
      {"too many values", kHeader + good + "l2,1,0,0,-30,0,0,0,0\n", {":3:", "9 values"}},
      {"no stem", kHeader + ",0,0,0,-30,0,0,0\n", {":2:", "file is empty"}},
      {"stem twice",
       kHeader + good + "l1,1,0,0,-30,0,0,0\n",
       {":3:", "file = l1 stands in line 2 already"}},
      {"not a number",
       kHeader + "l1,0,here,0,-30,0,0,0\n",
       {":2:", "north = here is no number", "metres, from -1000000 to 1000000"}},
      {"control bytes",
       kHeader + "l1,0,\x1b[2J\xC3\xA9,0,-30,0,0,0\n",
       {":2:", "north = \\x1B[2J\xC3\xA9 is"}},
      {"nothing", kHeader + "l1,0,0,,-30,0,0,0\n", {":2:", "east =  is no number"}},
      {"decimal comma cut", kHeader + "l1,0,0,0,-30,0,0,1.5.2\n", {":2:", "heading = 1.5.2"}},
      {"NaN", kHeader + "l1,0,0,0,-30,nan,0,0\n", {":2:", "roll = nan is outside -360 .. 360"}},
      {"infinite", kHeader + "l1,inf,0,0,-30,0,0,0\n", {":2:", "time = inf is outside", "seconds"}},
      {"beyond a limit",
       kHeader + "l1,0,0,0,-30,0,91,0\n",
       {":2:", "pitch = 91 is outside -90 .. 90", "degrees"}},
      {"time goes back",
       kHeader + good + "# between\nl2,-1,0,0,-30,0,0,0\n",
       {":4:", "time = -1 does not come after the 0 of line 2"}},
      {"time stands still",
       kHeader + good + "l2,0,0,0,-30,0,0,0\n",
       {":3:", "time = 0", "0.000001 seconds apart"}},
  };
  for (const Row& row : rows) {
    const auto file = Load(row.text);
    ASSERT_FALSE(file.ok()) << row.name;
    EXPECT_EQ(file.error().message.rfind(path_.string() + ":", 0), 0u) << file.error().message;
    for (const std::string& part : row.said) {
      EXPECT_NE(file.error().message.find(part), std::string::npos)
          << row.name << ": '" << part << "' is not in: " << file.error().message;
    }
  }
}

TEST_F(PosesFileTest, AMissingFileIsNamed) {
  const auto file = LoadPosesFile("nowhere/poses.csv");
  ASSERT_FALSE(file.ok());
  EXPECT_NE(file.error().message.find("nowhere/poses.csv"), std::string::npos);
}

}  // namespace
}  // namespace palace
