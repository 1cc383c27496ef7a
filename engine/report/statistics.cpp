#include "engine/report/statistics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace palace {
namespace {

constexpr double kZ95 = 1.959963984540054;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::vector<double> FiniteOf(std::span<const double> values) {
  std::vector<double> finite;
  finite.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double v) { return std::isfinite(v); });
  return finite;
}

/// The 0.975 quantile of Student's t: of few degrees of freedom from the table, beyond them by the
/// expansion about the normal quantile, there right to 3e-4.
/// Source: Abramowitz & Stegun 1964, 26.7.5 and table 26.10.
double StudentT95(int degrees) {
  constexpr double kTable[] = {12.706205, 4.302653, 3.182446, 2.776445};
  if (degrees <= static_cast<int>(std::size(kTable))) {
    return kTable[degrees - 1];
  }
  const double z = kZ95, z2 = z * z, n = degrees;
  const double g1 = z * (z2 + 1) / 4;
  const double g2 = z * ((5 * z2 + 16) * z2 + 3) / 96;
  const double g3 = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
  const double g4 = z * ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
  return z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
}

}  // namespace

Interval WilsonInterval(int hits, int trials) {
  if (trials <= 0) {
    return {kNone, kNone};
  }
  const double n = trials, p = hits / n, z2 = kZ95 * kZ95;
  const double centre = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kZ95 * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n)) / (1 + z2 / n);
  return {std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

Spread SpreadOf(std::span<const double> values) {
  const std::vector<double> finite = FiniteOf(values);
  Spread spread;
  spread.count = static_cast<int>(finite.size());
  if (finite.empty()) {
    spread.mean = spread.sd = spread.rms = spread.min = spread.max = kNone;
    return spread;
  }
  const double n = static_cast<double>(finite.size());
  double sum = 0;
  double squares = 0;
  for (const double v : finite) {
    sum += v;
    squares += v * v;
  }
  spread.mean = sum / n;
  spread.rms = std::sqrt(squares / n);
  double deviations = 0;
  for (const double v : finite) {
    deviations += (v - spread.mean) * (v - spread.mean);
  }
  spread.sd = finite.size() > 1 ? std::sqrt(deviations / (n - 1)) : kNone;
  const auto [least, greatest] = std::minmax_element(finite.begin(), finite.end());
  spread.min = *least;
  spread.max = *greatest;
  return spread;
}

double Percentile(std::span<const double> values, double p) {
  std::vector<double> finite = FiniteOf(values);
  if (finite.empty()) {
    return kNone;
  }
  std::sort(finite.begin(), finite.end());
  const double place = std::clamp(p, 0.0, 1.0) * static_cast<double>(finite.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, finite.size() - 1);
  const double share = place - static_cast<double>(below);
  return finite[below] + share * (finite[above] - finite[below]);
}

Interval MeanInterval(std::span<const double> values) {
  const Spread spread = SpreadOf(values);
  if (spread.count < 2) {
    return {kNone, kNone};
  }
  const double half =
      StudentT95(spread.count - 1) * spread.sd / std::sqrt(static_cast<double>(spread.count));
  return {spread.mean - half, spread.mean + half};
}

}  // namespace palace
