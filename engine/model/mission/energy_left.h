// EnergyLeft: what the vehicle still has to fly with, fuel or battery.
#pragma once

#include <cmath>

namespace palace {

struct EnergyLeft {
  double share = NAN;    ///< of what it holds, 0..1, as it said last; NaN: it does not say
  double lasts_s = NAN;  ///< at the rate of late; NaN: no rate is known yet
};

}  // namespace palace
