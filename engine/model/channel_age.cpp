#include "engine/model/channel_age.h"

#include <algorithm>

namespace palace {
namespace {

constexpr double kFreshPeriods = 2;
constexpr double kLatePeriods = 5;
constexpr double kLeastLateAge_s = 0.25;
constexpr double kLeastStaleAge_s = 1;

}  // namespace

ChannelHealth::State StateAt(double age_s, double expected_hz) {
  const double period_s = 1 / expected_hz;
  return age_s > std::max(kLatePeriods * period_s, kLeastStaleAge_s) ? ChannelHealth::State::kStale
         : age_s > std::max(kFreshPeriods * period_s, kLeastLateAge_s)
             ? ChannelHealth::State::kLate
             : ChannelHealth::State::kFresh;
}

double RateAt(double age_s, double mean_period_s) {
  return !(mean_period_s > 0) ? 0
                              : 1 / (age_s > kFreshPeriods * mean_period_s ? age_s : mean_period_s);
}

ChannelHealth After(ChannelHealth channel, double silent_s) {
  if (channel.state != ChannelHealth::State::kNever && silent_s > 0) {
    channel.age_s += silent_s;
    channel.state = std::max(channel.state, StateAt(channel.age_s, channel.expected_hz));
    channel.rate_hz = RateAt(channel.age_s, 1 / channel.rate_hz);
  }
  return channel;
}

}  // namespace palace
