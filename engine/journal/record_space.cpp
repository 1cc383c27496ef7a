#include "engine/journal/record_space.h"

#include <cmath>

namespace palace {
namespace {

constexpr double kRateWindow_s = 20;
constexpr double kKnown_s = 1;       // before, the rate of a recording is a guess
constexpr double kLongestGap_s = 5;  // a stretch without messages says nothing of the rate
constexpr double kRelax = 1.5;

struct Step {
  double below_s;
  int every;
};
constexpr Step kSteps[] = {{30, 0}, {60, 4}, {120, 2}};

int EveryFor(double left_s, double factor) {
  for (const Step& step : kSteps) {
    if (left_s < step.below_s * factor) {
      return step.every;
    }
  }
  return 1;
}

/// More pictures: 1 before 2 before 4 before none.
bool Keeps(int every, int more_than) { return every != 0 && (more_than == 0 || every < more_than); }

}  // namespace

void RecordSpace::Add(double seconds, std::uint64_t full_bytes,
                      std::uint64_t bytes_without_pictures) {
  if (!(seconds > 0 && seconds < kLongestGap_s)) {
    return;
  }
  const double keep = seconds_ > kRateWindow_s ? kRateWindow_s / seconds_ : 1;
  seconds_ = keep * seconds_ + seconds;
  full_bytes_ = keep * full_bytes_ + static_cast<double>(full_bytes);
  slim_bytes_ = keep * slim_bytes_ + static_cast<double>(bytes_without_pictures);
}

double RecordSpace::RateWith(int every) const {
  const double pictures = every == 0 ? 0 : (full_bytes_ - slim_bytes_) / every;
  return (slim_bytes_ + pictures) / seconds_;
}

int RecordSpace::Decide(std::uint64_t free_bytes) {
  if (seconds_ < kKnown_s) {
    return every_;
  }
  const double left_s = static_cast<double>(free_bytes) / RateWith(1);
  const int now = EveryFor(left_s, 1), surely = EveryFor(left_s, kRelax);
  if (Keeps(every_, now)) {
    every_ = now;  // less room than this rate may take
  } else if (Keeps(surely, every_)) {
    every_ = surely;
  }
  return every_;
}

double RecordSpace::SecondsIn(std::uint64_t bytes) const {
  return seconds_ < kKnown_s ? NAN : static_cast<double>(bytes) / RateWith(every_);
}

}  // namespace palace
