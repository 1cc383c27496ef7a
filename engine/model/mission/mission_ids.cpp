#include "engine/model/mission/mission_ids.h"

#include <array>

#include "engine/core/check.h"

namespace palace {
namespace {

constexpr std::array<const char*, kGuardCount> kGuardNames = {
    "G1", "G2", "G3", "G4", "G5", "G6", "G7", "G8", "G9", "G10", "G11", "G12", "G13", "G14", "G15"};

constexpr std::array<const char*, kAlarmCount> kAlarmNames = {
    "camera_left",
    "camera_right",
    "pose",
    "no_pose",
    "link",
    "clock",
    "reboot",
    "gps_error",
    "camera_frozen",
    "cameras_swapped",
    "row_error",
    "exposure",
    "range_scale",
    "height_mismatch",
    "recorder",
    "record_thinned",
    "engine_stopped",
    "log_damaged",
    "no_site",
    "wave_off",
    "hold",
    "site_degraded",
    "vision_lost",
    "coherence_low",
    "approval_unanswered",
    "approval_refused",
    "foreign_descent",
    "pictures_replaced",
    "undecodable",
    "records_dropped",
    "messages_unsent",
    "off_path",
    "off_centre",
    "descent_rate",
    "vision_residual",
    "wind",
    "datagrams_refused",
    "refused_often",
    "bus_overload",
    "bus_overrun",
    "other_version",
    "second_sender",
    "stalled",
    "stamps_refused",
    "attitude_invalid",
    "message_loss",
    "camera_blank",
    "pairing",
    "old_ground",
    "foreign_command",
    "view_only",
    "image_time",
    "gravity",
    "gps_jump",
    "gps_lost",
    "laser_lost",
    "laser_stuck",
    "laser_wrong",
    "energy_low",
    "tailwind",
    "trackers_apart",
    "not_on_site",
    "unusual_limits",
};

}  // namespace

const char* GuardName(GuardId id) {
  const auto i = static_cast<std::size_t>(id);
  PALACE_CHECK(i < kGuardNames.size(), i);
  return kGuardNames[i];
}

const char* AlarmName(AlarmId id) {
  const auto i = static_cast<std::size_t>(id);
  PALACE_CHECK(i < kAlarmNames.size(), i);
  return kAlarmNames[i];
}

std::optional<AlarmId> AlarmFromName(std::string_view name) {
  for (std::size_t i = 0; i < kAlarmNames.size(); ++i) {
    if (kAlarmNames[i] == name) {
      return static_cast<AlarmId>(i);
    }
  }
  return std::nullopt;
}

}  // namespace palace
