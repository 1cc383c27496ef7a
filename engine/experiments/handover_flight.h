// One mission, pictures and all, until ten seconds after the hand-over from GPS to vision: what it
// says of velocity before, at and after that, against the truth.
#pragma once

#include "engine/core/result.h"
#include "engine/experiments/mission_flight.h"

namespace palace {

struct HandoverFlight {
  /// Root mean square of the vision filter's velocity less the truth, per axis of W: in the hover
  /// that is still flown on GPS, from its first fix ...
  Eigen::Vector3d hover_rms_mps = Eigen::Vector3d::Constant(NAN);
  /// ... and then on the way down, flown on vision.
  Eigen::Vector3d descent_rms_mps = Eigen::Vector3d::Constant(NAN);
  /// First velocity sent on vision less what GPS says at that same moment: what the switch itself
  /// does. NaN: never handed over.
  double step_mps = NAN;
  double gap_mps = NAN;  ///< vision's own less that of GPS then: what the cross-fade spreads
  /// Change of the error of what is sent, from the last message on GPS to the first on vision ...
  double message_mps = NAN;
  double usual_mps = NAN;  ///< ... and between two on GPS, root mean square
};

/// Uses scenario, seed, vehicle, settings, wind and limit of the flight. Errors: as FlyMission.
Result<HandoverFlight> FlyHandover(const MissionFlight& flight, const SceneCameraFactory& camera);

}  // namespace palace
