#include "engine/simulation/camera_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace palace {
namespace {

constexpr std::size_t kTable = 65536;

std::vector<float> Normals(RandomStream& random, double sigma) {
  std::vector<float> table(kTable);
  for (float& value : table) {
    value = static_cast<float>(sigma * random.Normal());
  }
  return table;
}

/// 16 fresh bits for pixel i; `bits` holds those of four.
std::size_t Pick(RandomStream& random, std::uint64_t& bits, std::size_t i) {
  bits = i % 4 == 0 ? random.NextBits() : bits >> 16;
  return bits & 0xFFFF;
}

}  // namespace

CameraNoise::CameraNoise(const PixelResponse& response, std::uint64_t seed, const std::string& name)
    : response_(response),
      random_(seed, name),
      shot_random_(seed, name + " shot"),
      table_(Normals(random_, response.read_noise_grey)) {
  if (response_.full_well_electrons > 0) {
    shot_table_ = Normals(shot_random_, 1);
  }
}

ImageU8 CameraNoise::Apply(const ImageF& light) {
  const auto gain = static_cast<float>(response_.gain);
  const auto offset = static_cast<float>(response_.offset_grey);
  const bool shot = !shot_table_.empty();
  const float variance_per_grey =
      shot ? static_cast<float>(255 / response_.full_well_electrons) : 0.0F;
  ImageU8 picture(light.width(), light.height());
  std::uint64_t bits = 0, shot_bits = 0;
  for (std::size_t i = 0; i < light.pixels().size(); ++i) {
    const float signal = gain * light.pixels()[i];
    float value = signal + offset + table_[Pick(random_, bits, i)];
    if (shot) {
      value += std::sqrt(std::max(0.0F, variance_per_grey * signal)) *
               shot_table_[Pick(shot_random_, shot_bits, i)];
    }
    picture.pixels()[i] = static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
  }
  return picture;
}

}  // namespace palace
