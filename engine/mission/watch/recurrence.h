// Recurrence: a condition that may come and go from sample to sample, as of a camera that repeats
// every third picture. On when three of the last ten samples say so, in a row or not; off when at
// most one of the last twenty does.
#pragma once

#include <bit>
#include <cstdint>

namespace palace {

class Recurrence {
 public:
  static constexpr int kComes = 3, kOf = 10;
  static constexpr int kGoes = 1, kOfLast = 20;

  void Add(bool present) {
    samples_ = samples_ << 1 | (present ? 1U : 0U);
    on_ = Of(kOf) >= kComes || (on_ && Of(kOfLast) > kGoes);
  }
  bool on() const { return on_; }

 private:
  int Of(int last) const { return std::popcount(samples_ & ((1U << last) - 1)); }

  std::uint32_t samples_ = 0;  // newest in the lowest bit
  bool on_ = false;
};

}  // namespace palace
