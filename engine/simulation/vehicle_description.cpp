#include "engine/simulation/vehicle_description.h"

#include "engine/core/check.h"
#include "engine/simulation/vehicle_file.h"

namespace palace {

const char* ValueMarkName(ValueMark mark) {
  switch (mark) {
    case ValueMark::kSourced:
      return "sourced";
    case ValueMark::kRecalled:
      return "recalled";
    case ValueMark::kComputed:
      return "computed";
    case ValueMark::kChosen:
      return "chosen";
  }
  PALACE_CHECK(false);
}

std::array<Eigen::Vector3d, 5> GearPoints(const Lander& lander) {
  const Eigen::Vector3d centre = lander.skid_centre_B();
  const Eigen::Vector3d ahead(lander.gear_length_m / 2, 0, 0);
  const Eigen::Vector3d aside(0, lander.gear_width_m / 2, 0);
  return {centre, centre + ahead + aside, centre + ahead - aside, centre - ahead + aside,
          centre - ahead - aside};
}

Settings SettingsFor(const VehicleDescription& vehicle) {
  Settings settings;
  const Lander standard = settings.slad.lander;
  settings.slad.lander = vehicle.lander;
  settings.slad.lander.nav_error_m = standard.nav_error_m;
  settings.slad.lander.up_tilt_deg = standard.up_tilt_deg;
  settings.slad.lander.up_azimuth_deg = standard.up_azimuth_deg;
  settings.mission.max_wind_mps = vehicle.limits.max_wind_mps;
  settings.mission.settle_s = vehicle.limits.settle_s;
  return settings;
}

const VehicleDescription& DefaultVehicle() {
  static const VehicleDescription r50 = LoadVehicle(kDefaultVehicle).value();
  return r50;
}

}  // namespace palace
