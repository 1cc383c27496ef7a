#include "engine/world/optics.h"

#include <opencv2/imgproc.hpp>

namespace palace {

void Blur(ImageF& grey, double sigma_px) {
  if (sigma_px > 0) {
    cv::Mat pixels(grey.height(), grey.width(), CV_32F, grey.row(0));
    cv::GaussianBlur(pixels.clone(), pixels, {}, sigma_px);
  }
}

void Vignette(ImageF& grey, double share) {
  const double x0 = (grey.width() - 1) / 2.0, y0 = (grey.height() - 1) / 2.0;
  const double corner2 = x0 * x0 + y0 * y0;
  for (int y = 0; share > 0 && y < grey.height(); ++y) {
    for (int x = 0; x < grey.width(); ++x) {
      const double out2 = ((x - x0) * (x - x0) + (y - y0) * (y - y0)) / corner2;
      grey.at(x, y) *= static_cast<float>(1 - share * out2);
    }
  }
}

}  // namespace palace
