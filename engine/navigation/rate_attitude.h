// RateAttitude: the attitude carried on by the turning rates, for turns over seconds.
//
//   R_k = R_k-1 exp(dt (w_k-1 + w_k) / 2),  then turned by dt / 20 s of the way to the attitude
//   told
//
// Over seconds rates tell a turn better than attitudes do: an attitude that steps or drifts against
// them has not turned. So that a fault of either is never taken for a turn, nothing is told while
// the two are more than 0.5 deg apart: rates that are off soon are, and for the pull what is told
// turns by 0.025 deg/s at most. A false turn is 0.6 deg in 4 s at most. Rates and attitude that are
// wrong together, as of one biased gyro, are told as a turn.
// Source: Mahony, Hamel & Pflimlin 2008 (complementary filter on SO(3)).
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/core/time.h"
#include "engine/model/vehicle_state.h"
#include "engine/navigation/attitude_history.h"

namespace palace {

class RateAttitude {
 public:
  void Reset() { *this = RateAttitude(); }
  /// In order of time; older ones, and those that hold what is no number, are ignored. Poses more
  /// than 0.25 s apart tell no turn between them: it starts anew at the later one.
  void Add(const VehiclePose& pose);
  /// R_WB at a time in the last 2 s, or up to 0.5 s ahead. Nothing while attitude and rates part,
  /// and until it was carried on for `over_s` without a gap: turns within that time are told.
  std::optional<Eigen::Matrix3d> At(Timestamp time, double over_s) const;

 private:
  AttitudeHistory carried_;
  Timestamp start_;
  double apart_rad_ = 0;  ///< carried on and told, at the newest pose
};

}  // namespace palace
