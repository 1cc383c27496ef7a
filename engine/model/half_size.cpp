#include "engine/model/half_size.h"

#include "engine/core/check.h"

namespace palace {

ImageU8 HalfSize(const ImageU8& picture) {
  PALACE_CHECK(picture.width() >= 2 && picture.height() >= 2, picture.width(), picture.height());
  ImageU8 half(picture.width() / 2, picture.height() / 2);
  for (int y = 0; y < half.height(); ++y) {
    const std::uint8_t* up = picture.row(2 * y);
    const std::uint8_t* down = picture.row(2 * y + 1);
    std::uint8_t* out = half.row(y);
    for (int x = 0; x < half.width(); ++x) {
      out[x] = static_cast<std::uint8_t>(
          (up[2 * x] + up[2 * x + 1] + down[2 * x] + down[2 * x + 1] + 2) / 4);
    }
  }
  return half;
}

}  // namespace palace
