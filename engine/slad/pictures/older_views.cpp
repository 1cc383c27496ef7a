#include "engine/slad/pictures/older_views.h"

#include <algorithm>
#include <vector>

namespace palace {
namespace {

constexpr std::size_t kKept = 4;
constexpr double kApart_m = 0.1;

}  // namespace

ImageF SmoothedPicture(const ImageU8& picture) {
  const int w = picture.width(), h = picture.height();
  ImageF smooth(w, h);
  std::vector<int> column(static_cast<std::size_t>(w + 4));
  for (int y = 0; y < h; ++y) {
    const auto row = [&](int k) { return picture.row(std::clamp(y + k, 0, h - 1)); };
    const std::uint8_t *a = row(-2), *b = row(-1), *c = row(0), *d = row(1), *e = row(2);
    for (int x = 0; x < w; ++x) {
      column[static_cast<std::size_t>(x + 2)] = a[x] + e[x] + 4 * (b[x] + d[x]) + 6 * c[x];
    }
    column[0] = column[1] = column[2];
    column[static_cast<std::size_t>(w + 2)] = column[static_cast<std::size_t>(w + 3)] =
        column[static_cast<std::size_t>(w + 1)];
    const int* p = column.data();
    float* out = smooth.row(y);
    for (int x = 0; x < w; ++x) {
      out[x] =
          static_cast<float>(p[x] + p[x + 4] + 4 * (p[x + 1] + p[x + 3]) + 6 * p[x + 2]) / 256.0F;
    }
  }
  return smooth;
}

void OlderViews::Remember(const SceneView& view) {
  const ViewPose& pose = *view.range->pose;
  if (!views_.empty() && views_.back().camera != view.range->camera) {
    views_.clear();
  }
  if (!views_.empty() && (views_.back().pose.X_WC.p - pose.X_WC.p).norm() < kApart_m) {
    return;
  }
  views_.push_back({view.range->camera, pose, SmoothedPicture(*view.left)});
  if (views_.size() > kKept) {
    views_.pop_front();
  }
}

}  // namespace palace
