#include "engine/runtime/recorded_mission.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/mission/alarms/alarms.h"

namespace palace {

const FlightRecordSample* RecordedMission::At(Timestamp time) const {
  if (!record_ || record_->samples.empty()) {
    return nullptr;
  }
  const auto& samples = record_->samples;
  const auto after = std::upper_bound(
      samples.begin(), samples.end(), time,
      [](Timestamp t, const FlightRecordSample& sample) { return t < sample.time; });
  return after == samples.begin() ? &samples.front() : &*(after - 1);
}

const Settings* RecordedMission::SettingsAt(Timestamp time) const {
  if (!record_ || record_->settings.empty()) {
    return nullptr;
  }
  const auto& all = record_->settings;
  const auto after =
      std::upper_bound(all.begin(), all.end(), time,
                       [](Timestamp t, const SettingsInForce& entry) { return t < entry.from; });
  return after == all.begin() ? &all.front().settings : &(after - 1)->settings;
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

const LandingSite* RecordedMission::ArmedSite(const FlightRecordSample& sample) const {
  const bool known =
      sample.armed >= 0 && static_cast<std::size_t>(sample.armed) < record_->armed_sites.size();
  return known ? &record_->armed_sites[static_cast<std::size_t>(sample.armed)] : nullptr;
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
    history.push_back(sample);
  }
  return history;
}

std::optional<LandingSite> RecordedMission::TrackedSite(Timestamp time) const {
  const FlightRecordSample* sample = At(time);
  const LandingSite* site = sample ? ArmedSite(*sample) : nullptr;
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
  if (const LandingSite* site = ArmedSite(*sample)) {
    status.armed = *site;
    const Settings* limits = SettingsAt(First(*sample, &FlightRecordSample::armed).time);
    status.armed_limits = SiteLimits(*site, (limits ? *limits : record_->settings_at_start).slad);
  }
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
