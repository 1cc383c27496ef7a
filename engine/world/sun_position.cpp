#include "engine/world/sun_position.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kJulianCentury_days = 36525;
constexpr double kJ2000_days = 2451545;  // Julian day of 2000-01-01 12:00

int DaysOf(int year, int month) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return kDays[month - 1] + (month == 2 && year % 4 == 0 ? 1 : 0);  // 1901 .. 2099
}

double DayShare(const UtcMoment& utc) {
  return (utc.hour + (utc.minute + utc.second / 60) / 60) / 24;
}

/// Meeus 7.1, Gregorian calendar.
double JulianDay(const UtcMoment& utc) {
  const int y = utc.month <= 2 ? utc.year - 1 : utc.year;
  const int m = utc.month <= 2 ? utc.month + 12 : utc.month;
  const int century = y / 100;
  return std::floor(365.25 * (y + 4716)) + std::floor(30.6001 * (m + 1)) + utc.day + 2 - century +
         century / 4 - 1524.5 + DayShare(utc);
}

}  // namespace

std::optional<UtcMoment> ParseUtc(const std::string& text) {
  UtcMoment utc;
  int second = 0, read = 0;
  const int fields = std::sscanf(text.c_str(), "%4d-%2d-%2d %2d:%2d:%2d%n", &utc.year, &utc.month,
                                 &utc.day, &utc.hour, &utc.minute, &second, &read);
  utc.second = second;
  const auto within = [](int value, int least, int most) {
    return value >= least && value <= most;
  };
  const bool whole = fields == 6 && static_cast<std::size_t>(read) == text.size() &&
                     within(utc.year, 1901, 2099) && within(utc.month, 1, 12) &&
                     within(utc.day, 1, DaysOf(utc.year, utc.month)) && within(utc.hour, 0, 23) &&
                     within(utc.minute, 0, 59) && within(second, 0, 59);
  return whole ? std::optional(utc) : std::nullopt;
}

SunPosition SunPositionAt(const UtcMoment& utc, double latitude_rad, double longitude_rad) {
  const double T = (JulianDay(utc) - kJ2000_days) / kJulianCentury_days;
  const double L = Rad(std::fmod(280.46646 + T * (36000.76983 + T * 0.0003032), 360));
  const double M = Rad(357.52911 + T * (35999.05029 - 0.0001537 * T));
  const double e = 0.016708634 - T * (0.000042037 + 0.0000001267 * T);
  const double centre =
      Rad(std::sin(M) * (1.914602 - T * (0.004817 + 0.000014 * T)) +
          std::sin(2 * M) * (0.019993 - 0.000101 * T) + std::sin(3 * M) * 0.000289);
  const double node = Rad(125.04 - 1934.136 * T);
  const double longitude = L + centre - Rad(0.00569 + 0.00478 * std::sin(node));
  const double mean_obliquity =
      23 + (26 + (21.448 - T * (46.815 + T * (0.00059 - T * 0.001813))) / 60) / 60;
  const double obliquity = Rad(mean_obliquity + 0.00256 * std::cos(node));
  const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));
  // Equation of time, as an angle.
  const double y = std::tan(obliquity / 2) * std::tan(obliquity / 2);
  const double ahead = y * std::sin(2 * L) - 2 * e * std::sin(M) +
                       4 * e * y * std::sin(M) * std::cos(2 * L) - 0.5 * y * y * std::sin(4 * L) -
                       1.25 * e * e * std::sin(2 * M);
  constexpr double kTurn = 2 * std::numbers::pi;
  const double hour_angle = kTurn * DayShare(utc) + ahead + longitude_rad - std::numbers::pi;
  SunPosition sun;
  sun.elevation_rad = std::asin(
      std::clamp(std::sin(latitude_rad) * std::sin(declination) +
                     std::cos(latitude_rad) * std::cos(declination) * std::cos(hour_angle),
                 -1.0, 1.0));
  const double east = -std::cos(declination) * std::sin(hour_angle);
  const double north = std::sin(declination) * std::cos(latitude_rad) -
                       std::cos(declination) * std::sin(latitude_rad) * std::cos(hour_angle);
  sun.azimuth_rad = std::atan2(east, north);
  sun.azimuth_rad += sun.azimuth_rad < 0 ? kTurn : 0;
  return sun;
}

}  // namespace palace
