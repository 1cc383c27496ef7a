#include "engine/model/size_words.h"

#include <cmath>

#include "engine/core/text.h"

namespace palace {

double KnownBelow(const Figure& size) {
  const bool lost_in_noise = size.three_sigma > 0 && size.value <= size.three_sigma;
  return lost_in_noise ? size.value + size.three_sigma : NAN;
}

double KnownBelow(const LimitRow& row) {
  const bool is_size =
      row.id == LimitId::kSlope || row.id == LimitId::kRoughness || row.id == LimitId::kStep;
  return is_size ? KnownBelow(Figure{row.value, row.three_sigma}) : NAN;
}

std::string SizeWords(const Figure& size, double factor, const char* unit, int decimals) {
  const double below = KnownBelow(size);
  const double told = std::isnan(below) ? size.value : below;
  if (!std::isfinite(told)) {
    return "––";
  }
  return (std::isnan(below) ? "" : "under ") +
         WithNumbers(("%." + std::to_string(decimals) + "f").c_str(), told * factor) + unit;
}

}  // namespace palace
