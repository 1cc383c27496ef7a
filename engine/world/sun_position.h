// Where the sun stands, by date, time (UTC) and place.
//
// NOAA's long form (Meeus, Astronomical Algorithms, low precision): geometric mean longitude and
// anomaly, equation of the centre, apparent longitude, obliquity and the equation of time, in
// Julian centuries of UTC. Within 0.003 degrees in azimuth and, without refraction, in elevation
// of NREL's SPA in its published case (2003-10-17 19:30:30 UTC, 39.7425 N 105.1786 W); refraction
// is left out: it lifts the sun by 0.02 degrees at 40 and by half a degree at the horizon.
// Source: NOAA Global Monitoring Laboratory, Solar Calculation Details (spreadsheet).
#pragma once

#include <optional>
#include <string>

namespace palace {

/// A moment in Universal Time.
struct UtcMoment {
  int year = 2000;
  int month = 1;
  int day = 1;
  int hour = 0;
  int minute = 0;
  double second = 0;
};

/// "2003-10-17 19:30:30"; nothing for another form, a day or a time that there is not, and for
/// years outside 1901 .. 2099.
std::optional<UtcMoment> ParseUtc(const std::string& text);

struct SunPosition {
  double azimuth_rad = 0;    ///< from north over east, 0 .. 2 pi
  double elevation_rad = 0;  ///< of its middle above the horizon, without refraction
};

/// North and east positive.
SunPosition SunPositionAt(const UtcMoment& utc, double latitude_rad, double longitude_rad);

}  // namespace palace
