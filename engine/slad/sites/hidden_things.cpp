#include "engine/slad/sites/hidden_things.h"

#include <algorithm>
#include <cmath>

namespace palace {
namespace {

constexpr double kThingsPer_m2 = 0.04;  // rocks and holes together
constexpr double kOverLimit = 1.2;      // of the limit: what counts as unsafe
constexpr double kMostLogRatio = 30;

double Hides(double prior, double shown_m, double expected_m, double sigma_m) {
  const double log_ratio = expected_m * (2 * shown_m - expected_m) / (2 * sigma_m * sigma_m);
  const double odds = prior * std::exp(std::min(log_ratio, kMostLogRatio));
  return odds / (1 + odds);
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
      const double shows_m =
          kOverLimit * max_deviation_m * static_cast<double>(map.narrow.share.at(cell));
      expected +=
          Hides(prior, shown_m, shows_m, sigma_m) + Hides(prior, -shown_m, shows_m, sigma_m);
    }
  }
  return expected;
}

}  // namespace palace
