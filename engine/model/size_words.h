// Sizes (a slope, a roughness, a step) that noise alone could make of nothing: of them only what
// they are below is known, value + 3 sigma. "0.0 cm" would claim what nobody measured.
#pragma once

#include <string>

#include "engine/model/landing_site.h"
#include "engine/model/mission/limit_row.h"

namespace palace {

/// What the size is below; NaN: the value itself is known, or nothing is.
double KnownBelow(const Figure& size);
/// The same of a row; NaN for rows that are no size.
double KnownBelow(const LimitRow& row);
/// "2.6 cm"; "under 2.0 cm" where no more is known; "––". Shown as value times `factor`.
std::string SizeWords(const Figure& size, double factor, const char* unit, int decimals);

}  // namespace palace
