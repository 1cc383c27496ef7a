// EstimateWatch: do the position estimates that a station sends move as the vehicle itself does?
//
//   E(t) = p_estimate(t) - integral of v_own dt        own velocity: of GPS and inertial unit
//
// is constant but for noise when both are true. Estimates are apart when, over any span tau of the
// last kMemory_s,
//
//   |E(t) - E(t - tau)| > kStep_m + kDrift_mps tau     E averaged over kAverage_s
//
// or, over all the time since the hand-over at t0,
//
//   |E(t) - E(t0)| > kSum_m                            a slow drift that no span shows
//
// Positions of the own solution are asked at the hand-over alone, against kApart_m: later a GPS
// that jumps by metres while its velocity is good must not end a landing that vision steers well.
// What an attacker with a stolen session key can still do is lead the vehicle astray by kSum_m,
// from a start that is kApart_m off.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "engine/model/vehicle_message.h"

namespace palace {

class EstimateWatch {
 public:
  static constexpr double kMemory_s = 12;
  static constexpr double kStep_m = 0.30;
  static constexpr double kDrift_mps = 0.06;
  static constexpr double kAverage_s = 0.25;
  /// Velocity of GPS and inertial unit, integrated over a descent, errs by less (3 cm/s over 2 s:
  /// 0.7 m in 120 s at three sigma), and so does vision.
  static constexpr double kSum_m = 2.5;
  static constexpr double kApart_m = 10;  ///< a GPS without corrections, and vision of its own

  /// Vision takes over: what came before does not count. Empty, or why it may not, from where both
  /// place the vehicle now.
  std::string Begin(const Eigen::Vector3d& p_vision_WB, const Eigen::Vector3d& p_own_WB);
  /// The own velocity, each control step.
  void Propagate(Timestamp now, const Eigen::Vector3d& v_WB);
  /// Empty, or why the estimate cannot be flown on: how far apart, in what time, and the limit.
  std::string Judge(const PositionEstimate& estimate);

 private:
  struct Point {
    Timestamp time;
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  };
  const Point* OwnAt(Timestamp time) const;

  std::deque<Point> own_;         ///< the integral, one a control step
  std::deque<Point> difference_;  ///< E, averaged, one an estimate
  std::optional<Point> first_;    ///< since the hand-over
};

}  // namespace palace
