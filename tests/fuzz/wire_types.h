// Every type of engine/wire/types by number: the first byte of a fuzzed message.
#pragma once

#include <tuple>

#include "engine/wire/wire_fields.h"

namespace palace {

using WireTypes = std::tuple<abort_t, camera_rig_t, command_ack_t, command_t, event_t, gps_t,
                             image_t, imu_t, laser_range_t, mission_t, pose_t, position_estimate_t,
                             site_decision_t, site_proposal_t, slad_settings_t, station_status_t,
                             tracker_status_t, truth_t, vehicle_status_t, refused_t>;

}  // namespace palace
