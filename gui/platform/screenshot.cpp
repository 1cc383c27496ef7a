#include "gui/platform/screenshot.h"

#include <algorithm>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/core/files.h"

namespace palace {
namespace {

Status Save(const cv::Mat& picture, const std::string& path) {
  std::vector<unsigned char> bytes;
  try {
    if (!cv::imencode(".png", picture, bytes)) {
      return UnavailableError(path + ": the picture cannot be encoded as PNG");
    }
  } catch (const cv::Exception& failure) {
    return UnavailableError(path + ": " + failure.what());
  }
  if (!WriteTextFile(path, std::string(bytes.begin(), bytes.end()))) {
    return UnavailableError(path +
                            ": cannot be written; check that the folder exists, may be "
                            "written and has room");
  }
  return Ok();
}

}  // namespace

Status SavePng(const ImageRgba& picture, const std::string& path) {
  cv::Mat bgr(picture.height(), picture.width(), CV_8UC3);
  for (int y = 0; y < picture.height(); ++y) {
    const Rgba8* in = picture.row(y);
    cv::Vec3b* out = bgr.ptr<cv::Vec3b>(y);
    for (int x = 0; x < picture.width(); ++x) {
      out[x] = {in[x].b, in[x].g, in[x].r};
    }
  }
  return Save(bgr, path);
}

Status SavePng(const ImageU8& picture, const std::string& path) {
  cv::Mat grey(picture.height(), picture.width(), CV_8U);
  for (int y = 0; y < picture.height(); ++y) {
    std::copy(picture.row(y), picture.row(y) + picture.width(), grey.ptr<std::uint8_t>(y));
  }
  return Save(grey, path);
}

}  // namespace palace
