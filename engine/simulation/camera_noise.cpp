#include "engine/simulation/camera_noise.h"

#include <algorithm>
#include <cstddef>

namespace palace {

CameraNoise::CameraNoise(double sigma_grey, double gain, std::uint64_t seed, std::string_view name)
    : gain_(static_cast<float>(gain)), random_(seed, name), table_(65536) {
  for (float& value : table_) {
    value = static_cast<float>(sigma_grey * random_.Normal());
  }
}

void CameraNoise::Apply(ImageU8& image) {
  std::uint64_t bits = 0;
  std::vector<std::uint8_t>& pixels = image.pixels();
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    bits = i % 4 == 0 ? random_.NextBits() : bits >> 16;
    const float value = gain_ * static_cast<float>(pixels[i]) + table_[bits & 0xFFFF];
    pixels[i] = static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f);
  }
}

}  // namespace palace
