// The order of pictures by their names: numbers in them count as numbers, so that 9 stands before
// 10 however they are padded.
#pragma once

#include <cstring>
#include <filesystem>

namespace palace {

inline bool IsEarlierName(const std::filesystem::path& a, const std::filesystem::path& b) {
  return strverscmp(a.c_str(), b.c_str()) < 0;
}

}  // namespace palace
