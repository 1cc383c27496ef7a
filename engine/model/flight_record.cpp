#include "engine/model/flight_record.h"

#include <algorithm>

namespace palace {

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
