// Big-endian numbers in byte buffers, as LCM logs and their sidecars hold them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace palace {

template <typename T>
void PutBig(std::vector<std::uint8_t>& out, T value) {
  using Unsigned = std::make_unsigned_t<T>;
  const auto bits = static_cast<Unsigned>(value);
  for (std::size_t i = sizeof(T); i-- > 0;) {
    out.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
  }
}

template <typename T>
T GetBig(const std::uint8_t* bytes) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bits = bits << 8 | bytes[i];
  }
  return static_cast<T>(bits);
}

}  // namespace palace
