// Figures of an experiment: shares with their intervals, spreads, percentiles.
//
// Values that are not finite do not count. An empty set gives NaN, never 0.
#pragma once

#include <span>

namespace palace {

struct Interval {
  double low = 0;
  double high = 0;
};

/// 95 % score interval of `hits` out of `trials`, as shares 0..1; NaN without trials.
/// Source: Wilson 1927.
Interval WilsonInterval(int hits, int trials);

/// Count, mean, standard deviation (n - 1), root mean square, extremes of the finite values.
struct Spread {
  int count = 0;
  double mean = 0;
  double sd = 0;
  double rms = 0;
  double min = 0;
  double max = 0;
};
Spread SpreadOf(std::span<const double> values);

/// The value below which the share p (0..1) lies, by linear interpolation between order statistics.
double Percentile(std::span<const double> values, double p);

/// 95 % interval of the mean, mean +- t sd / sqrt(n), t of Student with n - 1 degrees of freedom:
/// for values of about one normal distribution; NaN below two.
/// Source: Student 1908.
Interval MeanInterval(std::span<const double> values);

}  // namespace palace
