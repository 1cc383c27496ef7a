#include "engine/model/channel_age.h"

#include <algorithm>

#include "engine/model/mission/approve_offer.h"

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

double RateAt(double age_s, double stamped_hz, double expected_hz) {
  if (StateAt(age_s, expected_hz) != ChannelHealth::State::kStale) {
    return stamped_hz;
  }
  const double came = std::max(1.0, stamped_hz * (kRateWindow_s - age_s));
  return std::min(stamped_hz, came / std::max(kRateWindow_s, age_s));
}

ChannelHealth After(ChannelHealth channel, double silent_s) {
  if (channel.state != ChannelHealth::State::kNever && silent_s > 0) {
    channel.age_s += silent_s;
    if (silent_s > kScreenOld_s) {
      channel.rate_hz = NAN;
      channel.state = std::max(channel.state, StateAt(channel.age_s, channel.expected_hz));
    }
  }
  return channel;
}

}  // namespace palace
