// RecordedMission: what a recorded mission was doing, for pictures reached by a jump in its log.
//
// After a jump the mission cannot be re-lived, because what led to it was not seen. State, armed
// site, limits and the plots then come from the record; what the record does not tell is unknown.
// Beside Mission, and asked instead of it where SeenFromStart(role) is false.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "engine/model/flight_record.h"
#include "engine/model/snapshot.h"

namespace palace {

class RecordedMission {
 public:
  void Follow(std::shared_ptr<const FlightRecord> record) { record_ = std::move(record); }
  const FlightRecord* record() const { return record_.get(); }
  /// A log cut out of a flight: what led to its first state is not in it.
  bool BeginsMidFlight() const;
  /// What happened in the flight until `time`, as it was recorded; null without recorded events.
  std::shared_ptr<const std::vector<Event>> EventsUntil(Timestamp time);
  /// Limits in force at `time`; null where the record tells none.
  const Settings* SettingsAt(Timestamp time) const;
  /// What the newest map proposed that is not newer than `time`; null where the record tells none.
  const RecordedProposal* ProposalAt(Timestamp time) const;
  /// Plots of the flight before `time`, as far as the record tells.
  std::vector<HistorySample> HistoryBefore(Timestamp time) const;
  /// When each channel was heard last before `time`; empty where the record does not tell, or it
  /// never was.
  std::array<std::optional<Timestamp>, kChannelCount> HeardBefore(Timestamp time) const;
  /// The site that was tracked and flown to; empty before it was armed and after the landing.
  std::optional<LandingSite> TrackedSite(Timestamp time) const;
  /// The whole status by the record: state and since when, armed site, whether it is flown to for
  /// a look, refused sites, height, distance, touchdown. Of
  /// `watched`, which Mission says of the pictures played, it takes what needs no past: the alarms
  /// of channels and cameras, and the limits of the cameras. Without a sample: `watched`.
  MissionStatus StatusAt(Timestamp time, const MissionStatus& watched) const;

 private:
  /// The newest sample not after `time`; null without a record.
  const FlightRecordSample* At(Timestamp time) const;
  /// The first of the samples in a row, up to this one, in which that field is the same.
  template <typename T>
  const FlightRecordSample& First(const FlightRecordSample& sample,
                                  T FlightRecordSample::*field) const {
    auto i = static_cast<std::size_t>(&sample - record_->samples.data());
    while (i > 0 && record_->samples[i - 1].*field == sample.*field) {
      --i;
    }
    return record_->samples[i];
  }

  std::shared_ptr<const FlightRecord> record_;
  std::shared_ptr<const std::vector<Event>> events_;  // those told last
};

}  // namespace palace
