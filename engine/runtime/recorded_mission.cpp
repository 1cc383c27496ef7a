#include "engine/runtime/recorded_mission.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/mission/alarms/alarms.h"

namespace palace {
namespace {

std::optional<double> Known(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

}  // namespace

const FlightRecordSample* RecordedMission::At(Timestamp time) const {
  if (!record_ || record_->samples.empty()) {
    return nullptr;
  }
  const FlightRecordSample* newest = record_->SampleAt(time);
  return newest != nullptr ? newest : &record_->samples.front();
}

const Settings* RecordedMission::SettingsAt(Timestamp time) const {
  if (!record_ || record_->settings.empty()) {
    return nullptr;
  }
  const SettingsInForce* newest = NewestAt(record_->settings, &SettingsInForce::from, time);
  return newest != nullptr ? &newest->settings : &record_->settings.front().settings;
}

bool RecordedMission::BeginsMidFlight() const {
  if (!record_ || record_->samples.empty()) {
    return false;
  }
  const MissionState first = record_->samples.front().state;
  return first != MissionState::kNoLive && first != MissionState::kSearch;
}

std::shared_ptr<const std::vector<Event>> RecordedMission::EventsUntil(Timestamp time) {
  if (!record_ || record_->events.empty()) {
    return nullptr;
  }
  const auto& all = record_->events;
  const auto end = std::upper_bound(all.begin(), all.end(), time,
                                    [](Timestamp t, const Event& event) { return t < event.time; });
  const auto count = static_cast<std::size_t>(end - all.begin());
  if (!events_ || events_->size() != count) {
    events_ = std::make_shared<const std::vector<Event>>(all.begin(), end);
  }
  return events_;
}

const RecordedProposal* RecordedMission::ProposalAt(Timestamp time) const {
  return record_ ? record_->ProposalAt(time) : nullptr;
}

std::vector<HistorySample> RecordedMission::HistoryBefore(Timestamp time) const {
  std::vector<HistorySample> history;
  if (!record_) {
    return history;
  }
  for (const FlightRecordSample& recorded : record_->samples) {
    if (recorded.time >= time) {
      break;
    }
    HistorySample sample;
    sample.time = recorded.time;
    sample.state = recorded.state;
    sample.height_above_site_m = recorded.height_above_site_m;
    sample.from_site_m = recorded.distance_to_site_m;
    sample.best_site = recorded.best_site;
    sample.best_safe_distance_m = recorded.best_safe_distance_m;
    sample.new_map = recorded.new_map;
    history.push_back(sample);
  }
  return history;
}

std::array<std::optional<Timestamp>, kChannelCount> RecordedMission::HeardBefore(
    Timestamp time) const {
  std::array<std::optional<Timestamp>, kChannelCount> heard;
  for (std::size_t i = 0; record_ && i < kChannelCount; ++i) {
    const std::vector<Timestamp>& times = record_->heard[i];
    const auto from = std::lower_bound(times.begin(), times.end(), time);
    if (from != times.begin()) {
      heard[i] = *(from - 1);
    }
  }
  return heard;
}

std::optional<LandingSite> RecordedMission::TrackedSite(Timestamp time) const {
  const FlightRecordSample* sample = At(time);
  const LandingSite* site = sample ? record_->ArmedAt(*sample) : nullptr;
  return site && sample->state != MissionState::kLanded ? std::optional(*site) : std::nullopt;
}

MissionStatus RecordedMission::StatusAt(Timestamp time, const MissionStatus& watched) const {
  const FlightRecordSample* sample = At(time);
  if (sample == nullptr) {
    return watched;
  }
  MissionStatus status;
  status.state = sample->state;
  status.since = First(*sample, &FlightRecordSample::state).time;
  status.why = "As recorded";
  if (const LandingSite* site = record_->ArmedAt(*sample)) {
    status.armed = *site;
    const Settings* limits = SettingsAt(First(*sample, &FlightRecordSample::armed).time);
    status.armed_limits = SiteLimits(*site, (limits ? *limits : record_->settings_at_start).slad);
  }
  if (const auto* refused = NewestAt(record_->refusals, &RecordedRefusals::from, time)) {
    status.refused_sites = refused->site_ids;
  }
  const auto* touchdown = NewestAt(record_->touchdowns, &RecordedTouchdown::time, sample->time);
  if (touchdown != nullptr && sample->state == MissionState::kLanded) {
    status.touchdown_miss_m = Known(touchdown->miss_m);
    status.touchdown_miss_true_m = Known(touchdown->true_miss_m);
  }
  status.stop_height_m = sample->stop_height_m;
  status.height_above_site_m = sample->height_above_site_m;
  status.distance_to_site_m = sample->distance_to_site_m;
  status.time_to_touchdown_s = sample->state == MissionState::kLanded ? 0 : NAN;
  status.confirm_height_m = watched.confirm_height_m;
  status.cannot_approve_reason = WhyNoVehicle(SourceKind::kReplay);
  status.alarms_in_record = sample->alarms;
  std::copy_if(watched.alarms.begin(), watched.alarms.end(), std::back_inserter(status.alarms),
               [](const Alarm& alarm) {
                 return !AlarmTable()[static_cast<std::size_t>(alarm.kind)].of_mission;
               });
  for (const LimitId id : {LimitId::kRowError, LimitId::kExposure, LimitId::kRangeScale}) {
    if (const LimitRow* row = FindLimit(watched.limits, id)) {
      status.limits.push_back(*row);
    }
  }
  return status;
}

}  // namespace palace
