// Wind as a vehicle measures it.
#pragma once

namespace palace {

/// Slower, the wind comes from nowhere: its direction is that of the noise.
inline constexpr double kLeastWind_mps = 0.5;

/// False too where the speed is not known.
constexpr bool WindHasDirection(double wind_mps) { return wind_mps >= kLeastWind_mps; }

}  // namespace palace
