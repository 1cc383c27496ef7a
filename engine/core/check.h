// Checks of our own assumptions. A failed check is a bug of the program, never of its input.
#pragma once

#include <sstream>
#include <string>

namespace palace {

/// Prints condition, place and values to stderr and aborts. Always armed, also in release builds.
[[noreturn]] void CheckFailed(const char* condition, const char* file, int line,
                              const std::string& values);

namespace check_internal {
template <typename... Values>
std::string Describe(const Values&... values) {
  std::ostringstream text;
  ((text << ' ' << values), ...);
  return text.str();
}
}  // namespace check_internal

}  // namespace palace

/// Aborts with the given values when `condition` is false: PALACE_CHECK(row < rows, row, rows).
#define PALACE_CHECK(condition, ...)                                          \
  do {                                                                        \
    if (!(condition)) [[unlikely]] {                                          \
      ::palace::CheckFailed(#condition, __FILE__, __LINE__,                   \
                            ::palace::check_internal::Describe(__VA_ARGS__)); \
    }                                                                         \
  } while (false)
