// AhrsSensor: attitude as the true rotation followed by a small body rotation, white plus a slow
// first-order Gauss-Markov bias.
#pragma once

#include <cstdint>

#include <Eigen/Dense>

#include "engine/core/random.h"

namespace palace {

struct AhrsNoise {
  double white_rad = 0;
  double bias_rad = 0;  ///< first-order Gauss-Markov
  double bias_time_s = 300;
  /// Poses are told so much later than they are stamped. What the vehicle itself flies on is not:
  /// the delay of its controls is ActuatorFigures::delay_s.
  double delay_s = 0;
};

class AhrsSensor {
 public:
  AhrsSensor(const AhrsNoise& noise, double rate_hz, std::uint64_t seed);
  Eigen::Matrix3d Measure(const Eigen::Matrix3d& R_WB);

 private:
  AhrsNoise noise_;
  double decay_;
  RandomStream random_;
  Eigen::Vector3d bias_rad_;
};

}  // namespace palace
