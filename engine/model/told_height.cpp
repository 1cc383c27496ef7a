#include "engine/model/told_height.h"

#include <cmath>

#include "engine/core/frames.h"

namespace palace {
namespace {

using By = ToldHeight::By;

constexpr double kMoreThanAHover_mps = 0.3;

HistorySample Newest(const EngineSnapshot& snapshot) {
  const auto& history = snapshot.flight->history;
  return history && !history->empty() ? history->back() : HistorySample{};
}

}  // namespace

ToldHeight HeightTold(const EngineSnapshot& snapshot) {
  const ToldHeight estimate{By::kEstimate, snapshot.flight->mission.height_above_site_m};
  const HistorySample now = Newest(snapshot);
  for (const ToldHeight& told : {estimate, {By::kGps, now.gps_height_m}, {By::kLaser, now.laser_m}}) {
    if (std::isfinite(told.height_m)) {
      return told;
    }
  }
  return estimate;
}

ToldHeight HoverHeightTold(const EngineSnapshot& snapshot) {
  const double laser_m = Newest(snapshot).laser_m;
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
