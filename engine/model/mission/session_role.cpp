#include "engine/model/mission/session_role.h"

namespace palace {

const char* WhyNoVehicle(SourceKind kind) {
  switch (kind) {
    case SourceKind::kNone:
      return "No data";
    case SourceKind::kLive:
    case SourceKind::kSimulation:
      return "";
    case SourceKind::kReplay:
      return "No link in replay";
    case SourceKind::kImages:
      return "No vehicle, pictures only";
    case SourceKind::kCameras:
      return "No vehicle, cameras only";
    case SourceKind::kVideo:
      return "No vehicle in a video";
  }
  return "No data";
}

}  // namespace palace
