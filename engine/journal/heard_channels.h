// When each input was heard in a log: which bundles it came with.
#pragma once

#include <array>
#include <vector>

#include "engine/journal/log_index.h"
#include "engine/model/flight_record.h"

namespace palace {

/// Times of the bundles with which each channel came, by ChannelId, in order. What the station
/// made of a bundle counts as of that bundle. `bundles` are consecutive ones of the log.
std::array<std::vector<Timestamp>, kChannelCount> FindHeard(const LogIndex& index,
                                                            const std::vector<BundleMark>& bundles,
                                                            const ChannelNames& channels);

/// Stretches longer than a second in which nothing was heard, seconds after the first bundle.
std::vector<RecordGap> FindGaps(const std::array<std::vector<Timestamp>, kChannelCount>& heard,
                                const std::vector<BundleMark>& bundles);

}  // namespace palace
