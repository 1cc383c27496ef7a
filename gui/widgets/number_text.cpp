#include "gui/widgets/number_text.h"

#include <cmath>
#include <cstdio>

#include "engine/core/text.h"
#include "engine/core/units.h"

namespace palace {

std::string Fixed(double value, int decimals) {
  if (!std::isfinite(value)) {
    return "––";
  }
  char digits[64];
  std::snprintf(digits, sizeof digits, "%.*f", decimals, std::abs(value));
  std::string text = digits;
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  const std::size_t point = text.find('.');
  const std::size_t whole = point == std::string::npos ? text.size() : point;
  for (std::size_t at = whole; at > 3; at -= 3) {
    text.insert(at - 3, 1, ' ');
  }
  return value < 0 && !zero ? std::string("−").append(text) : text;
}

int DecimalsOf(double value, int least) {
  int decimals = least;
  double scale = std::pow(10, decimals);
  while (decimals < 3 && std::abs(value * scale - std::round(value * scale)) > 1e-6 * scale) {
    ++decimals;
    scale *= 10;
  }
  return decimals;
}

std::string FixedAgainst(double value, double limit, bool over, int decimals) {
  int shown = over ? DecimalsOf(limit, decimals) : decimals;
  while (over && shown < 3 && Fixed(value, shown) == Fixed(limit, shown)) {
    ++shown;
  }
  return Fixed(value, shown);
}

std::string Duration(double seconds) {
  if (!std::isfinite(seconds)) {
    return "––";
  }
  if (std::abs(seconds) < 10) {
    return Fixed(seconds, 1) + " s";
  }
  return std::abs(seconds) < 600 ? Fixed(seconds, 0) + " s" : Fixed(seconds / 60, 0) + " min";
}

std::string ClockText(Timestamp time) {
  return LengthText(std::fmod(static_cast<double>(time.us / 1'000'000), 86400.0));
}

std::string LengthText(double seconds) {
  const long total = std::isfinite(seconds) && seconds > 0 ? static_cast<long>(seconds) : 0;
  char text[48];
  std::snprintf(text, sizeof text, "%02ld:%02ld:%02ld", total / 3600, total / 60 % 60, total % 60);
  return text;
}

std::string AgeText(double age_s) {
  if (!std::isfinite(age_s)) {
    return "never";
  }
  return age_s < 0.25 ? Fixed(age_s * 1000, 0) + " ms" : Fixed(age_s, 1) + " s";
}

std::string HeadingText(double heading_rad) {
  if (!std::isfinite(heading_rad)) {
    return Fixed(heading_rad, 0) + "°";
  }
  const long degrees = std::lround(Deg(heading_rad)) % 360;
  return WithNumbers("%03.0f°", static_cast<double>(degrees < 0 ? degrees + 360 : degrees));
}

}  // namespace palace
