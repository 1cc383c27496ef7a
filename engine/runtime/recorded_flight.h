// RecordedFlight: what a recorded flight was doing, for pictures reached by a jump in its log.
#pragma once

#include <memory>
#include <optional>

#include "engine/model/flight_record.h"
#include "engine/model/snapshot.h"

namespace palace {

/// After a jump the mission cannot be re-lived, because what led to it was not seen. State, armed
/// site and the plots then come from the record.
class RecordedFlight {
 public:
  void Follow(std::shared_ptr<const FlightRecord> record) { record_ = std::move(record); }
  /// The newest sample not after `time`; null without a record.
  const FlightRecordSample* At(Timestamp time) const;
  /// Limits in force at `time`; null where the record tells none.
  const Settings* SettingsAt(Timestamp time) const;
  const LandingSite* ArmedSite(const FlightRecordSample& sample) const;
  /// Plots of the flight before `time`, as far as the record tells.
  std::vector<HistorySample> HistoryBefore(Timestamp time) const;
  /// Puts the recorded state and site in place of what the mission says.
  void Restore(const FlightRecordSample& sample, MissionStatus& status) const;

 private:
  std::shared_ptr<const FlightRecord> record_;
};

}  // namespace palace
