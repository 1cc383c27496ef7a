#include "engine/journal/track_reader.h"

#include <utility>

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
    const Result<Event> event = DecodeEvent(message);
    if (event) {
      record_.events.push_back(*event);
    }
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
    recorded.places.push_back({site.id, site.letter, site.p_WS.head<2>()});
  }
  record_.proposals.push_back(std::move(recorded));
  newest_sites_ = std::move(proposal->selection.sites);
}

void TrackReader::AddDecision(const WireMessage& message) {
  const Result<EngineCommand> command = DecodeCommand(message);
  const auto* select = command ? std::get_if<SelectSite>(&command->action) : nullptr;
  if (select == nullptr) {
    return;
  }
  for (const LandingSite& site : newest_sites_) {
    if (site.id == select->site_id) {
      armed_ = static_cast<int>(record_.armed_sites.size());
      record_.armed_sites.push_back(site);
    }
  }
}

void TrackReader::AddStatus(const WireMessage& message) {
  const Result<FlightRecordSample> sample = DecodeStationStatus(message);
  if (!sample) {
    return;
  }
  record_.samples.push_back(*sample);
  record_.samples.back().armed = IsBound(sample->state) ? armed_ : -1;
}

}  // namespace palace
