// VelocityFade: what was in force goes over into what is, within a second.
//
// A vehicle that is flown on the velocity of one estimator would feel the step to that of another.
// So the old one less the new one is added after a switch, all of it at first, then less and less.
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/core/time.h"

namespace palace {

class VelocityFade {
 public:
  void Start(Timestamp time, const Eigen::Vector3d& old_v_WB, const Eigen::Vector3d& new_v_WB);
  void Stop() { switch_.reset(); }
  /// The new one's velocity, as it is told at `now`.
  Eigen::Vector3d Faded(const Eigen::Vector3d& v_WB, Timestamp now) const;

 private:
  struct Switch {
    Timestamp time;
    Eigen::Vector3d dv_WB = Eigen::Vector3d::Zero();  ///< old minus new
  };
  std::optional<Switch> switch_;
};

}  // namespace palace
