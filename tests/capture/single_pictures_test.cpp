// Where single pictures come from, and what is said where they do not.
#include "engine/capture/single_pictures.h"

#include <gmock/gmock.h>

#include <cmath>

#include "engine/capture/picture_file.h"
#include "tests/capture/film.h"

namespace palace {
namespace {

using testing::HasSubstr;

class SinglePicturesTest : public film::FilmTest {
 protected:
  Result<SinglePictures> Open(const std::string& source) const {
    return OpenSinglePictures(source, folder_, 640, 480);
  }
};

TEST_F(SinglePicturesTest, AFolderGivesItsPicturesInOrderOfName) {
  std::filesystem::create_directories(folder_ / "in" / "sub.png");
  for (const auto& [name, grey] : {std::pair("b.PNG", 20), {"a.jpg", 10}, {"c.pgm", 30}}) {
    ASSERT_TRUE(
        WriteGreyPicture(folder_ / "in" / name, ImageU8(8, 8, static_cast<std::uint8_t>(grey))));
  }
  std::ofstream(folder_ / "in" / "notes.txt") << "no picture";
  auto pictures = Open("in");
  ASSERT_TRUE(pictures.ok()) << pictures.error().message;
  EXPECT_FALSE(pictures->live);
  EXPECT_EQ(pictures->device.frame_count, 3u);
  for (const int grey : {10, 20, 30}) {
    const auto picture = pictures->device.read();
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_NEAR(picture->grey.at(4, 4), grey, 1);
    EXPECT_TRUE(std::isnan(picture->time_s));
  }
  EXPECT_EQ(pictures->device.read().error().code, ErrorCode::kEnd);
}

TEST_F(SinglePicturesTest, NumbersInNamesCountAsNumbers) {
  std::filesystem::create_directories(folder_ / "in");
  for (const int number : {1, 2, 9, 10, 11, 100}) {
    ASSERT_TRUE(WriteGreyPicture(folder_ / "in" / ("f" + std::to_string(number) + ".png"),
                                 ImageU8(8, 8, static_cast<std::uint8_t>(number))));
  }
  auto pictures = Open("in");
  ASSERT_TRUE(pictures.ok()) << pictures.error().message;
  for (const int number : {1, 2, 9, 10, 11, 100}) {
    EXPECT_EQ(pictures->device.read()->grey.at(4, 4), number);
  }
}

TEST_F(SinglePicturesTest, AFilmGivesItsPicturesWithTheirTimes) {
  film::Write(folder_ / "film.avi", {.pictures = 3, .rate_hz = 25});
  auto pictures = Open("film.avi");
  ASSERT_TRUE(pictures.ok()) << pictures.error().message;
  EXPECT_FALSE(pictures->live);
  for (const double time_s : {0.0, 0.04, 0.08}) {
    const auto picture = pictures->device.read();
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_NEAR(picture->time_s, time_s, 1e-3);
  }
}

TEST_F(SinglePicturesTest, MistakesAreNamedWithTheRemedy) {
  std::filesystem::create_directories(folder_ / "empty");
  std::filesystem::create_directories(folder_ / "broken");
  std::ofstream(folder_ / "broken" / "a.png") << "no picture";
  std::ofstream(folder_ / "text.avi") << "no film";
  for (const auto& [source, said] :
       {std::pair("none.avi", "none.avi: no such video file; check the name"),
        {"empty", "empty: holds no pictures; give a folder of PNG, JPEG, TIFF or PGM files"},
        {"text.avi", "text.avi: this is text, no video"},
        {"ftp://x/y", "ftp:// is not supported"},
        {"/dev/video99", "/dev/video99: no such camera"}}) {
    const auto pictures = Open(source);
    ASSERT_FALSE(pictures.ok()) << source;
    EXPECT_THAT(pictures.error().message, HasSubstr(said));
  }
  auto broken = Open("broken");
  ASSERT_TRUE(broken.ok());
  EXPECT_THAT(broken->device.read().error().message, HasSubstr("a.png: not a picture"));
}

TEST_F(SinglePicturesTest, ADeviceIsAskedForItsSizeAndIsLive) {
  CameraRequest asked;
  const auto pictures =
      OpenSinglePictures("0", folder_, 320, 240, [&](const CameraRequest& request) {
        asked = request;
        return Result<CameraDevice>(CameraDevice{});
      });
  ASSERT_TRUE(pictures.ok());
  EXPECT_TRUE(pictures->live);
  EXPECT_EQ(asked.address, "/dev/video0");
  EXPECT_EQ(asked.width, 320);
  EXPECT_EQ(asked.height, 240);
}

}  // namespace
}  // namespace palace
