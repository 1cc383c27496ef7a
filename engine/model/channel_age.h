// How old a channel is to a person, and how often it comes: at a time of the data, and while
// nothing more is published.
#pragma once

#include "engine/model/channel.h"

namespace palace {

/// Fresh up to 2 expected periods, late up to 5, stale beyond 5 periods or 1 s, whichever is
/// larger.
ChannelHealth::State StateAt(double age_s, double expected_hz);

/// Messages are counted over so long for a rate.
inline constexpr double kRateWindow_s = 2;
/// Of a channel whose newest message is `age_s` old and which came `stamped_hz` times a second in
/// the kRateWindow_s before that message. Once it is stale its silence counts: what came in the
/// kRateWindow_s before now; where nothing did, one message in the time since. Not sooner: a
/// station that is slow to read what came sees every channel a little old.
double RateAt(double age_s, double stamped_hz, double expected_hz);

/// The channel on a screen, `silent_s` after the station looked at it. It is older by that. Whether
/// anything came meanwhile nobody knows: it is fresh or late as it was, at the rate it had, until
/// the screen itself is old (approve_offer.h) and says so; then its rate is not known (NaN).
ChannelHealth After(ChannelHealth channel, double silent_s);

}  // namespace palace
