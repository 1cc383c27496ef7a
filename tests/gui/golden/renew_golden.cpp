// Draws the golden pictures anew, to be looked at and committed where a change is meant:
//   build/release/tests/renew_golden              into tests/golden
//   build/release/tests/renew_golden FOLDER       elsewhere, in full size, to look at
#include <cstdio>
#include <filesystem>
#include <string>

#include <opencv2/imgcodecs.hpp>

#include "gui/platform/screenshot.h"
#include "tests/gui/golden/workspace_pictures.h"

int main(int argc, char** argv) {
  if (argc > 2 || (argc == 2 && argv[1][0] == '-')) {
    std::fprintf(stderr, "renew_golden: usage: renew_golden [FOLDER]\n");
    return 2;
  }
  const std::string folder = argc > 1 ? argv[1] : PALACE_SOURCE_DIR "/tests/golden";
  std::filesystem::create_directories(folder);
  for (const palace::golden::Shot& shot : palace::golden::Shots()) {
    std::string why;
    const palace::ImageRgba picture = palace::golden::Draw(shot, why);
    if (!why.empty()) {
      std::fprintf(stderr, "%s: %s\n", shot.name.c_str(), why.c_str());
      return 1;
    }
    const std::string file = folder + "/" + palace::golden::FileOf(shot);
    const bool written = argc > 1 ? palace::SavePng(picture, file + ".png").ok()
                                  : cv::imwrite(file, palace::golden::HalfSize(picture),
                                                {cv::IMWRITE_JPEG_QUALITY, 85});
    if (!written) {
      std::fprintf(stderr, "%s: cannot be written\n", file.c_str());
      return 1;
    }
  }
  return 0;
}
