#include "engine/wire/channel_rules.h"

#include <array>

namespace palace {
namespace {

struct Rule {
  std::string ChannelNames::*channel;
  ChannelLimits limits;
  std::string ChannelNames::*with_sender_of = nullptr;
};

constexpr std::size_t kPicture = (8u << 20) + 4096;  ///< 8 megapixels, 4 kB for the rest

/// One sender of a sensor may miss three of its slowest beats before another takes its place.
const std::array kRules = {
    Rule{&ChannelNames::camera_left, {kPicture, 16, kPicture, 30, 1}},
    Rule{&ChannelNames::camera_right, {kPicture, 16, kPicture, 30, 1}},
    // In our own recordings and simulations a rotation matrix for each pose of the bundle.
    Rule{&ChannelNames::camera_rig, {2u << 20, 32, 4u << 20, 30, 3}},
    Rule{&ChannelNames::vehicle_pose, {256, 512, 1u << 20, 200, 1}},
    Rule{&ChannelNames::imu, {256, 512, 1u << 20, 400, 1}},
    Rule{&ChannelNames::gps, {256, 512, 1u << 20, 10, 3}},
    Rule{&ChannelNames::laser_range, {256, 512, 1u << 20, 100, 1}},
    Rule{&ChannelNames::vehicle_status, {1024, 512, 1u << 20, 20, 1}},
    Rule{&ChannelNames::command_ack, {4096, 512, 1u << 20, 20, 0}, &ChannelNames::vehicle_status},
    Rule{&ChannelNames::authority, {1024, 64, 1u << 18, 20, 3}},
    Rule{&ChannelNames::truth, {256, 512, 1u << 20, 400, 1}},
    // To the vehicle: any number of stations, of which seals tell the one that may.
    Rule{&ChannelNames::command, {4096, 256, 1u << 20, 20, 0}},
    Rule{&ChannelNames::position_estimate, {1024, 256, 1u << 20, 60, 0}},
    Rule{&ChannelNames::session_request, {1024, 64, 1u << 18, 20, 0}},
    Rule{&ChannelNames::abort, {4096, 256, 1u << 20, 20, 0}},
};

}  // namespace

ChannelLimits LimitsOf(const ChannelNames& names, const std::string& channel) {
  for (const Rule& rule : kRules) {
    if (names.*(rule.channel) == channel) {
      ChannelLimits limits = rule.limits;
      if (rule.with_sender_of != nullptr) {
        limits.with_sender_of = names.*(rule.with_sender_of);
      }
      return limits;
    }
  }
  return {};
}

}  // namespace palace
