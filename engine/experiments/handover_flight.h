// One mission, pictures and all, until ten seconds after the hand-over from GPS to vision: what it
// says of velocity before, at and after that, against the truth.
#pragma once

#include "engine/core/result.h"
#include "engine/experiments/mission_flight.h"

namespace palace {

struct HandoverFlight {
  /// Root mean square of the vision filter's velocity less the truth, per axis of W: in the hover
  /// that is still flown on GPS, settled ...
  Eigen::Vector3d hover_rms_mps = Eigen::Vector3d::Constant(NAN);
  /// ... and then on the way down, flown on vision.
  Eigen::Vector3d descent_rms_mps = Eigen::Vector3d::Constant(NAN);
  /// Change of the error of the velocity sent to the vehicle, from the last one on GPS to the first
  /// on vision, and to the farthest within the second of the cross-fade. NaN: never handed over.
  double step_mps = NAN;
  double faded_mps = NAN;
};

/// Uses scenario, seed, vehicle, settings, wind and limit of the flight. Errors: as FlyMission.
Result<HandoverFlight> FlyHandover(const MissionFlight& flight, const SceneCameraFactory& camera);

}  // namespace palace
