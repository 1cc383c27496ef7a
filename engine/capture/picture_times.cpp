#include "engine/capture/picture_times.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/check.h"

namespace palace {

PictureTimes::PictureTimes(std::vector<double> taken_s, double rate_hz)
    : taken_s_(std::move(taken_s)), rate_hz_(rate_hz) {
  PALACE_CHECK(rate_hz > 0 && !taken_s_.empty() && taken_s_.front() == 0, rate_hz, taken_s_.size());
}

double PictureTimes::At(std::int64_t index) const {
  const auto last = static_cast<std::int64_t>(taken_s_.size()) - 1;
  return index <= last ? taken_s_[static_cast<std::size_t>(index)]
                       : taken_s_.back() + static_cast<double>(index - last) / rate_hz_;
}

std::int64_t PictureTimes::Nearest(double time_s) const {
  const auto after = std::lower_bound(taken_s_.begin(), taken_s_.end(), time_s);
  const auto index = after - taken_s_.begin();
  if (after == taken_s_.end()) {
    return index - 1 + static_cast<std::int64_t>(std::round((time_s - taken_s_.back()) * rate_hz_));
  }
  return index > 0 && time_s - taken_s_[static_cast<std::size_t>(index) - 1] < *after - time_s
             ? index - 1
             : index;
}

}  // namespace palace
