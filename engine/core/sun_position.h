// Where the sun stands at a moment of UTC: over simulated worlds, and for the approach heading.
//
//   true longitude   = mean longitude + equation of the centre
//   declination      : sin d = sin(obliquity) sin(apparent longitude)
//   hour angle     H = UTC of day + equation of time + longitude - half a turn
//   azimuth          = atan2(-cos d sin H, sin d cos(latitude) - cos d sin(latitude) cos H)
//   sin(elevation)   = sin(latitude) sin d + cos(latitude) cos d cos H
//
// The direction is geometric: seen from the middle of the earth, without refraction. Air lifts the
// sun by 0.02 degrees at 40 and by half a degree at the horizon. From 1990 to 2050 it is within
// 0.016 degrees of arc of VSOP87, half of the time within 0.004 (PyEphem 4.1.4 without parallax,
// 20000 drawn moments and places). UTC is taken for terrestrial time, which costs 0.001 of them.
//
// Source: NOAA Global Monitoring Laboratory, solar calculation details (spreadsheet), after Meeus,
// Astronomical Algorithms, 2nd ed. 1998: chapter 25 (low accuracy), 13.5, 13.6 and 28.3.
#pragma once

#include <cmath>

#include "engine/core/time.h"

namespace palace {

struct SunDirection {
  double azimuth_rad = NAN;    ///< from north over east, [0, 2 pi); at a pole north is that of the
                               ///< longitude given
  double elevation_rad = NAN;  ///< of the sun's middle above the horizon, below it negative
};

/// `utc`: microseconds since 1970-01-01 00:00 UTC, without leap seconds. North and east positive.
/// Both angles are NaN where a coordinate is not finite or the latitude lies beyond a pole.
SunDirection SunAt(Timestamp utc, double latitude_rad, double longitude_rad);

}  // namespace palace
