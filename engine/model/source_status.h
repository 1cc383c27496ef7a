// Where the frames come from, and where in time we are.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/time.h"
#include "engine/model/simulation_setup.h"
#include "engine/model/source_kind.h"

namespace palace {

/// One camera: what it gave, and what was lost on the way.
struct CameraCounters {
  std::string name;          ///< as its channel is called, "Camera left"
  std::string problem;       ///< why no picture comes and what happens next; empty while they come
  std::uint64_t frames = 0;  ///< taken from the device
  std::uint64_t unpaired = 0;        ///< had no partner of the other camera within the tolerance
  std::uint64_t device_dropped = 0;  ///< missing in the device's own beat, or not decodable
  std::uint64_t reopens = 0;         ///< times the device came back
  double rate_hz = NAN;              ///< measured; NaN before two pictures
  double age_s = NAN;                ///< of the newest picture on a live clock; NaN otherwise
};

/// Where the frames come from, and where in time we are.
struct SourceStatus {
  SourceKind kind = SourceKind::kNone;
  std::string name;  ///< scenario, log file, folder or LCM URL
  bool paused = false;
  bool ended = false;
  double speed = 1;  ///< wanted; 0 as fast as possible
  double speed_reached = 1;
  Timestamp start;
  double position_s = 0;             ///< since start
  std::optional<double> duration_s;  ///< known for logs and folders
  bool can_seek = false;
  std::uint64_t frame_index = 0;                 ///< of the frame shown, from 1; 0 before it
  std::uint64_t frame_count = 0;                 ///< 0 unknown
  std::vector<CameraCounters> cameras{};         ///< of kCameras and kVideo
  int part = 1, parts = 1;                       ///< of a log: the one that is played, of how many
  std::optional<SimulationStatus> simulation{};  ///< of the built-in one
  std::string damage{};     ///< of a log: what could not be read, for people; empty when whole
  std::uint64_t jumps = 0;  ///< of a log: times it was told to go on elsewhere
};

}  // namespace palace
