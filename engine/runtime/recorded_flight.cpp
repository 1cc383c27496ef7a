#include "engine/runtime/recorded_flight.h"

#include <algorithm>
#include <cmath>

namespace palace {

const FlightRecordSample* RecordedFlight::At(Timestamp time) const {
  if (!record_ || record_->samples.empty()) {
    return nullptr;
  }
  const auto& samples = record_->samples;
  const auto after = std::upper_bound(
      samples.begin(), samples.end(), time,
      [](Timestamp t, const FlightRecordSample& sample) { return t < sample.time; });
  return after == samples.begin() ? &samples.front() : &*(after - 1);
}

const Settings* RecordedFlight::SettingsAt(Timestamp time) const {
  if (!record_ || record_->settings.empty()) {
    return nullptr;
  }
  const auto& all = record_->settings;
  const auto after =
      std::upper_bound(all.begin(), all.end(), time,
                       [](Timestamp t, const SettingsInForce& entry) { return t < entry.from; });
  return after == all.begin() ? &all.front().settings : &(after - 1)->settings;
}

const LandingSite* RecordedFlight::ArmedSite(const FlightRecordSample& sample) const {
  const bool known =
      sample.armed >= 0 && static_cast<std::size_t>(sample.armed) < record_->armed_sites.size();
  return known ? &record_->armed_sites[static_cast<std::size_t>(sample.armed)] : nullptr;
}

std::vector<HistorySample> RecordedFlight::HistoryBefore(Timestamp time) const {
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

void RecordedFlight::Restore(const FlightRecordSample& sample, MissionStatus& status) const {
  status.state = sample.state;
  status.why = "As recorded";
  status.height_above_site_m = sample.height_above_site_m;
  status.distance_to_site_m = sample.distance_to_site_m;
  const LandingSite* site = ArmedSite(sample);
  status.armed = site ? std::optional<LandingSite>(*site) : std::nullopt;
  const Settings* limits = SettingsAt(sample.time);
  status.armed_limits =
      site ? SiteLimits(*site, (limits ? *limits : record_->settings_at_start).slad)
           : std::vector<LimitRow>{};
  status.guards.clear();
  status.can_approve = false;
  status.may_select = false;
  status.cannot_approve_reason = WhyNoVehicle(SourceKind::kReplay);
}

}  // namespace palace
