#include "engine/slad/sites/hidden_things.h"

#include <algorithm>
#include <cmath>

namespace palace {
namespace {

constexpr double kThingsPer_m2 = 0.04;  // rocks and holes together
constexpr double kOverLimit = 1.2;      // of the limit: what counts as unsafe
constexpr double kMostLogRatio = 30;
constexpr double kRuledOut = -3.912;  // the logarithm of one in fifty

double LogRatio(double shown_m, double expected_m, double sigma_m) {
  return expected_m * (2 * shown_m - expected_m) / (2 * sigma_m * sigma_m);
}

double Hides(double prior, double log_ratio) {
  const double odds = prior * std::exp(std::min(log_ratio, kMostLogRatio));
  return odds / (1 + odds);
}

/// What a thing would show in the cell.
double Expected(const ElevationMap& map, double max_deviation_m, Cell cell) {
  return kOverLimit * max_deviation_m * static_cast<double>(map.narrow.share.at(cell));
}

}  // namespace

double HiddenThings(const ElevationMap& map, double max_deviation_m, Cell centre, double radius_m) {
  if (map.narrow.share.empty()) {
    return 0;
  }
  const GridGeometry& g = map.geometry;
  const double prior = kThingsPer_m2 / 2 * g.cell_m * g.cell_m;
  const int reach = static_cast<int>(radius_m / g.cell_m);
  double expected = 0;
  for (int dr = -reach; dr <= reach; ++dr) {
    for (int dc = -reach; dc <= reach; ++dc) {
      const Cell cell{centre.row + dr, centre.col + dc};
      if ((dr * dr + dc * dc) * g.cell_m * g.cell_m > radius_m * radius_m) {
        continue;
      }
      const double shown_m =
          g.Contains(cell) ? static_cast<double>(map.narrow.prominence_m.at(cell)) : NAN;
      if (std::isnan(shown_m)) {
        expected += 2 * prior;
        continue;
      }
      const double sigma_m = static_cast<double>(map.narrow.sigma_m.at(cell));
      const double expected_m = Expected(map, max_deviation_m, cell);
      expected += Hides(prior, LogRatio(shown_m, expected_m, sigma_m)) +
                  Hides(prior, LogRatio(-shown_m, expected_m, sigma_m));
    }
  }
  return expected;
}

bool IsSeen(const ElevationMap& map, double max_deviation_m, Cell cell) {
  if (map.narrow.share.empty()) {
    return true;
  }
  const double shown_m = std::abs(static_cast<double>(map.narrow.prominence_m.at(cell)));
  const double sigma_m = static_cast<double>(map.narrow.sigma_m.at(cell));
  // False of NaN: nothing is known.
  return LogRatio(shown_m, Expected(map, max_deviation_m, cell), sigma_m) <= kRuledOut;
}

}  // namespace palace
