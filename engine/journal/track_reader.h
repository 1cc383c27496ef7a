// TrackReader: gathers what a flight decided from the station's own messages in its log.
#pragma once

#include <string>
#include <vector>

#include "engine/model/flight_record.h"
#include "engine/wire/channels.h"
#include "engine/wire/wire_message.h"

namespace palace {

/// Messages in log order. Damaged ones are passed over. A selected site is the one of that id in
/// the newest proposal before the selection.
class TrackReader {
 public:
  TrackReader(const ChannelNames& channels, FlightRecord& record)
      : channels_(channels), record_(record) {}
  bool Wants(const std::string& channel) const;
  void Add(const WireMessage& message);

 private:
  void AddProposal(const WireMessage& message);
  void AddDecision(const WireMessage& message);
  void AddStatus(const WireMessage& message);

  const ChannelNames& channels_;
  FlightRecord& record_;
  std::vector<LandingSite> newest_sites_;
  int armed_ = -1;
};

}  // namespace palace
