// Video files that a test writes, and the rig that names them.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "tests/support/own_path.h"

namespace palace::film {

inline constexpr int kWidth = 64;
inline constexpr int kHeight = 48;

/// One grey a picture; a right half of its own grey where `right` is given.
struct Film {
  int pictures = 10;
  double rate_hz = 25;
  int first_grey = 20;
  int width = kWidth;
  int height = kHeight;
  int right_half_grey = -1;  ///< side by side: the width is that of both
  int step_grey = 10;
};

/// Motion JPEG in AVI. By FFmpeg, as the sources read: OpenCV's own writer of it spoils the last
/// block of some sizes.
inline void Write(const std::filesystem::path& path, const Film& film = {}) {
  cv::VideoWriter writer(path.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                         film.rate_hz, cv::Size(film.width, film.height));
  ASSERT_TRUE(writer.isOpened()) << path;
  for (int k = 0; k < film.pictures; ++k) {
    cv::Mat picture(film.height, film.width, CV_8UC3,
                    cv::Scalar::all(film.first_grey + film.step_grey * k));
    if (film.right_half_grey >= 0) {
      picture.colRange(film.width / 2, film.width)
          .setTo(cv::Scalar::all(film.right_half_grey + film.step_grey * k));
    }
    writer.write(picture);
  }
}

inline std::string RigText(const std::string& capture, bool pose = true) {
  std::string text;
  for (const char* side : {"left", "right"}) {
    text += "[" + std::string(side) +
            "]\nwidth = 64\nheight = 48\nfx_px = 80\nfy_px = 80\ncx_px = 31.5\ncy_px = 23.5\n";
  }
  text += "[rig]\nbaseline_m = 1\n[mount]\ntilt_deg = -90\n";
  if (pose) {
    text += "[pose]\nroll_deg = 0\npitch_deg = 0\nheading_deg = 0\nheight_m = 12\n";
  }
  return text + "[capture]\n" + capture;
}

/// A folder of its own for each test, with a rig.toml in it.
class FilmTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = OwnPath();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path WriteRig(const std::string& capture, bool pose = true) const {
    const std::filesystem::path path = folder_ / "rig.toml";
    std::ofstream(path) << RigText(capture, pose);
    return path;
  }

  std::filesystem::path folder_;
};

}  // namespace palace::film
