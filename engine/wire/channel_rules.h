// What each of our channels may bring: sizes, rates and queues of the integrator's sheet
// (engine/wire/README.md) as limits of the receiver.
#pragma once

#include <string>

#include "engine/wire/channels.h"
#include "engine/wire/receiver/channel_limits.h"

namespace palace {

ChannelLimits LimitsOf(const ChannelNames& names, const std::string& channel);

}  // namespace palace
