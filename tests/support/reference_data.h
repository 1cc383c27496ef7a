// Reference data lie beside the checkout and are no part of it: tests that need them skip without,
// in the same words, which ./test counts at its end.
#pragma once

#include <filesystem>
#include <string>

namespace palace {

inline std::filesystem::path ReferenceData(const std::string& name) {
  return (std::filesystem::path(PALACE_SHARED_DATA_DIR) / name).lexically_normal();
}
inline bool HasReferenceData(const std::string& set) {
  return std::filesystem::exists(ReferenceData(set));
}
/// For GTEST_SKIP(). config/setup.sh knows these words.
inline std::string NoReferenceData(const std::string& set) {
  return "runs with reference data in " + ReferenceData(set).string();
}

}  // namespace palace
