#include "engine/experiments/position_pictures.h"

#include <algorithm>

#include "engine/core/check.h"

namespace palace {
namespace {

constexpr int kThesisRows = 240;

int FirstRow(int height, int rows) {
  PALACE_CHECK(rows > 0 && rows <= height, rows, height);
  return (height - rows) / 2;
}

template <typename T>
Image<T> MiddleRows(const Image<T>& image, int rows) {
  const int first = FirstRow(image.height(), rows);
  Image<T> middle(image.width(), rows);
  for (int y = 0; y < rows; ++y) {
    std::copy_n(image.row(first + y), image.width(), middle.row(y));
  }
  return middle;
}

}  // namespace

Result<std::vector<int>> PictureHeights(const PinholeCamera& camera) {
  if (camera.height < kThesisRows) {
    return UsageError("the vehicle's pictures are " + PictureSizeText(camera.width, camera.height) +
                      " pixels: the thesis's are the middle 240 rows, so fewer are not enough");
  }
  if (camera.height == kThesisRows) {
    return std::vector<int>{kThesisRows};
  }
  return std::vector<int>{camera.height, kThesisRows};
}

std::string PictureSizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

PinholeCamera MiddleRows(const PinholeCamera& camera, int rows) {
  PinholeCamera middle = camera;
  middle.cy_px -= FirstRow(camera.height, rows);
  middle.height = rows;
  return middle;
}

MeasuredPicture MiddleRows(const MeasuredPicture& picture, int rows) {
  MeasuredPicture middle;
  middle.left = MiddleRows(picture.left, rows);
  middle.camera = middle.range.camera = MiddleRows(picture.camera, rows);
  middle.range.time = picture.range.time;
  middle.range.baseline_m = picture.range.baseline_m;
  middle.range.depth_m = MiddleRows(picture.range.depth_m, rows);
  middle.range.depth_sigma_m = MiddleRows(picture.range.depth_sigma_m, rows);
  return middle;
}

}  // namespace palace
