#include "engine/tracking/picture_part.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"

namespace palace {
PictureWindow CutWindow(const ImageU8& picture, const Eigen::Vector2d& middle, int reach) {
  const int x = static_cast<int>(std::lround(middle.x()));
  const int y = static_cast<int>(std::lround(middle.y()));
  const int left = std::max(x - reach, 0), right = std::min(x + reach + 1, picture.width());
  const int top = std::max(y - reach, 0), bottom = std::min(y + reach + 1, picture.height());
  PictureWindow window;
  if (left >= right || top >= bottom) {
    return window;
  }
  window.corner = {left, top};
  window.picture = ImageU8(right - left, bottom - top);
  for (int row = top; row < bottom; ++row) {
    std::copy(picture.row(row) + left, picture.row(row) + right, window.picture.row(row - top));
  }
  return window;
}

ImageU8 CutSquare(const ImageU8& picture, const Eigen::Vector2d& centre, int side) {
  ImageU8 square(side, side);
  cv::Mat out = GreyView(square);
  cv::getRectSubPix(GreyView(picture), cv::Size(side, side),
                    cv::Point2f(static_cast<float>(centre.x()), static_cast<float>(centre.y())),
                    out);
  return square;
}

ImageU8 WarpedSquare(const ImageU8& source, const Eigen::Matrix3d& source_from_view,
                     const Eigen::Vector2d& centre, int side) {
  cv::Mat map_x(side, side, CV_32F);
  cv::Mat map_y(side, side, CV_32F);
  // MapPixel, written out: a picture asks for some sixteen squares.
  const Eigen::Matrix3d& H = source_from_view;
  for (int row = 0; row < side; ++row) {
    float* mx = map_x.ptr<float>(row);
    float* my = map_y.ptr<float>(row);
    const double y = centre.y() + (row - 0.5 * (side - 1));
    const double by_y[3] = {H(0, 1) * y, H(1, 1) * y, H(2, 1) * y};
    for (int col = 0; col < side; ++col) {
      const double x = centre.x() + (col - 0.5 * (side - 1));
      const double w = (H(2, 0) * x + by_y[2]) + H(2, 2);
      mx[col] = static_cast<float>(((H(0, 0) * x + by_y[0]) + H(0, 2)) / w);
      my[col] = static_cast<float>(((H(1, 0) * x + by_y[1]) + H(1, 2)) / w);
    }
  }
  ImageU8 square(side, side);
  cv::Mat out = GreyView(square);
  cv::remap(GreyView(source), out, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return square;
}

}  // namespace palace
