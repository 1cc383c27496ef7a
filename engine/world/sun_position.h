// Date, time (UTC) and place as world files write them; the sun there is that of core/sun_position.
#pragma once

#include <optional>
#include <string>

#include "engine/core/sun_position.h"

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

/// North and east positive.
SunDirection SunAt(const UtcMoment& utc, double latitude_rad, double longitude_rad);

}  // namespace palace
