// How two numbers differ for a person who reads both.
#pragma once

namespace palace {

/// a - b of two numbers that are shown with one decimal, as a reader works it out: 3.66 - 2.64 is
/// 1.1. What reads as equal differs by what it does. NaN stays NaN.
double DifferenceAsShown(double a, double b);

}  // namespace palace
