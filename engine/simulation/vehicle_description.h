// VehicleDescription: all that is one vehicle's own, as its file in config/vehicles says it. What
// flies, what it stands on, where its cameras look from, what its controllers do, how its sensors
// err, and how it may meet the ground. Code holds none of these numbers.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "engine/model/rig.h"
#include "engine/model/settings/settings.h"
#include "engine/simulation/actuators.h"
#include "engine/simulation/attitude_sensor.h"
#include "engine/simulation/camera_figures.h"
#include "engine/simulation/gps_sensor.h"
#include "engine/simulation/ground_effect.h"
#include "engine/simulation/imu_sensor.h"
#include "engine/simulation/laser_sensor.h"
#include "engine/simulation/multirotor.h"
#include "engine/simulation/rotorcraft.h"

namespace palace {

/// Where a number comes from.
enum class ValueMark {
  kSourced,   ///< read in a public source that the file names
  kRecalled,  ///< from memory, its source not at hand
  kComputed,  ///< worked out or measured for this file
  kChosen,    ///< our own design
};
const char* ValueMarkName(ValueMark mark);

/// A number of the file with its mark, for showing.
struct MarkedValue {
  std::string name;  ///< "derivatives.Xu"
  double value = 0;
  ValueMark mark = ValueMark::kChosen;
};

/// What the vehicle accepts, and how long it flies.
struct FlightLimits {
  double min_glide_slope_rad = 0;
  double min_descent_rate_mps = 0;
  double max_descent_rate_mps = 0;
  double climb_rate_mps = 0;  ///< when waved off
  double max_wind_mps = 0;
  double endurance_s = 0;
  double settle_s = 0;  ///< until it is still above a site, in calm air
};

/// The hardest touchdown that the gear is made for.
struct GearLimits {
  double sink_mps = 0;
  double across_mps = 0;
  double tilt_rad = 0;
};

/// A figure of a sensor as the file tells it, for showing; its name has the unit.
struct SensorValue {
  std::string name;  ///< "camera.exposure_ms"
  double value = 0;
  bool given = false;  ///< else left out: the default
};

struct SensorFigures {
  CameraFigures camera;
  GpsNoise gps;
  ImuNoise imu;
  AhrsNoise attitude;  ///< as often as the inertial unit
  LaserNoise laser;
  double gps_rate_hz = 0;
  double imu_rate_hz = 0;
  double laser_rate_hz = 0;
};

struct VehicleDescription {
  std::string name;    ///< "Yamaha R-50"
  std::string origin;  ///< the file it was read from, or "built in"
  double mass_kg = 0;
  Lander lander;  ///< its sizes; navigation error and up vector stay the settings'
  StereoRig rig;
  FlightLimits limits;
  GearLimits gear;
  std::variant<RotorcraftParameters, MultirotorParameters> model;
  GroundEffect ground_effect;
  ActuatorFigures actuators;
  CascadeGains gains;
  SensorFigures sensors;
  double clock_drift = 0;                  ///< seconds that its clock gains a second
  std::vector<MarkedValue> marked;         ///< in the order of the file
  std::vector<SensorValue> sensor_values;  ///< table by table
};

/// Where the gear can meet the ground, in B: its centre and the four ends.
std::array<Eigen::Vector3d, 5> GearPoints(const Lander& lander);

/// What a station reckons with for this vehicle: the default settings with its sizes and its wind.
Settings SettingsFor(const VehicleDescription& vehicle);

/// The R-50 of config/vehicles/r50.toml.
const VehicleDescription& DefaultVehicle();

}  // namespace palace
