// Seeded random streams. The same seed gives the same numbers on every compiler and machine,
// which the standard library's distributions do not promise.
#pragma once

#include <cstdint>
#include <string_view>

namespace palace {

/// One independent stream (xoshiro256**, Blackman & Vigna 2018, seeded by splitmix64).
class RandomStream {
 public:
  /// `name` separates streams that share a master seed: a sensor's noise does not depend on
  /// another's.
  explicit RandomStream(std::uint64_t seed, std::string_view name = {});

  std::uint64_t NextBits();
  double Uniform();                         ///< [0, 1)
  double Uniform(double low, double high);  ///< [low, high)
  double Normal();                          ///< mean 0, standard deviation 1 (Box-Muller)
  int Index(int count);                     ///< 0 .. count-1

 private:
  std::uint64_t state_[4];
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace palace
