// Image: owned pixels, row-major, no padding. Pixel (0,0) is the centre of the top-left pixel.
// A cv::Mat view exists only inside a stage: a const cv::Mat is not deeply const.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/core/check.h"

namespace palace {

template <typename T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, T fill = T{})
      : width_(width), height_(height), pixels_(Count(width, height), fill) {}
  Image(int width, int height, std::vector<T> pixels)
      : width_(width), height_(height), pixels_(std::move(pixels)) {
    PALACE_CHECK(pixels_.size() == Count(width, height), width, height, pixels_.size());
  }

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return pixels_.empty(); }
  bool Contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  T& at(int x, int y) { return pixels_[Offset(x, y)]; }
  const T& at(int x, int y) const { return pixels_[Offset(x, y)]; }
  T* row(int y) { return pixels_.data() + Offset(0, y); }
  const T* row(int y) const { return pixels_.data() + Offset(0, y); }
  const std::vector<T>& pixels() const { return pixels_; }
  std::vector<T>& pixels() { return pixels_; }

 private:
  static std::size_t Count(int width, int height) {
    PALACE_CHECK(width >= 0 && height >= 0, width, height);
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::size_t Offset(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> pixels_;
};

using ImageU8 = Image<std::uint8_t>;
using ImageF = Image<float>;

}  // namespace palace
