// One mission, pictures and all, until ten seconds after the hand-over from GPS to vision: what it
// says of velocity before, at and after that, against the truth.
#pragma once

#include <optional>

#include "engine/core/result.h"
#include "engine/experiments/axis_rms.h"
#include "engine/experiments/mission_flight.h"

namespace palace {

struct HandoverFlight {
  /// Root mean square of the vision filter's velocity less the truth, per axis of W: in the hover
  /// that is still flown on GPS, from its first fix ...
  Eigen::Vector3d hover_rms_mps = Eigen::Vector3d::Constant(NAN);
  /// ... and then of what is sent on the way down, flown on vision.
  Eigen::Vector3d descent_rms_mps = Eigen::Vector3d::Constant(NAN);
  /// Largest change of the error of the velocity that is sent, from one message to the next: from
  /// the last on GPS to the first on vision, and on until the cross-fade is over. NaN: never handed
  /// over, or the flight ended before that.
  double step_mps = NAN;
  double first_step_mps = NAN;  ///< the first of them, from GPS to vision
  double gap_mps = NAN;    ///< vision's own velocity less that of GPS then: what the fade spreads
  double usual_mps = NAN;  ///< such changes between two messages on GPS, root mean square
};

/// What is known of velocity after one pass of the station.
struct VelocitySeen {
  PositionEstimate sent;
  Eigen::Vector3d true_v_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d gps_v_WB = Eigen::Vector3d::Zero();  ///< by its own filter
  std::optional<Eigen::Vector3d> vision_v_WB{};        ///< by its own filter, where that runs
};

/// Follows a mission's velocities through the hand-over.
class HandoverOnlooker {
 public:
  void Look(const VelocitySeen& seen);
  /// Nothing later counts.
  bool IsOver(Timestamp now) const;
  HandoverFlight Seen() const;

 private:
  std::optional<Eigen::Vector3d> error_;  ///< of the newest velocity sent
  std::optional<Timestamp> switched_;
  bool faded_ = false;
  AxisRms usual_, hover_, descent_;
  HandoverFlight seen_;
};

/// The flight as FlyMission flies it, until the onlooker has seen enough. Errors: as FlyMission.
Result<HandoverFlight> FlyHandover(const MissionFlight& flight, const SceneCameraFactory& camera);

}  // namespace palace
