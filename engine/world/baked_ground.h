// Ground grey worked out once for many pictures from about one height.
//
// A picture at ground sample distance g (metres a pixel) sees grey spread over the pixel's square
// and the lens's spot. Here that spread is applied beforehand on a grid of g/3, so that a picture
// needs one bilinear look-up a pixel, whose own mean spread (1/6 of a texel squared) is taken off
// the lens's. Each grid point is one sample of GroundPainter: nine a pixel.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/model/image.h"
#include "engine/world/ground_texture.h"

namespace palace {

/// The lens spreads a point over a Gaussian of this standard deviation; with the pixel's own square
/// the contrast at half a cycle a pixel is 0.35, as good lenses have it.
inline constexpr double kLensBlur_px = 0.35;

/// Texture coordinates, metres.
struct TextureRectangle {
  double u_min_m = 0;
  double u_max_m = 0;
  double v_min_m = 0;
  double v_max_m = 0;
};

class BakedGround {
 public:
  BakedGround(GroundTexture texture, std::uint64_t seed, const TextureRectangle& place,
              double sample_distance_m);

  /// Spread grey at a place; NaN outside the rectangle.
  float Grey(double u_m, double v_m) const {
    const double row = (u_m - u0_m_) * per_texel_;
    const double col = (v_m - v0_m_) * per_texel_;
    if (!(row >= 0 && col >= 0 && row < grey_.height() - 1 && col < grey_.width() - 1)) {
      return std::numeric_limits<float>::quiet_NaN();
    }
    const int r = static_cast<int>(row), c = static_cast<int>(col);
    const float a = static_cast<float>(row - r), b = static_cast<float>(col - c);
    const float* upper = grey_.row(r) + c;
    const float* lower = grey_.row(r + 1) + c;
    const float top = upper[0] + b * (upper[1] - upper[0]);
    const float bottom = lower[0] + b * (lower[1] - lower[0]);
    return top + a * (bottom - top);
  }
  double sample_distance_m() const { return sample_distance_m_; }

 private:
  double sample_distance_m_;
  double u0_m_, v0_m_;  ///< of grey_(0, 0); rows along u
  double per_texel_;    ///< texels a metre
  ImageF grey_;
};

}  // namespace palace
