// Survey files written byte by byte, so that tests can damage them: GeoTIFF and PLY.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace palace {

/// A plain GeoTIFF, one strip, little endian. Rows from the north.
struct TiffFile {
  int cols = 0;
  int rows = 0;
  std::string cells;  ///< rows x cols samples, as BytesOf makes them
  std::uint16_t bits = 32;
  std::uint16_t format = 3;  ///< 1 unsigned, 2 signed, 3 floating
  std::uint16_t bands = 1;
  std::vector<double> scale = {1, 1, 0};               ///< empty: no tag
  std::vector<double> tie = {0, 0, 0, 1000, 2000, 0};  ///< north-west corner
  std::vector<double> matrix{};
  std::string no_data{};
};

template <typename T>
std::string BytesOf(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// `keys` as pairs of GeoKey and value.
inline std::string TiffBytes(const TiffFile& tiff,
                             const std::vector<std::pair<std::uint16_t, std::uint16_t>>& keys) {
  struct Entry {
    std::uint16_t tag, type;
    std::uint32_t count;
    std::string value;
  };
  const auto u16 = [](unsigned v) { return BytesOf<std::uint16_t>({std::uint16_t(v)}); };
  const auto u32 = [](std::size_t v) { return BytesOf<std::uint32_t>({std::uint32_t(v)}); };
  std::vector<std::uint16_t> directory = {1, 1, 0, std::uint16_t(keys.size())};
  for (const auto& [key, value] : keys) {
    directory.insert(directory.end(), {key, 0, 1, value});
  }
  std::vector<Entry> entries = {{256, 4, 1, u32(std::size_t(tiff.cols))},
                                {257, 4, 1, u32(std::size_t(tiff.rows))},
                                {258, 3, 1, u16(tiff.bits)},
                                {259, 3, 1, u16(1)},
                                {262, 3, 1, u16(1)},
                                {273, 4, 1, u32(8)},
                                {277, 3, 1, u16(tiff.bands)},
                                {278, 4, 1, u32(std::size_t(tiff.rows))},
                                {279, 4, 1, u32(tiff.cells.size())},
                                {339, 3, 1, u16(tiff.format)}};
  const auto doubles = [&](std::uint16_t tag, const std::vector<double>& values) {
    if (!values.empty()) {
      entries.push_back({tag, 12, std::uint32_t(values.size()), BytesOf(values)});
    }
  };
  doubles(33550, tiff.scale);
  doubles(33922, tiff.tie);
  doubles(34264, tiff.matrix);
  if (!keys.empty()) {
    entries.push_back({34735, 3, std::uint32_t(directory.size()), BytesOf(directory)});
  }
  if (!tiff.no_data.empty()) {
    entries.push_back({42113, 2, std::uint32_t(tiff.no_data.size() + 1), tiff.no_data + '\0'});
  }
  const std::size_t ifd = 8 + tiff.cells.size() + tiff.cells.size() % 2;
  std::string file = "II*" + std::string(1, '\0') + u32(ifd) + tiff.cells;
  file.resize(ifd, '\0');
  std::size_t later = ifd + 2 + 12 * entries.size() + 4;
  std::string table = u16(unsigned(entries.size())), values;
  for (const Entry& entry : entries) {
    table += u16(entry.tag) + u16(entry.type) + u32(entry.count);
    if (entry.value.size() <= 4) {
      std::string inline_value = entry.value;
      inline_value.resize(4, '\0');
      table += inline_value;
    } else {
      table += u32(later + values.size());
      values += entry.value;
      values.resize(values.size() + values.size() % 2, '\0');
    }
  }
  return file + table + u32(0) + values;
}

/// Header and x y z of a binary PLY in floats.
inline std::string PlyBytes(const std::vector<float>& xyz, const std::string& format,
                            std::size_t count) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\nend_header\n" + BytesOf(xyz);
}

}  // namespace palace
