// Pictures are written whole or not at all.
#include "engine/capture/picture_file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

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

TEST_F(PictureFile, OfAnUnknownKindIsRefused) {
  EXPECT_FALSE(WriteGreyPicture(folder_ / "picture.what", Noise(1)));
  EXPECT_FALSE(WriteGreyPicture(folder_ / "no folder" / "a.png", Noise(1)));
}

}  // namespace
}  // namespace palace
