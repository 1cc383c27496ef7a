// VisionFixes: positions as the thesis's seven steps would give them in flight, without drawing a
// picture: equations 3.1-3.12 (navigation/monocular_position.h) of a pixel, a laser range and an
// attitude, each with its errors.
//
//   pixel     of a place on level ground, 1 px of white noise and 1 px that wanders within 10 s
//             (vision_fix.h counts on 1 px for a template; vision.md E26: what is refreshed drifts)
//   laser     noise of the vehicle's file;  attitude: that of the vehicle's AHRS
//   time      a result takes 33 to 100 ms, and is told then: "sometimes reaching up to 30 Hz"
//             (thesis 5.1.1)
// A fix states what differs from one to the next: pixel, laser, noise of the attitude. From 50 ft
// the errors are 0.04 to 0.06 m of noise on each axis, and a bias: the AHRS's times the distance.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/core/frames.h"
#include "engine/core/random.h"
#include "engine/model/rig.h"
#include "engine/navigation/inertial_kalman.h"
#include "engine/simulation/laser_sensor.h"

namespace palace {

enum class FixPace : std::uint8_t { kAsFastAsItCan, kTenHz };
enum class FixAttitude : std::uint8_t { kOfExposure, kOnArrival };

class VisionFixes {
 public:
  struct Options {
    StereoRig rig;
    LaserNoise laser;
    double attitude_noise_rad = 0;                   ///< of the AHRS, one standard deviation
    Eigen::Vector3d p_WS = Eigen::Vector3d::Zero();  ///< what is followed
    FixPace pace = FixPace::kTenHz;
    FixAttitude attitude = FixAttitude::kOfExposure;
    std::uint64_t seed = 1;
  };
  struct Told {
    PositionMeasurement fix;
    Eigen::Vector3d error_m = Eigen::Vector3d::Zero();  ///< against where B was at the exposure
  };

  explicit VisionFixes(const Options& options);
  /// One step of time, in order. `R_WB`: what the AHRS says now. Nothing: no result comes now, or
  /// it shows no place (out of the picture, laser above the horizon).
  std::optional<Told> Advance(Timestamp now, const RigidTransform& X_WB_true,
                              const Eigen::Matrix3d& R_WB);

 private:
  struct Exposure {
    Timestamp time;
    Timestamp told;
    RigidTransform X_WB;
    Eigen::Matrix3d R_WB;
  };
  std::optional<Told> Measure(const Exposure& exposure, const Eigen::Matrix3d& R_WB);

  Options options_;
  RandomStream noise_;
  RandomStream pace_;
  Eigen::Vector2d wander_px_;
  std::optional<Exposure> under_way_;
  std::optional<Timestamp> due_;
};

}  // namespace palace
