#include "engine/capture/side_by_side.h"

#include <algorithm>

namespace palace {

std::pair<ImageU8, ImageU8> SplitSideBySide(const ImageU8& both) {
  PALACE_CHECK(both.width() % 2 == 0, both.width());
  const int width = both.width() / 2;
  ImageU8 left(width, both.height());
  ImageU8 right(width, both.height());
  for (int y = 0; y < both.height(); ++y) {
    const std::uint8_t* row = both.row(y);
    std::copy(row, row + width, left.row(y));
    std::copy(row + width, row + 2 * width, right.row(y));
  }
  return {std::move(left), std::move(right)};
}

}  // namespace palace
