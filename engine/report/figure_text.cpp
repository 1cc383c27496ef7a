#include "engine/report/figure_text.h"

#include "engine/core/text.h"
#include "engine/report/statistics.h"

namespace palace {
namespace {

std::string Decimals(int decimals) { return "%." + std::to_string(decimals) + "f"; }

}  // namespace

std::string ShareText(int hits, int trials, int decimals) {
  if (trials <= 0) {
    return "-";
  }
  const Interval interval = WilsonInterval(hits, trials);
  const std::string number = Decimals(decimals);
  return std::to_string(hits) + " of " + std::to_string(trials) +
         WithNumbers((" (" + number + " to " + number + " %%)").c_str(), 100 * interval.low,
                     100 * interval.high);
}

std::string MedianAndWorst(std::span<const double> values, int decimals) {
  const std::string number = Decimals(decimals);
  return OrDash(number.c_str(), Percentile(values, 0.5)) + " / " +
         OrDash(number.c_str(), SpreadOf(values).max);
}

}  // namespace palace
