#include "engine/runtime/missing_inputs.h"

#include <vector>

#include "engine/core/text.h"

namespace palace {
namespace {

bool Came(const EngineSnapshot& snapshot, ChannelId id) {
  const ChannelHealth* channel = FindChannel(snapshot.sensors->channels, id);
  return channel != nullptr && channel->state != ChannelHealth::State::kNever;
}

}  // namespace

std::string MissingInputs(const EngineSnapshot& snapshot, const Losses& losses) {
  if (HasPicturesOnly(snapshot.session->role)) {
    return {};
  }
  const bool rig = snapshot.sensors->rig != nullptr;
  const bool pair = Came(snapshot, ChannelId::kCameraLeft);
  std::vector<std::string> missing;
  if (!pair && losses.pictures_unpaired > 0 && losses.pairs_without_rig == 0) {
    missing.push_back("a second picture within 5 ms of each");
  } else if (!pair && losses.pairs_without_rig == 0) {
    missing.push_back("CAMERA_LEFT and CAMERA_RIGHT");
  }
  if (!rig) {
    missing.push_back("CAMERA_RIG with a rig (has_rig 1)");
  }
  if (!Came(snapshot, ChannelId::kVehiclePose)) {
    missing.push_back("VEHICLE_POSE");
  }
  return Joined(missing);
}

}  // namespace palace
