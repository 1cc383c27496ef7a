#include "engine/model/told_height.h"

#include <cmath>

namespace palace {

ToldHeight HeightTold(const EngineSnapshot& snapshot) {
  using By = ToldHeight::By;
  const ToldHeight estimate{By::kEstimate, snapshot.flight->mission.height_above_site_m};
  const auto& history = snapshot.flight->history;
  if (std::isfinite(estimate.height_m) || !history || history->empty()) {
    return estimate;
  }
  const HistorySample& now = history->back();
  return std::isfinite(now.gps_height_m) ? ToldHeight{By::kGps, now.gps_height_m}
         : std::isfinite(now.laser_m)    ? ToldHeight{By::kLaser, now.laser_m}
                                         : estimate;
}

}  // namespace palace
