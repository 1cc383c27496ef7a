// What the detectors saw of the target.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Dense>

namespace palace {

/// One point of the target in a picture. For a dot the pixel is the centroid of its area in the
/// picture, which is not the projection of its centre (lens.h).
struct TargetPoint {
  int index = 0;  ///< of CalibrationTarget
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// Points in any order, no index twice. Empty: the target was not seen.
using TargetObservation = std::vector<TargetPoint>;

/// The target seen by both cameras at one moment.
struct TargetView {
  std::string name;  ///< for messages and tables: the picture's file name
  TargetObservation left;
  TargetObservation right;
  std::string right_name{};  ///< of the right picture's file; empty where it has none
};

}  // namespace palace
