// Datagrams of LCM's two UDP formats, written by hand: true ones as any sender makes them, and
// every field free for those that lie.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace palace {

using Bytes = std::vector<std::uint8_t>;

inline void Append32(Bytes& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}
inline void Append16(Bytes& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
  bytes.push_back(static_cast<std::uint8_t>(value));
}

/// `name` with its closing zero, as it lies in a datagram.
inline Bytes NameBytes(const std::string& name) {
  Bytes bytes(name.begin(), name.end());
  bytes.push_back(0);
  return bytes;
}

inline Bytes ShortDatagram(std::uint32_t number, const Bytes& name, const Bytes& payload) {
  Bytes bytes;
  Append32(bytes, 0x4c433032);
  Append32(bytes, number);
  bytes.insert(bytes.end(), name.begin(), name.end());
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}
inline Bytes ShortDatagram(std::uint32_t number, const std::string& channel, const Bytes& payload) {
  return ShortDatagram(number, NameBytes(channel), payload);
}

struct FragmentFields {
  std::uint32_t number = 0;
  std::uint32_t size = 0;  ///< of the whole payload
  std::uint32_t offset = 0;
  std::uint16_t fragment = 0;
  std::uint16_t fragments = 1;
};
/// `name` goes with fragment 0 alone.
inline Bytes FragmentDatagram(const FragmentFields& fields, const std::string& name,
                              const Bytes& part) {
  Bytes bytes;
  Append32(bytes, 0x4c433033);
  Append32(bytes, fields.number);
  Append32(bytes, fields.size);
  Append32(bytes, fields.offset);
  Append16(bytes, fields.fragment);
  Append16(bytes, fields.fragments);
  if (fields.fragment == 0) {
    const Bytes channel = NameBytes(name);
    bytes.insert(bytes.end(), channel.begin(), channel.end());
  }
  bytes.insert(bytes.end(), part.begin(), part.end());
  return bytes;
}

/// A message in parts of at most `part_bytes`, as a true sender cuts it.
inline std::vector<Bytes> FragmentDatagrams(std::uint32_t number, const std::string& channel,
                                            const Bytes& payload, std::size_t part_bytes) {
  const std::size_t count =
      std::max<std::size_t>((payload.size() + part_bytes - 1) / part_bytes, 1);
  std::vector<Bytes> datagrams;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = i * part_bytes, to = std::min(from + part_bytes, payload.size());
    datagrams.push_back(FragmentDatagram({.number = number,
                                          .size = static_cast<std::uint32_t>(payload.size()),
                                          .offset = static_cast<std::uint32_t>(from),
                                          .fragment = static_cast<std::uint16_t>(i),
                                          .fragments = static_cast<std::uint16_t>(count)},
                                         channel,
                                         {payload.begin() + static_cast<std::ptrdiff_t>(from),
                                          payload.begin() + static_cast<std::ptrdiff_t>(to)}));
  }
  return datagrams;
}

}  // namespace palace
