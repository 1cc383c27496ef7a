#include "engine/world/baked_ground.h"

#include <cmath>
#include <vector>

#include "engine/core/check.h"

namespace palace {
namespace {

constexpr int kTexelsPerPixel = 3;
constexpr int kReach = 4;  // texels of the kernel to each side
constexpr int kTaps = 2 * kReach + 1;

/// The pixel's square of three texels, spread by the lens less the bilinear look-up; sum 1.
std::vector<float> SpreadKernel() {
  const double lens_texels = kLensBlur_px * kTexelsPerPixel;
  const double sigma = std::sqrt(lens_texels * lens_texels - 1.0 / 6);
  std::vector<double> exact(kTaps, 0.0);
  double sum = 0;
  for (int k = -kReach; k <= kReach; ++k) {
    for (int inside = -(kTexelsPerPixel / 2); inside <= kTexelsPerPixel / 2; ++inside) {
      const double off = (k - inside) / sigma;
      exact[static_cast<std::size_t>(k + kReach)] += std::exp(-0.5 * off * off);
    }
    sum += exact[static_cast<std::size_t>(k + kReach)];
  }
  std::vector<float> kernel;
  for (const double value : exact) {
    kernel.push_back(static_cast<float>(value / sum));
  }
  return kernel;
}

}  // namespace

BakedGround::BakedGround(GroundTexture texture, std::uint64_t seed, const TextureRectangle& place,
                         double sample_distance_m)
    : sample_distance_m_(sample_distance_m),
      u0_m_(place.u_min_m),
      v0_m_(place.v_min_m),
      per_texel_(kTexelsPerPixel / sample_distance_m) {
  PALACE_CHECK(sample_distance_m > 0 && place.u_max_m >= place.u_min_m &&
               place.v_max_m >= place.v_min_m);
  const int rows = static_cast<int>(std::ceil((place.u_max_m - u0_m_) * per_texel_)) + 2;
  const int cols = static_cast<int>(std::ceil((place.v_max_m - v0_m_) * per_texel_)) + 2;
  const std::vector<float> kernel = SpreadKernel();
  // Rows of samples are spread along v first; sums of kTaps of them give a finished row.
  ImageF along(cols, rows + 2 * kReach);
  std::vector<float> line(static_cast<std::size_t>(cols + 2 * kReach));
  GroundPainter painter(texture, seed);
  for (int r = 0; r < along.height(); ++r) {
    const double u_m = u0_m_ + (r - kReach) / per_texel_;
    for (int c = 0; c < static_cast<int>(line.size()); ++c) {
      line[static_cast<std::size_t>(c)] =
          static_cast<float>(painter.Grey(u_m, v0_m_ + (c - kReach) / per_texel_));
    }
    float* out = along.row(r);
    for (int k = 0; k < kTaps; ++k) {
      const float weight = kernel[static_cast<std::size_t>(k)];
      const float* in = line.data() + k;
      for (int c = 0; c < cols; ++c) {
        out[c] += weight * in[c];
      }
    }
  }
  grey_ = ImageF(cols, rows);
  for (int r = 0; r < rows; ++r) {
    float* out = grey_.row(r);
    for (int k = 0; k < kTaps; ++k) {
      const float weight = kernel[static_cast<std::size_t>(k)];
      const float* in = along.row(r + k);
      for (int c = 0; c < cols; ++c) {
        out[c] += weight * in[c];
      }
    }
  }
}

}  // namespace palace
