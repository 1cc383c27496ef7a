#include "engine/model/flight_record.h"

#include <algorithm>

namespace palace {
namespace {

/// The last of `all`, in order of `time_of`, that is not after `time`; null without one.
template <typename T>
const T* NewestAt(const std::vector<T>& all, Timestamp T::*time_of, Timestamp time) {
  const auto after =
      std::upper_bound(all.begin(), all.end(), time,
                       [&](Timestamp t, const T& entry) { return t < entry.*time_of; });
  return after == all.begin() ? nullptr : &*(after - 1);
}

}  // namespace

const RecordedPlace* RecordedProposal::Place(const std::string& letter) const {
  const auto found = std::find_if(places.begin(), places.end(), [&](const RecordedPlace& place) {
    return place.letter == letter;
  });
  return found != places.end() ? &*found : nullptr;
}

const FlightRecordSample* FlightRecord::SampleAt(Timestamp time) const {
  return NewestAt(samples, &FlightRecordSample::time, time);
}

const RecordedProposal* FlightRecord::ProposalAt(Timestamp time) const {
  return NewestAt(proposals, &RecordedProposal::map_time, time);
}

}  // namespace palace
