#include "engine/core/sun_position.h"

#include <numbers>

#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;
constexpr double kDay_us = 86400e6;
constexpr double kDaysTo2000 = 10957.5;  // from 1970-01-01 00:00 to 2000-01-01 12:00
constexpr double kCentury_days = 36525;
constexpr double kPoleRounding_rad = 1e-9;

struct Equatorial {
  double declination_rad;
  double equation_of_time_rad;
};

/// Polynomials in T, Julian centuries since 2000-01-01 12:00 (Meeus 25.2 to 25.8, 22.2, 28.3).
Equatorial EquatorialAt(double T) {
  const double mean_longitude = Rad(std::fmod(280.46646 + (36000.76983 + 0.0003032 * T) * T, 360));
  const double anomaly = Rad(std::fmod(357.52911 + (35999.05029 - 0.0001537 * T) * T, 360));
  const double eccentricity = 0.016708634 - (0.000042037 + 0.0000001267 * T) * T;
  const double centre_deg = (1.914602 - (0.004817 + 0.000014 * T) * T) * std::sin(anomaly) +
                            (0.019993 - 0.000101 * T) * std::sin(2 * anomaly) +
                            0.000289 * std::sin(3 * anomaly);
  const double node = Rad(125.04 - 1934.136 * T);
  // Aberration and the larger part of nutation.
  const double apparent = mean_longitude + Rad(centre_deg - 0.00569 - 0.00478 * std::sin(node));
  const double obliquity_arcsec = 84381.448 - (46.815 + (0.00059 - 0.001813 * T) * T) * T;
  const double obliquity = Rad(obliquity_arcsec / 3600 + 0.00256 * std::cos(node));

  const double half_tan = std::tan(obliquity / 2);
  const double y = half_tan * half_tan;
  const double ahead = y * std::sin(2 * mean_longitude) - 2 * eccentricity * std::sin(anomaly) +
                       4 * eccentricity * y * std::sin(anomaly) * std::cos(2 * mean_longitude) -
                       y * y / 2 * std::sin(4 * mean_longitude) -
                       1.25 * eccentricity * eccentricity * std::sin(2 * anomaly);
  return {std::asin(std::sin(obliquity) * std::sin(apparent)), ahead};
}

}  // namespace

SunDirection SunAt(Timestamp utc, double latitude_rad, double longitude_rad) {
  constexpr double kPole_rad = std::numbers::pi / 2 + kPoleRounding_rad;
  if (!std::isfinite(longitude_rad) || !(std::abs(latitude_rad) <= kPole_rad)) {
    return {};
  }
  const double days = static_cast<double>(utc.us) / kDay_us;
  const double day_share = days - std::floor(days);
  const Equatorial sun = EquatorialAt((days - kDaysTo2000) / kCentury_days);

  const double hour_angle = kTurn_rad * (day_share - 0.5) + sun.equation_of_time_rad +
                            std::remainder(longitude_rad, kTurn_rad);
  const double up = std::sin(latitude_rad) * std::sin(sun.declination_rad) +
                    std::cos(latitude_rad) * std::cos(sun.declination_rad) * std::cos(hour_angle);
  const double north =
      std::cos(latitude_rad) * std::sin(sun.declination_rad) -
      std::sin(latitude_rad) * std::cos(sun.declination_rad) * std::cos(hour_angle);
  const double east = -std::cos(sun.declination_rad) * std::sin(hour_angle);
  const double azimuth_rad = std::atan2(east, north);
  const double from_north_rad = azimuth_rad < 0 ? azimuth_rad + kTurn_rad : azimuth_rad;
  return {from_north_rad < kTurn_rad ? from_north_rad : 0, std::atan2(up, std::hypot(north, east))};
}

}  // namespace palace
