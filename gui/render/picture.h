// ImageRgba: pictures for the screen, 8 bits a channel, row 0 on top.
#pragma once

#include <cstdint>

#include "engine/model/image.h"

namespace palace {

struct Rgba8 {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  friend bool operator==(const Rgba8&, const Rgba8&) = default;
};
using ImageRgba = Image<Rgba8>;

/// 0xRRGGBB, as the palette writes colours.
constexpr Rgba8 RgbaFromHex(std::uint32_t rgb, std::uint8_t alpha = 255) {
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>((rgb >> 8) & 0xFF),
          static_cast<std::uint8_t>(rgb & 0xFF), alpha};
}

}  // namespace palace
