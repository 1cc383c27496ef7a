// Unit conversions for the edges of the program: files a person edits, and readouts.
// Inside, everything is SI and radians.
#pragma once

#include <numbers>

namespace palace {

inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;
inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;
inline constexpr double kMetresPerFoot = 0.3048;
inline constexpr double kStandardGravity_mps2 = 9.80665;

inline constexpr double Rad(double deg) { return deg * kRadPerDeg; }
inline constexpr double Deg(double rad) { return rad * kDegPerRad; }

}  // namespace palace
