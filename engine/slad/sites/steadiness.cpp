#include "engine/slad/sites/steadiness.h"

#include <bit>

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
  if (!value_) {
    value_ = figure;
    return;
  }
  const bool worse = worse_.Add(figure < *value_ - noise, kWorseAfter_maps);
  const bool better = better_.Add(figure > *value_ + noise, kBetterAfter_maps);
  if (worse || better) {
    value_ = figure;
    worse_ = better_ = {};
  }
}

}  // namespace palace
