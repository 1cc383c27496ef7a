// What the targets and the corpus of messages share: types and channels by number.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "engine/wire/channels.h"
#include "engine/wire/wire_fields.h"

namespace palace {

/// Every type of engine/wire/types that is a message by itself: the first byte of a fuzzed message
/// counts in it. New ones at the end, so that the corpus stays what it is.
using WireTypes =
    std::tuple<abort_t, camera_rig_t, command_ack_t, command_t, event_t, gps_t, image_t, imu_t,
               laser_range_t, mission_t, pose_t, position_estimate_t, site_decision_t,
               site_proposal_t, slad_settings_t, station_status_t, tracker_status_t, truth_t,
               vehicle_status_t, refused_t, arrival_t, authority_t, session_request_t>;

/// Everything that a bundle is assembled from, of a bus or a recording.
inline std::vector<std::string> StreamChannels(const ChannelNames& names) {
  std::vector<std::string> channels = names.FromVehicle();
  channels.push_back(names.arrival);
  channels.push_back(names.refused);
  return channels;
}

}  // namespace palace
