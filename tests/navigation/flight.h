// A flight with a closed form: position, velocity, attitude and what an IMU would read on it.
#pragma once

#include <cmath>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/model/vehicle_state.h"

namespace palace {

/// Down a 45 degree slope at 0.8 m/s towards the origin, in gusts.
struct Flight {
  double speed_mps = 0.8;
  double start_height_m = 20;

  Eigen::Vector3d Position(double t) const {
    const double s = speed_mps * t;
    return {-start_height_m + s + 0.4 * std::sin(0.8 * t), 0.5 * std::sin(0.6 * t + 1),
            -start_height_m + s + 0.2 * std::sin(1.1 * t)};
  }
  Eigen::Vector3d Velocity(double t) const {
    return {speed_mps + 0.32 * std::cos(0.8 * t), 0.3 * std::cos(0.6 * t + 1),
            speed_mps + 0.22 * std::cos(1.1 * t)};
  }
  Eigen::Vector3d Acceleration(double t) const {
    return {-0.256 * std::sin(0.8 * t), -0.18 * std::sin(0.6 * t + 1), -0.242 * std::sin(1.1 * t)};
  }
  Eigen::Matrix3d Attitude(double t) const {
    return RotationFromEuler({Rad(2.0 * std::sin(1.7 * t)), Rad(1.5 * std::sin(1.3 * t + 2)),
                              Rad(20.0 * std::sin(0.2 * t))});
  }
  Eigen::Vector3d SpecificForce(double t) const {
    return Attitude(t).transpose() *
           (Acceleration(t) - Eigen::Vector3d(0, 0, kStandardGravity_mps2));
  }
  VehiclePose Pose(double t) const {
    VehiclePose pose;
    pose.time = AddSeconds({}, t);
    pose.X_WB = {Attitude(t), Position(t)};
    pose.v_WB = Velocity(t);
    const double dt = 1e-4;
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(Attitude(t).transpose() * Attitude(t + dt)));
    pose.angular_rate_B = turn.angle() / dt * turn.axis();
    return pose;
  }
};

inline Eigen::Vector3d NormalVector(RandomStream& random, double sigma) {
  return {sigma * random.Normal(), sigma * random.Normal(), sigma * random.Normal()};
}

}  // namespace palace
