// How old a channel is to a person: at a time of the data, and while nothing more is published.
#pragma once

#include "engine/model/channel.h"

namespace palace {

/// Fresh up to 2 expected periods, late up to 5, stale beyond 5 periods or 1 s, whichever is
/// larger.
ChannelHealth::State StateAt(double age_s, double expected_hz);
/// 1 / `mean_period_s`; once two periods are missing, one message in the time since the last. 0
/// without a period.
double RateAt(double age_s, double mean_period_s);
/// The channel as it stands `silent_s` after it was published: older, slower, perhaps stale.
ChannelHealth After(ChannelHealth channel, double silent_s);

}  // namespace palace
