// A 64-bit content hash (FNV-1a) that names settings, maps and snapshots. Not for security:
// approvals are signed with libsodium.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace palace {

class ContentHash {
 public:
  void AddBytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) {
      value_ = (value_ ^ bytes[i]) * 0x100000001B3ULL;
    }
  }
  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void Add(T value) { AddBytes(&value, sizeof value); }
  void Add(std::string_view text) { AddBytes(text.data(), text.size()); }
  template <typename T>
  requires std::is_arithmetic_v<T>
  void Add(const std::vector<T>& values) { AddBytes(values.data(), values.size() * sizeof(T)); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

/// The first six hexadecimal digits, as shown to people ("4f2a9c").
inline std::string ShortHash(std::uint64_t hash) {
  static const char* digits = "0123456789abcdef";
  std::string text;
  for (int i = 0; i < 6; ++i) {
    text += digits[(hash >> (60 - 4 * i)) & 0xF];
  }
  return text;
}

}  // namespace palace
