#include "engine/core/shown_difference.h"

#include <cstdlib>

#include "engine/core/text.h"

namespace palace {

double DifferenceAsShown(double a, double b) {
  const auto shown = [](double value) {
    return std::strtod(WithNumbers("%.1f", value).c_str(), nullptr);
  };
  const double read = shown(a) - shown(b);
  return read != 0 ? read : a - b;
}

}  // namespace palace
