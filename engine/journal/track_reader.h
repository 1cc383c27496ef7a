// TrackReader: gathers what a flight decided from the station's own messages in its log.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/model/flight_record.h"
#include "engine/wire/channels.h"
#include "engine/wire/wire_message.h"

namespace palace {

/// Messages in log order. Damaged ones are passed over. A selected site is the one of that id in
/// the newest proposal before the selection. A refusal or an approval counts when the station's
/// next word on a decision does not take it back.
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
  void AddEvent(const WireMessage& message);
  void NoteTouchdown(const FlightRecordSample& sample);
  void SetRefused(std::uint64_t site_id, bool refused, Timestamp time);

  const ChannelNames& channels_;
  FlightRecord& record_;
  std::vector<LandingSite> newest_sites_;
  int armed_ = -1;
  /// Given, and not answered yet: RefuseSite, ApproveSite or LookAtSite.
  struct Answerable {
    std::uint64_t site_id = 0;
    bool refused = false;
    double stop_height_m = 0;  ///< of LookAtSite
  };
  std::optional<Answerable> decision_;
  double stop_height_m_ = 0;  // of the approval in force
  bool new_map_ = false;      // since the last status
};

}  // namespace palace
