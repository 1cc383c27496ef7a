// Median of a list that may be reordered.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace palace {

/// A normal distribution's standard deviation over the median of its magnitudes (Hampel 1974).
inline constexpr double kSigmaPerMad = 1.4826;

/// The upper of the two middle values where their number is even. `values` holds at least one and
/// is reordered; none may be NaN.
template <typename T>
T UpperMedian(std::vector<T>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace palace
