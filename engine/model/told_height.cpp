#include "engine/model/told_height.h"

#include <cmath>

#include "engine/core/frames.h"

namespace palace {
namespace {

using By = ToldHeight::By;

constexpr double kMoreThanAHover_mps = 0.3;
constexpr double kLaserKept_s = 3;  // a turn leans the beam beyond its range for a second or two

HistorySample Newest(const EngineSnapshot& snapshot) {
  const auto& history = snapshot.flight->history;
  return history && !history->empty() ? history->back() : HistorySample{};
}

/// The newest return of the last seconds; NaN: there was none.
double LaserLately(const EngineSnapshot& snapshot) {
  const auto& history = snapshot.flight->history;
  if (!history) {
    return NAN;
  }
  for (auto sample = history->rbegin(); sample != history->rend(); ++sample) {
    if (SecondsBetween(sample->time, snapshot.time) > kLaserKept_s) {
      break;
    }
    if (std::isfinite(sample->laser_m)) {
      return sample->laser_m;
    }
  }
  return NAN;
}

}  // namespace

ToldHeight HeightTold(const EngineSnapshot& snapshot) {
  const ToldHeight estimate{By::kEstimate, snapshot.flight->mission.height_above_site_m};
  const HistorySample now = Newest(snapshot);
  for (const ToldHeight& told :
       {estimate, {By::kGps, now.gps_height_m}, {By::kLaser, now.laser_m}}) {
    if (std::isfinite(told.height_m)) {
      return told;
    }
  }
  return estimate;
}

ToldHeight HoverHeightTold(const EngineSnapshot& snapshot) {
  const double laser_m = LaserLately(snapshot);
  const auto& pose = snapshot.sensors->pose;
  if (std::isfinite(laser_m) || !pose) {
    return {By::kLaser, laser_m};
  }
  const Lander& lander = snapshot.session->settings.slad.lander;
  return {By::kPose, HeightFromDown((pose->X_WB * lander.skid_centre_B()).z())};
}

double VerticalSpeedTold(const EngineSnapshot& snapshot) {
  const double down_mps = snapshot.sensors->pose ? snapshot.sensors->pose->v_WB.z() : NAN;
  return std::abs(down_mps) >= kMoreThanAHover_mps ? down_mps : NAN;
}

}  // namespace palace
