#include "engine/slad/pictures/scene_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/slad/terrain/laid_over.h"

namespace palace {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr float kSameSurface_px = 1;  // raw disparities this near the opening are ground
constexpr float kEdge_px = 2.0F;      // a bend of the disparity within two blocks
constexpr float kHidden_px = 1;

/// Extreme of each value and its neighbours up to two blocks away, first along rows, then along
/// columns. `better(a, b)` picks one of two.
template <typename Better>
ImageF Extreme(const ImageF& values, Better better) {
  constexpr int kReach = 2;
  const int cols = values.width(), rows = values.height();
  ImageF along(cols, rows), both(cols, rows);
  std::vector<float> padded(static_cast<std::size_t>(cols + 2 * kReach));
  for (int j = 0; j < rows; ++j) {
    const float* in = values.row(j);
    std::copy_n(in, cols, padded.begin() + kReach);
    std::fill_n(padded.begin(), kReach, in[0]);
    std::fill_n(padded.end() - kReach, kReach, in[cols - 1]);
    const float* p = padded.data();
    float* out = along.row(j);
    for (int i = 0; i < cols; ++i) {
      out[i] = better(better(better(p[i], p[i + 1]), better(p[i + 2], p[i + 3])), p[i + 4]);
    }
  }
  const auto row = [&](int j) { return along.row(std::clamp(j, 0, rows - 1)); };
  for (int j = 0; j < rows; ++j) {
    const float *a = row(j - 2), *b = row(j - 1), *c = row(j), *d = row(j + 1), *e = row(j + 2);
    float* out = both.row(j);
    for (int i = 0; i < cols; ++i) {
      out[i] = better(better(better(a[i], b[i]), better(c[i], d[i])), e[i]);
    }
  }
  return both;
}

void MeasureBlocks(const ImageF& disparity_px, SceneGround& ground) {
  for (int j = 0; j < ground.rows(); ++j) {
    for (int i = 0; i < ground.cols(); ++i) {
      float sum = 0;
      int known = 0;
      // Every second row tells enough.
      for (int y = kBlock_px * j; y < kBlock_px * (j + 1); y += 2) {
        const float* d = disparity_px.row(y) + kBlock_px * i;
        for (int x = 0; x < kBlock_px; ++x) {
          const bool good = std::isfinite(d[x]);
          sum += good ? d[x] : 0.0F;
          known += good ? 1 : 0;
        }
      }
      ground.measured_px.at(i, j) = known > 0 ? sum / static_cast<float>(known) : kNothing;
      ground.known_share.at(i, j) = static_cast<float>(known) / (kBlock_px * kBlock_px / 2);
    }
  }
}

/// Without what is narrower than five blocks: nearer things by the opening, then pits of wrong
/// matches beside them by the closing.
ImageF OpenThenClose(const ImageF& measured_px) {
  const auto smaller = [](float a, float b) { return a < b ? a : b; };
  const auto larger = [](float a, float b) { return a > b ? a : b; };
  ImageF values = measured_px;
  for (float& value : values.pixels()) {
    value = std::isfinite(value) ? value : kInfinity;
  }
  values = Extreme(values, smaller);
  for (float& value : values.pixels()) {
    value = std::isfinite(value) ? value : -kInfinity;
  }
  values = Extreme(Extreme(values, larger), larger);
  for (float& value : values.pixels()) {
    value = std::isfinite(value) ? value : kInfinity;
  }
  return Extreme(values, smaller);
}

/// Mean of the raw values near the opening, which alone is biased low by noise.
void AverageSurface(const ImageF& opened_px, SceneGround& ground) {
  for (int j = 0; j < ground.rows(); ++j) {
    for (int i = 0; i < ground.cols(); ++i) {
      const float base = opened_px.at(i, j);
      float sum = 0;
      int count = 0;
      for (int b = std::max(0, j - 1); b <= std::min(ground.rows() - 1, j + 1); ++b) {
        for (int a = std::max(0, i - 1); a <= std::min(ground.cols() - 1, i + 1); ++a) {
          const float d = ground.measured_px.at(a, b);
          if (std::abs(d - base) < kSameSurface_px) {
            sum += d;
            ++count;
          }
        }
      }
      ground.disparity_px.at(i, j) = count > 0             ? sum / static_cast<float>(count)
                                     : std::isfinite(base) ? base
                                                           : kNothing;
    }
  }
}

/// Unknown blocks take the nearest known one of their row; rows without any that of a near row.
void FillUnknown(ImageF& disparity_px) {
  const int cols = disparity_px.width(), rows = disparity_px.height();
  std::vector<char> has_any(static_cast<std::size_t>(rows), 0);
  for (int j = 0; j < rows; ++j) {
    float* d = disparity_px.row(j);
    int last = -1;
    for (int i = 0; i <= cols; ++i) {
      if (i < cols && !std::isfinite(d[i])) {
        continue;
      }
      const int next = i;
      for (int k = last + 1; k < next; ++k) {
        const bool from_left = last >= 0 && (next == cols || k - last <= next - k);
        d[k] = from_left ? d[last] : next < cols ? d[next] : kNothing;
      }
      last = next;
      has_any[static_cast<std::size_t>(j)] |= next < cols ? 1 : 0;
    }
  }
  for (int pass = 0; pass < 2; ++pass) {
    for (int k = 1; k < rows; ++k) {
      const int j = pass == 0 ? k : rows - 1 - k;
      const int from = pass == 0 ? j - 1 : j + 1;
      if (!has_any[static_cast<std::size_t>(j)] && has_any[static_cast<std::size_t>(from)]) {
        std::copy_n(disparity_px.row(from), cols, disparity_px.row(j));
        has_any[static_cast<std::size_t>(j)] = 1;
      }
    }
  }
}

void MarkUsable(SceneGround& ground) {
  const int cols = ground.cols(), rows = ground.rows();
  const ImageF& d = ground.disparity_px;
  ImageU8 bad(cols, rows, 0);
  for (int j = 0; j < rows; ++j) {
    float nearest_right_px = kInfinity;  // of all blocks further to the right, in the right picture
    for (int i = cols - 1; i >= 0; --i) {
      const float x_right_px = static_cast<float>(kBlock_px * i) - d.at(i, j);
      const bool hidden = x_right_px > nearest_right_px + kHidden_px;
      nearest_right_px = std::min(nearest_right_px, x_right_px);
      const int left = std::max(0, i - 1), right = std::min(cols - 1, i + 1);
      const int up = std::max(0, j - 1), down = std::min(rows - 1, j + 1);
      const float bend_x =
          left < i && i < right ? d.at(left, j) - 2 * d.at(i, j) + d.at(right, j) : 0.0F;
      const float bend_y = up < j && j < down ? d.at(i, up) - 2 * d.at(i, j) + d.at(i, down) : 0.0F;
      bad.at(i, j) =
          hidden || x_right_px < 0 || std::abs(bend_x) > kEdge_px || std::abs(bend_y) > kEdge_px;
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < cols; ++i) {
      unsigned near = 0;
      for (int b = std::max(0, j - 1); b <= std::min(rows - 1, j + 1); ++b) {
        for (int a = std::max(0, i - 1); a <= std::min(cols - 1, i + 1); ++a) {
          near |= bad.at(a, b);
        }
      }
      ground.usable.at(i, j) = near == 0;
    }
  }
}

void WarpRightToLeft(const ImageU8& picture, SceneGround& ground) {
  const int cols = ground.cols(), rows = ground.rows();
  const int width = picture.width();
  std::vector<float> line(static_cast<std::size_t>(cols));
  for (int y = 0; y < picture.height(); ++y) {
    // Blocks stand for their middles, 1.5 px from their first pixel.
    const float v = (static_cast<float>(y) - 1.5F) / kBlock_px;
    const int j = std::clamp(static_cast<int>(std::floor(v)), 0, std::max(0, rows - 2));
    const float t = std::clamp(v - static_cast<float>(j), 0.0F, 1.0F);
    const float* above = ground.disparity_px.row(j);
    const float* below = ground.disparity_px.row(std::min(rows - 1, j + 1));
    for (int i = 0; i < cols; ++i) {
      line[static_cast<std::size_t>(i)] = above[i] + t * (below[i] - above[i]);
    }
    const std::uint8_t* in = picture.row(y);
    std::uint8_t* out = ground.right.row(y);
    const float last = static_cast<float>(width) - 1.001F;
    const auto lay = [&](int x, int i, float s) {
      const float left = line[static_cast<std::size_t>(i)];
      const float right = line[static_cast<std::size_t>(std::min(cols - 1, i + 1))];
      const float from =
          std::clamp(static_cast<float>(x) - (left + s * (right - left)), 0.0F, last);
      const int k = static_cast<int>(from);
      const float f = from - static_cast<float>(k);
      const float grey = static_cast<float>(in[k]) * (1 - f) + static_cast<float>(in[k + 1]) * f;
      out[x] = static_cast<std::uint8_t>(grey + 0.5F);
    };
    // Between the middles of two blocks; the rims repeat the outermost ones.
    const int inside = kBlock_px / 2, beyond = kBlock_px * (cols - 1) + inside;
    for (int x = 0; x < inside; ++x) {
      lay(x, 0, 0);
    }
    for (int i = 0; i + 1 < cols; ++i) {
      for (int k = 0; k < kBlock_px; ++k) {
        lay(kBlock_px * i + inside + k, i, (static_cast<float>(k) + 0.5F) / kBlock_px);
      }
    }
    for (int x = beyond; x < width; ++x) {
      lay(x, cols - 1, 0);
    }
  }
}

}  // namespace

