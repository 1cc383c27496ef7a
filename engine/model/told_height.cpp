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

ToldHeight ByLaser(const HistorySample& sample, Timestamp now) {
  return {By::kLaser, sample.laser_m, SecondsBetween(sample.laser_time, now)};
}

/// By the newest return of the last seconds; unknown: there was none.
ToldHeight ByLaserLately(const EngineSnapshot& snapshot) {
  const auto& history = snapshot.flight->history;
  if (!history) {
    return {By::kLaser};
  }
  for (auto sample = history->rbegin(); sample != history->rend(); ++sample) {
    if (SecondsBetween(sample->time, snapshot.time) > kLaserKept_s) {
      break;
    }
    if (std::isfinite(sample->laser_m)) {
      return ByLaser(*sample, snapshot.time);
    }
  }
  return {By::kLaser};
}

/// Of a laser without a height.
ToldHeight::NoLaser WhyNoLaser(const EngineSnapshot& snapshot) {
  using NoLaser = ToldHeight::NoLaser;
  const ChannelHealth* laser = FindChannel(snapshot.sensors->channels, ChannelId::kLaserRange);
  if (laser == nullptr || laser->state == ChannelHealth::State::kNever) {
    return NoLaser::kNever;
  }
  return laser->state == ChannelHealth::State::kStale ? NoLaser::kSilent : NoLaser::kNoReturn;
}

}  // namespace

ToldHeight HeightTold(const EngineSnapshot& snapshot) {
  const ToldHeight estimate{By::kEstimate, snapshot.flight->mission.height_above_site_m};
  const HistorySample now = Newest(snapshot);
  for (const ToldHeight& told :
       {estimate, ToldHeight{By::kGps, now.gps_height_m}, ByLaser(now, snapshot.time)}) {
    if (std::isfinite(told.height_m)) {
      return told;
    }
  }
  return estimate;
}

ToldHeight HoverHeightTold(const EngineSnapshot& snapshot) {
  const ToldHeight by_laser = ByLaserLately(snapshot);
  const auto& pose = snapshot.sensors->pose;
  if (std::isfinite(by_laser.height_m) || !pose) {
    return by_laser;
  }
  const Lander& lander = snapshot.session->settings.slad.lander;
  return {By::kPose, HeightFromDown((pose->X_WB * lander.skid_centre_B()).z()), NAN,
          WhyNoLaser(snapshot)};
}

double VerticalSpeedTold(const EngineSnapshot& snapshot) {
  const double down_mps = snapshot.sensors->pose ? snapshot.sensors->pose->v_WB.z() : NAN;
  return std::abs(down_mps) >= kMoreThanAHover_mps ? down_mps : NAN;
}

}  // namespace palace
