#include "engine/mission/leaving.h"

#include "engine/core/text.h"
#include "engine/mission/limits.h"

namespace palace {
namespace {

bool IsOurs(const AuthorityStatus& authority) {
  return authority.standing == AuthorityStanding::kNone || authority.commands();
}

std::string WhatItDoes(const EngineSnapshot& snapshot, const VehicleStatus& vehicle) {
  const MissionState state = snapshot.flight->mission.state;
  if (state == MissionState::kAborting || vehicle.mode == VehicleMode::kAbort) {
    const bool climbs = snapshot.flight->mission.wave_off.phase == WaveOffReport::Phase::kClimbs;
    return std::string("The vehicle is ") + (climbs ? "climbing away" : "waving off") +
           ". It goes on by itself and then hovers; nobody watches it.";
  }
  if (vehicle.flies_on_vision || state == MissionState::kDescending) {
    return "The vehicle descends on this station's estimates. Without them it stops where it is, "
           "and climbs away by itself after " +
           LimitWords({snapshot.session->settings.mission.max_vision_outage_s, "s"}) +
           ". The approval is void then.";
  }
  if (state == MissionState::kApproved) {
    return std::string(snapshot.flight->mission.IsLook() ? "A look" : "A landing") +
           " is approved. Without this station's estimates the vehicle does not descend: "
           "it holds by itself, and the approval expires.";
  }
  if (vehicle.mode == VehicleMode::kGo) {
    return "The vehicle flies to another hover. It stays there; nobody watches it.";
  }
  return "The vehicle is in the air. It hovers where it is; nobody watches it.";
}

}  // namespace

std::string WhatTheVehicleDoesAlone(const EngineSnapshot& snapshot, double silent_s) {
  const std::optional<VehicleStatus>& vehicle = snapshot.sensors->vehicle;
  if (!HasVehicle(snapshot.session->role) || !vehicle || vehicle->on_ground ||
      !IsOurs(snapshot.session->authority)) {
    return {};
  }
  const ChannelHealth* channel = FindChannel(snapshot.sensors->channels, ChannelId::kVehicleStatus);
  const double heard_s = channel != nullptr ? channel->age_s + silent_s : silent_s;
  const std::string does = WhatItDoes(snapshot, *vehicle);
  return heard_s > GuardLimits::link_s
             ? WithNumbers("The vehicle was heard last %.1f s ago. As it was then: ", heard_s) +
                   does
             : does;
}

}  // namespace palace
