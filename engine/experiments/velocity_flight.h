// One closed-loop flight of `evaluate velocity-estimate`: a vehicle with its wind, sensors,
// actuators and cascade, that is flown on position and velocity made from vision fixes
// (vision_fixes.h) by one of several methods.
//
// 20 s of hover at 50 ft on GPS, during the second half of which the vision filter runs beside it;
// then, at t = 0, vision is flown on: a hover, and the slope down to a skid height of 2 m. At the
// switch the set-point is moved by vision minus GPS, as the autopilot does.
//
// A crash: the gear meets the ground, B is 10 m off its set-point (the feature has left the picture
// long before), or it tilts by 45 deg (the flight model is good for some 20).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/experiments/fixed_gain_filter.h"
#include "engine/experiments/vision_fixes.h"
#include "engine/simulation/vehicle_description.h"

namespace palace {

enum class VelocitySource : std::uint8_t {
  kGps,         ///< the vehicle's own GPS filter: what all others are held against
  kFixedGains,  ///< fixed_gain_filter.h, each fix taken for one of now
  kByStamps,    ///< navigation/position_filter.h
};

struct VelocityMethod {
  const char* name;
  VelocitySource source;
  FixedGainDesign design{};
  FixPace pace = FixPace::kAsFastAsItCan;
  FixAttitude attitude = FixAttitude::kOfExposure;
};

/// What the thesis flew one after the other, each with the attitude of the exposure and with the
/// one on arrival, between GPS and ours. Its gains it does not tell. High ones are those of a
/// filter for fixes of 2 cm (carrier GPS, simulation.md 2.2) that trusts its inertial unit to 0.5
/// m/s^2/sqrt(Hz); low ones those of simulation.md 4.2 for vision, 8 cm and 0.03.
std::span<const VelocityMethod> VelocityMethods();

/// Of the cascade's horizontal loop, which through the velocity it wants is one of position.
struct LoopIntegral {
  double gain_per_s2 = 0;
  /// As our cascade does where the acceleration is limited. Else that limit is lifted, the tilt's
  /// stays, and the integral winds up.
  bool freezes = true;
};

struct VelocityFlightPlan {
  VehicleDescription vehicle = DefaultVehicle();
  std::uint64_t seed = 1;
  double wind_mps = 0;  ///< mean at 20 ft, from the north
  double hover_s = 120;
};

struct VelocityFlight {
  /// Root mean square of estimated less true velocity, per axis of W, from 2 s after the switch.
  Eigen::Vector3d hover_rms_mps = Eigen::Vector3d::Constant(NAN);
  Eigen::Vector3d approach_rms_mps = Eigen::Vector3d::Constant(NAN);
  /// Largest distance from the set-point, by the truth, what the switch moved it by not counted.
  double hover_off_m = 0;
  double approach_off_m = NAN;
  std::string crash = "none";
  double crash_s = NAN;                                          ///< after the switch
  Eigen::Vector3d fix_bias_m = Eigen::Vector3d::Constant(NAN);   ///< mean error of the fixes
  Eigen::Vector3d fix_noise_m = Eigen::Vector3d::Constant(NAN);  ///< their deviation, in the hover
  struct Sample {
    double time_s = 0;
    Eigen::Vector3d estimated_mps, true_mps;
  };
  std::vector<Sample> track{};  ///< five a second
};

/// Error: cameras that look too flat for a slope (slope_foot.h).
Result<VelocityFlight> FlyOn(const VelocityMethod& method, const LoopIntegral& integral,
                             const VelocityFlightPlan& plan);

}  // namespace palace
