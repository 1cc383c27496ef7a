#include "engine/mission/leaving.h"

#include "engine/mission/limits.h"

namespace palace {

std::string WhatTheVehicleDoesAlone(const EngineSnapshot& snapshot) {
  const std::optional<VehicleStatus>& vehicle = snapshot.sensors->vehicle;
  if (!HasVehicle(snapshot.session->role) || !vehicle || vehicle->on_ground) {
    return {};
  }
  const MissionState state = snapshot.flight->mission.state;
  if (state == MissionState::kAborting || vehicle->mode == VehicleMode::kAbort) {
    return "The vehicle is climbing away. It goes on by itself and then hovers; nobody watches it.";
  }
  if (vehicle->flies_on_vision || state == MissionState::kDescending) {
    return "The vehicle descends on this station's estimates. Without them it stops where it is, "
           "and climbs away by itself after " +
           LimitWords({snapshot.session->settings.mission.max_vision_outage_s, "s"}) +
           ". The approval is void then.";
  }
  if (state == MissionState::kApproved) {
    return "A landing is approved. Without this station's estimates the vehicle does not descend: "
           "it holds by itself, and the approval expires.";
  }
  return "The vehicle is in the air. It hovers where it is; nobody watches it.";
}

}  // namespace palace
