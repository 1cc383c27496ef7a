#include "engine/stereo/hidden.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

namespace palace {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Column of the right picture; -1 for unknown pixels and those outside it.
int RightColumn(int x, float disparity, int width) {
  const float place = static_cast<float>(x) - disparity + 0.5F;
  return place >= 0 && place < static_cast<float>(width) ? static_cast<int>(place) : -1;
}

void RefuseInRow(float limit_px, int width, std::vector<float>& nearest, float* disparity,
                 float* sigma) {
  std::fill(nearest.begin(), nearest.end(), 0.0F);
  for (int x = 0; x < width; ++x) {
    const int column = RightColumn(x, disparity[x], width);
    if (column >= 0) {
      float& seen = nearest[static_cast<std::size_t>(column)];
      seen = std::max(seen, disparity[x]);
    }
  }
  for (int x = 0; x < width; ++x) {
    const int column = RightColumn(x, disparity[x], width);
    if (column >= 0 && nearest[static_cast<std::size_t>(column)] - disparity[x] > limit_px) {
      disparity[x] = kUnknown;
      sigma[x] = kUnknown;
    }
  }
}

}  // namespace

void RefuseHidden(double limit_px, ImageF& disparity_px, ImageF& sigma_px) {
  const int width = disparity_px.width();
  cv::parallel_for_(cv::Range(0, disparity_px.height()), [&](const cv::Range& rows) {
    std::vector<float> nearest(static_cast<std::size_t>(width));
    for (int y = rows.start; y < rows.end; ++y) {
      RefuseInRow(static_cast<float>(limit_px), width, nearest, disparity_px.row(y),
                  sigma_px.row(y));
    }
  });
}

}  // namespace palace
