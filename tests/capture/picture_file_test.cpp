// Pictures are written whole or not at all.
#include "engine/capture/picture_file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/own_path.h"

namespace palace {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// No file of this process grows beyond some bytes while it lives, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit full = {bytes, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, before_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*before_)(int);
  rlimit limit_{};
};

class PictureFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  ~PictureFile() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  static ImageU8 Noise(std::uint64_t seed) {
    ImageU8 image(160, 120);
    std::uint64_t state = seed;
    for (std::uint8_t& pixel : image.pixels()) {
      state = state * 6364136223846793005U + 1442695040888963407U;
      pixel = static_cast<std::uint8_t>(state >> 56);
    }
    return image;
  }

  const fs::path folder_ = OwnPath("");
};

TEST_F(PictureFile, ComesBackAsItWasWritten) {
  for (const char* name : {"a.png", "a.pgm", "a.tif"}) {
    ASSERT_TRUE(WriteGreyPicture(folder_ / name, Noise(1))) << name;
    const auto read = ReadGreyPicture(folder_ / name);
    ASSERT_TRUE(read) << name << ": " << read.error().message;
    EXPECT_EQ(read->pixels(), Noise(1).pixels()) << name;
  }
}

TEST_F(PictureFile, OfAFullDiskIsNotLeftCut) {
  ASSERT_TRUE(WriteGreyPicture(folder_ / "earlier.png", Noise(1)));
  for (const char* name : {"new.png", "new.pgm", "earlier.png"}) {
    const FullDisk full(5000);
    const Status written = WriteGreyPicture(folder_ / name, Noise(2));
    ASSERT_FALSE(written) << name;
    EXPECT_THAT(written.error().message, HasSubstr(std::string(name) + ": cannot be written"));
  }
  const auto earlier = ReadGreyPicture(folder_ / "earlier.png");
  ASSERT_TRUE(earlier) << earlier.error().message;
  EXPECT_EQ(earlier->pixels(), Noise(1).pixels());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1)
      << "something is left of what was not written";
}

/// A JPEG with a segment of EXIF after its first two bytes.
std::string JpegWith(const ImageU8& image, const std::string& exif) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(
      ".jpg",
      cv::Mat(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.row(0))),
      bytes);
  const std::size_t length = exif.size() + 2;
  std::string jpeg(bytes.begin(), bytes.end());
  return jpeg.insert(2, std::string("\xFF\xE1", 2) + static_cast<char>(length >> 8) +
                            static_cast<char>(length & 0xFF) + exif);
}

void Write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A ramp: noise has a code for nearly all bits, so that none of them is wrong.
ImageU8 Ramp() {
  ImageU8 image(160, 120);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      image.at(x, y) = static_cast<std::uint8_t>(x + y / 2 + (x / 9 + y / 7) % 3);
    }
  }
  return image;
}

TEST_F(PictureFile, AJpegDamagedInsideIsRefusedWithWhatIsWrong) {
  const std::string whole = JpegWith(Ramp(), "Exif");
  Write(folder_ / "whole.jpg", whole);
  EXPECT_TRUE(ReadGreyPicture(folder_ / "whole.jpg"));
  int told = 0;
  for (int share = 20; share < 90; share += 5) {
    std::string damaged = whole;
    const std::size_t at = damaged.size() * static_cast<std::size_t>(share) / 100;
    damaged.replace(at, 16, std::string(16, '\x7F'));
    Write(folder_ / "damaged.jpg", damaged);
    const auto read = ReadGreyPicture(folder_ / "damaged.jpg");
    if (!read) {
      ++told;
      EXPECT_THAT(read.error().message, HasSubstr("damaged.jpg: the picture is damaged inside ("));
    }
  }
  EXPECT_GE(told, 10) << "of 14; what reads as other codes cannot be told";
  // A camera may fill up before the end with bytes that say nothing.
  std::string filled = whole;
  filled.insert(filled.size() - 2, std::string(20, '\0'));
  Write(folder_ / "filled.jpg", filled);
  EXPECT_TRUE(ReadGreyPicture(folder_ / "filled.jpg"));
}

TEST_F(PictureFile, CutShortIsRefusedThoughASmallPictureInItIsWhole) {
  const std::string jpeg =
      JpegWith(Noise(1), std::string("Exif\0\0\xFF\xD8\xFF\xDB\0\0\xFF\xD9", 14));
  Write(folder_ / "whole.jpg", jpeg);
  EXPECT_TRUE(ReadGreyPicture(folder_ / "whole.jpg"));
  for (const std::size_t length :
       {std::size_t{10}, std::size_t{60}, jpeg.size() / 2, jpeg.size() - 2}) {
    Write(folder_ / "cut.jpg", jpeg.substr(0, length));
    const auto read = ReadGreyPicture(folder_ / "cut.jpg");
    ASSERT_FALSE(read) << length;
    EXPECT_THAT(read.error().message, HasSubstr("the picture is cut short")) << length;
  }
}

// A lens is that of the sensor: what a camera notes of how it was held turns no picture.
TEST_F(PictureFile, IsReadAsItWasStoredWhicheverWayUp) {
  // TIFF header, one entry: orientation (0x0112), a short, 3: turned by 180 degrees.
  const std::string turned(
      "Exif\0\0II\x2A\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x03\0\0\0\0\0\0\0", 32);
  Write(folder_ / "plain.jpg", JpegWith(Noise(1), std::string("Exif\0\0", 6)));
  Write(folder_ / "turned.jpg", JpegWith(Noise(1), turned));
  const auto plain = ReadGreyPicture(folder_ / "plain.jpg"),
             as_stored = ReadGreyPicture(folder_ / "turned.jpg");
  ASSERT_TRUE(plain && as_stored);
  EXPECT_EQ(as_stored->pixels(), plain->pixels());
}

TEST_F(PictureFile, OfSixteenBitsGivesItsUpperEightOrSaysThatTheyAreEmpty) {
  const ImageU8 noise = Noise(1);
  cv::Mat picture(noise.height(), noise.width(), CV_16UC1);
  const auto save = [&](const char* name, int times, int plus) {
    for (int y = 0; y < noise.height(); ++y) {
      for (int x = 0; x < noise.width(); ++x) {
        picture.at<std::uint16_t>(y, x) =
            static_cast<std::uint16_t>(noise.row(y)[x] * times + plus);
      }
    }
    ASSERT_TRUE(cv::imwrite(folder_ / name, picture));
  };
  for (const char* name : {"a.png", "a.pgm", "a.tif"}) {
    save(name, 256, 255);
    const auto whole = ReadGreyPicture(folder_ / name);
    ASSERT_TRUE(whole) << name << ": " << whole.error().message;
    EXPECT_EQ(whole->pixels(), noise.pixels()) << name;
    save(name, 16, 0);  // twelve bits
    const auto dark = ReadGreyPicture(folder_ / name);
    ASSERT_FALSE(dark) << name;
    EXPECT_THAT(dark.error().message, HasSubstr("whose largest value is 4080, nearly black"));
    save(name, 0, 0);  // a lens that is covered is black, and nothing to mend
    EXPECT_TRUE(ReadGreyPicture(folder_ / name)) << name;
  }
}

TEST_F(PictureFile, OfAnUnknownKindIsRefused) {
  EXPECT_FALSE(WriteGreyPicture(folder_ / "picture.what", Noise(1)));
  EXPECT_FALSE(WriteGreyPicture(folder_ / "no folder" / "a.png", Noise(1)));
}

}  // namespace
}  // namespace palace