SceneGround FindSceneGround(const SceneView& view) {
  SceneGround ground;
  if (!view.left || !view.right || !view.range || !view.range->pose) {
    return ground;
  }
  const int width = view.left->width(), height = view.left->height();
  const ImageF& disparity_px = view.range->disparity_px;
  if (width < kLeastPicture_px || height < kLeastPicture_px || view.right->width() != width ||
      view.right->height() != height || disparity_px.width() != width ||
      disparity_px.height() != height || !(view.range->baseline_m > 0)) {
    return ground;
  }
  const int cols = width / kBlock_px, rows = height / kBlock_px;
  ground.measured_px = ground.known_share = ground.disparity_px = ImageF(cols, rows);
  ground.usable = ImageU8(cols, rows, 0);
  MeasureBlocks(disparity_px, ground);
  AverageSurface(OpenThenClose(ground.measured_px), ground);
  FillUnknown(ground.disparity_px);
  if (!std::isfinite(ground.disparity_px.at(0, 0))) {
    return {};
  }
  MarkUsable(ground);
  ground.right = ImageU8(width, height);
  WarpRightToLeft(*view.right, ground);
  return ground;
}

Eigen::Vector3d PointAt(const SceneView& view, double x_px, double y_px, double disparity_px) {
  const PinholeCamera& camera = view.range->camera;
  const double depth_m = view.range->FocalTimesBaseline() / disparity_px;
  return view.X_WC() * Eigen::Vector3d(depth_m * (x_px - camera.cx_px) / camera.fx_px,
                                                  depth_m * (y_px - camera.cy_px) / camera.fy_px,
                                                  depth_m);
}

}  // namespace palace
