#include "engine/journal/track_reader.h"

#include <utility>

#include "engine/model/find_site.h"
#include "engine/wire/convert.h"

namespace palace {
namespace {

/// A selected site stays bound through these states.
bool IsBound(MissionState state) {
  return state == MissionState::kArmed || state == MissionState::kApproved ||
         state == MissionState::kDescending || state == MissionState::kHold ||
         state == MissionState::kLanded;
}

}  // namespace

bool TrackReader::Wants(const std::string& channel) const {
  return channel == channels_.station_status || channel == channels_.event ||
         channel == channels_.site_decision || channel == channels_.site_proposal ||
         channel == channels_.slad_settings;
}

void TrackReader::Add(const WireMessage& message) {
  if (message.channel == channels_.station_status) {
    AddStatus(message);
  } else if (message.channel == channels_.site_proposal) {
    AddProposal(message);
  } else if (message.channel == channels_.site_decision) {
    AddDecision(message);
  } else if (message.channel == channels_.event) {
    AddEvent(message);
  } else {
    const Result<Settings> settings = DecodeSettings(message);
    if (settings) {
      record_.settings.push_back({message.time, *settings});
      record_.settings_at_start = record_.settings.front().settings;
      record_.has_settings = true;
    }
  }
}

void TrackReader::AddProposal(const WireMessage& message) {
  Result<SiteProposal> proposal = DecodeProposal(message);
  if (!proposal) {
    return;
  }
  RecordedProposal recorded{proposal->map_time, {}};
  for (const LandingSite& site : proposal->selection.sites) {
    recorded.places.push_back({site.id, site.letter, site.p_WS.head<2>(), site.safe_distance_m,
                               site.slope_rad, site.roughness_m});
  }
  // A limit that moved judges the same map again.
  const bool first = record_.proposals.empty();
  new_map_ = new_map_ || first || record_.proposals.back().map_time < recorded.map_time;
  record_.proposals.push_back(std::move(recorded));
  newest_sites_ = std::move(proposal->selection.sites);
}

void TrackReader::AddDecision(const WireMessage& message) {
  const Result<EngineCommand> command = DecodeCommand(message);
  if (!command) {
    return;
  }
  if (const auto* refuse = std::get_if<RefuseSite>(&command->action)) {
    decision_ = {refuse->site_id, true, 0};
  } else if (const auto* approve = std::get_if<ApproveSite>(&command->action)) {
    decision_ = {approve->site_id, false, 0};
  } else if (const auto* look = std::get_if<LookAtSite>(&command->action)) {
    decision_ = {look->site_id, false, look->stop_height_m};
  }
  const auto* select = std::get_if<SelectSite>(&command->action);
  if (select == nullptr) {
    return;
  }
  if (const LandingSite* site = FindSite(newest_sites_, select->site_id)) {
    armed_ = static_cast<int>(record_.armed_sites.size());
    record_.armed_sites.push_back(*site);
    stop_height_m_ = 0;
  }
}

void TrackReader::AddEvent(const WireMessage& message) {
  const Result<Event> event = DecodeEvent(message);
  if (!event) {
    return;
  }
  if (event->kind == EventKind::kDecision && decision_) {
    const Answerable answered = *std::exchange(decision_, std::nullopt);
    if (!IsRefusal(*event)) {
      SetRefused(answered.site_id, answered.refused, event->time);
      stop_height_m_ = answered.stop_height_m;
    }
  }
  record_.events.push_back(*event);
}

void TrackReader::SetRefused(std::uint64_t site_id, bool refused, Timestamp time) {
  std::vector<std::uint64_t> ids;
  if (!record_.refusals.empty()) {
    ids = record_.refusals.back().site_ids;
  }
  const bool was = std::erase(ids, site_id) > 0;
  if (refused) {
    ids.push_back(site_id);
  }
  if (was != refused) {
    record_.refusals.push_back({time, std::move(ids)});
  }
}

void TrackReader::AddStatus(const WireMessage& message) {
  Result<FlightRecordSample> sample = DecodeStationStatus(message);
  if (!sample) {
    return;
  }
  const bool bound = IsBound(sample->state);
  sample->armed = bound ? armed_ : -1;
  sample->stop_height_m = bound && sample->state != MissionState::kArmed ? stop_height_m_ : 0;
  sample->new_map = std::exchange(new_map_, false);
  NoteTouchdown(*sample);
  record_.samples.push_back(*sample);
}

void TrackReader::NoteTouchdown(const FlightRecordSample& sample) {
  // A log that begins on the ground does not tell how the vehicle came there.
  const bool flew =
      !record_.samples.empty() && record_.samples.back().state != MissionState::kLanded;
  const LandingSite* site = record_.ArmedAt(sample);
  if (flew && sample.state == MissionState::kLanded && site != nullptr) {
    record_.touchdowns.push_back({sample.time, site->p_WS, sample.distance_to_site_m});
  }
}

}  // namespace palace
