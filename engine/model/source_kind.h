// SourceKind: where the frames of a session come from.
#pragma once

#include <cstdint>

namespace palace {

enum class SourceKind : std::uint8_t {
  kNone,
  kLive,  ///< a vehicle on a bus
  kSimulation,
  kReplay,
  kImages,   ///< a folder of pictures
  kCameras,  ///< live cameras without a vehicle
  kVideo     ///< filmed pictures
};

}  // namespace palace
