// Median of a list that may be reordered.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace palace {

/// A normal distribution's standard deviation over the median of its magnitudes (Hampel 1974).
inline constexpr double kSigmaPerMad = 1.4826;

/// The value that one in `one_in` of the values lie below. `values` holds at least one and is
/// reordered; none may be NaN.
template <typename T>
T UpperQuantile(std::vector<T>& values, std::size_t one_in) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / one_in);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The upper of the two middle values where their number is even. `values` holds at least one and
/// is reordered; none may be NaN.
template <typename T>
T UpperMedian(std::vector<T>& values) {
  return UpperQuantile(values, 2);
}

}  // namespace palace
