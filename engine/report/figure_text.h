// Figures of an experiment as a reader meets them.
#pragma once

#include <span>
#include <string>

namespace palace {

/// "9 of 10 (60 to 98 %)": a share with its 95 % interval (statistics.h); "-" without trials.
std::string ShareText(int hits, int trials, int decimals = 0);

/// "1.3 / 4.0": median and greatest of the finite values; "- / -" without one.
std::string MedianAndWorst(std::span<const double> values, int decimals);

}  // namespace palace
