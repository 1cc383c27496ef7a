// GpsWatch: does GPS jump or drift against its own velocity and the inertial prediction?
//
//   innovation   d = fix - filter's prediction at its stamp: off where |d| > 1 m and, with the
//                covariances P of both, d' P^-1 d > 19.8: what the filter itself refuses for its
//                position (position_filter.h). A jump that the filter does not follow is told
//   consistency  way between the fixes of the last 5 s less the integral of their velocities: off
//                beyond 0.3 m and 6 sigma of two fixes; 0.5 m/s of drift shows after 0.6 s, and
//                less than 0.06 m/s never does
//
// Two fixes in a row that are off by either say so; it ends after five in a row that are off by
// neither. Fixes at 5 Hz: a jump is told within 0.4 s. While it stands a position filter must not
// follow the positions; the velocities it may still use.
// Source: reference/reliability.md F12; Bar-Shalom, Li & Kirubarajan 2001, 5.4.
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Dense>

#include "engine/model/navigation_status.h"
#include "engine/model/vehicle_state.h"
#include "engine/navigation/position_filter.h"

namespace palace {

class GpsWatch {
 public:
  /// In order of time. `predicted`: at the fix's stamp, before the fix was used; none: no filter.
  void Add(const GpsFix& fix, const std::optional<FilterEstimate>& predicted);
  const GpsAgreement& status() const { return status_; }
  /// GPS stands elsewhere for good: off for 10 s, and in that time consistent with itself.
  bool SettledElsewhere() const;

 private:
  struct Point {
    GpsFix fix;
    Eigen::Vector3d travelled_m = Eigen::Vector3d::Zero();  ///< by velocity, since the first
  };
  bool DriftsAt(const GpsFix& fix);

  std::deque<Point> recent_;
  GpsAgreement status_;
  Timestamp newest_;
  std::optional<Timestamp> consistent_since_;  ///< while off
  int off_run_ = 0, fine_run_ = 0;
};

}  // namespace palace
