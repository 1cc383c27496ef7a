// RateMeter: how many came in the last whole second, or in this one when that is already more.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palace {

class RateMeter {
 public:
  void Add(double now_s) {
    Turn(now_s);
    ++count_;
  }
  double Rate_hz(double now_s) {
    Turn(now_s);
    return static_cast<double>(std::max(count_, last_));
  }

 private:
  void Turn(double now_s) {
    const auto second = static_cast<std::int64_t>(std::floor(now_s));
    if (second != second_) {
      last_ = second == second_ + 1 ? count_ : 0;
      second_ = second;
      count_ = 0;
    }
  }
  std::int64_t second_ = 0;
  std::uint64_t count_ = 0, last_ = 0;
};

}  // namespace palace
