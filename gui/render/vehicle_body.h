// What a vehicle looks like where it is drawn.
#pragma once

#include <cstdint>

namespace palace {

/// One large rotor over a fuselage with a tail, or four small ones at the ends of arms in an X.
enum class VehicleBody : std::uint8_t { kHelicopter, kMultirotor };

}  // namespace palace
