// The cameras of a RIG.toml, among them the one that the README shows.
#include "engine/capture/rig_cameras.h"

#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "tests/capture/film.h"

namespace palace {
namespace {

using RigCamerasTest = film::FilmTest;

TEST_F(RigCamerasTest, TheRigOfTheReadmeIsReadWhole) {
  std::ifstream readme(std::filesystem::path(PALACE_SOURCE_DIR) / "README.md");
  const std::string text((std::istreambuf_iterator<char>(readme)),
                         std::istreambuf_iterator<char>());
  const std::size_t capture = text.find("\n[capture]");
  ASSERT_NE(capture, std::string::npos);
  const std::string fence = "```toml\n";
  const std::size_t begin = text.rfind(fence, capture) + fence.size();
  std::ofstream(folder_ / "webcams.toml") << text.substr(begin, text.find("```", begin) - begin);
  const auto cameras = LoadRigCameras(folder_ / "webcams.toml");
  ASSERT_TRUE(cameras.ok()) << cameras.error().message;
  ASSERT_EQ(cameras->requests.size(), 2u);
  EXPECT_FALSE(cameras->recorded());
  EXPECT_EQ(cameras->requests[0].address, "/dev/video0");
  EXPECT_EQ(cameras->requests[1].address, "/dev/video2");
  EXPECT_EQ(cameras->requests[1].width, 640);
  EXPECT_EQ(cameras->requests[1].rate_hz, 30);
  EXPECT_EQ(cameras->requests[1].fourcc, "MJPG");
  EXPECT_TRUE(cameras->file.pose.has_value());
}

TEST_F(RigCamerasTest, TheToleranceIsHalfAPeriodUnlessSet) {
  const auto usual = LoadRigCameras(WriteRig("left = 0\nright = 1\n"));
  ASSERT_TRUE(usual.ok());
  EXPECT_DOUBLE_EQ(usual->ToleranceAt(25), 0.02);
  const auto set = LoadRigCameras(WriteRig("left = 0\nright = 1\npair_tolerance_ms = 4\n"));
  ASSERT_TRUE(set.ok());
  EXPECT_DOUBLE_EQ(set->ToleranceAt(25), 0.004);
}

TEST_F(RigCamerasTest, CamerasOfDifferentSizeAreRefused) {
  std::string text = film::RigText("left = 0\nright = 1\n");
  text.replace(text.find("height = 48"), 11, "height = 50");
  text.replace(text.find("[mount]"), 7, "rectified = false\n[mount]");
  std::ofstream(folder_ / "rig.toml") << text;
  const auto cameras = LoadRigCameras(folder_ / "rig.toml");
  ASSERT_FALSE(cameras.ok());
  EXPECT_NE(cameras.error().message.find("[left] is 64 x 50 px, [right] is 64 x 48 px"),
            std::string::npos)
      << cameras.error().message;
}

}  // namespace
}  // namespace palace
