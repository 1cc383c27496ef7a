#include "engine/world/sun_position.h"

#include <cmath>
#include <cstdio>

namespace palace {
namespace {

int DaysOf(int year, int month) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return kDays[month - 1] + (month == 2 && year % 4 == 0 ? 1 : 0);  // 1901 .. 2099
}

/// The Julian day (Meeus 7.1, Gregorian calendar) less that of 1970-01-01.
int DaysSince1970(const UtcMoment& utc) {
  const int y = utc.month <= 2 ? utc.year - 1 : utc.year;
  const int m = utc.month <= 2 ? utc.month + 12 : utc.month;
  const int century = y / 100;
  return static_cast<int>(std::floor(365.25 * (y + 4716)) + std::floor(30.6001 * (m + 1))) +
         utc.day + 2 - century + century / 4 - 1524 - 2440588;
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

SunDirection SunAt(const UtcMoment& utc, double latitude_rad, double longitude_rad) {
  const double seconds =
      DaysSince1970(utc) * 86400.0 + (utc.hour * 60 + utc.minute) * 60 + utc.second;
  return SunAt(AddSeconds({}, seconds), latitude_rad, longitude_rad);
}

}  // namespace palace
