#include "engine/slad/hazards/site_figures.h"

#include <cmath>

#include "engine/slad/hazards/ground_classes.h"

namespace palace {
namespace {

double Known(float value) { return static_cast<double>(value); }

}  // namespace

void TakeFigures(const HazardMaps& hazards, const SladSettings& settings, Cell cell,
                 LandingSite& site) {
  const Cell worst = WorstTouchdown(hazards, settings, cell);
  site.slope_rad = {Known(hazards.slope_rad.at(worst)),
                    3 * Known(hazards.slope_sigma_rad.at(worst))};
  site.roughness_m = {Known(hazards.roughness_m.at(worst)),
                      3 * Known(hazards.roughness_sigma_m.at(worst))};
  // A step is a difference of two cells.
  site.step_m = {Known(hazards.step_m.at(worst)),
                 3 * std::sqrt(2.0) * Known(hazards.roughness_sigma_m.at(worst))};
  site.safe_distance_m = Known(hazards.safe_distance_m.at(cell));
  site.cost = Known(hazards.cost.at(cell));
  site.safe_probability = Known(hazards.safe_probability.at(worst));
  if (!hazards.hidden_things.empty()) {
    // What hides is counted around the place, not around a touchdown beside it.
    site.hidden_things = Known(hazards.hidden_things.at(cell));
    site.safe_probability *= std::exp(Known(hazards.hidden_things.at(worst)) - site.hidden_things);
  }
}

}  // namespace palace
