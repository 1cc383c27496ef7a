#include "engine/slad/sites/steadiness.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

namespace palace {

void SteadyVerdict::Add(bool good) {
  constexpr unsigned kKept = (1U << kMapsKept) - 1;
  bad_ = ((bad_ << 1U) | (good ? 0U : 1U)) & kKept;
  ++maps_;
  if (maps_ == 1) {
    good_ = good;
  } else if (good_) {
    good_ = std::popcount(bad_) < kBadMaps;
  } else {
    good_ = maps_ >= kMapsKept && bad_ == 0;
  }
}

void SteadyFigure::Add(double figure, double noise) {
  constexpr std::size_t kRemembered = kWorseAfter_maps + kBetterAfter_maps - 1;
  newest_.push_back(figure);
  if (newest_.size() > kRemembered) {
    newest_.pop_front();
  }
  std::vector<double> sorted(newest_.begin(), newest_.end());
  const auto reached =
      sorted.begin() + std::min<std::ptrdiff_t>(kWorseAfter_maps, std::ssize(sorted)) - 1;
  std::nth_element(sorted.begin(), reached, sorted.end());
  if (!value_ || std::abs(*reached - *value_) > noise) {
    value_ = *reached;
  }
}

}  // namespace palace
