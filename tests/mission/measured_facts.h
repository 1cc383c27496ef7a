// What the alarms look at, in a descent in which nothing is wrong.
#pragma once

#include "engine/mission/alarms/alarms.h"

namespace palace {

/// A descent on vision where every figure is measured and nothing is wrong yet.
inline AlarmFacts AllMeasured() {
  AlarmFacts f;
  f.has_source = f.has_vehicle = f.heard_vehicle = f.on_vision = f.tracked = true;
  f.left_camera_age_s = f.right_camera_age_s = f.pose_age_s = f.link_age_s = 0;
  f.pair_age_s = f.ground_age_s = f.lost_percent = 0;
  f.gps_error_m = f.row_error_px = f.laser_mismatch_m = 0;
  f.exposure_ratio = f.exposure_factor = 1;
  f.scale_error_percent = 0;
  f.vision_outage_s = f.waiting_s = 0;
  f.max_vision_outage_s = Settings{}.mission.max_vision_outage_s;
  f.coherence = 1;
  f.min_coherence = Settings{}.tracking.min_coherence;
  f.off_path_m = f.off_centre_m = f.descent_rate_mps = f.residual_sigma = f.wind_mps = 0;
  f.max_wind_mps = Settings{}.mission.max_wind_mps;
  f.tailwind_mps = 0;
  f.max_tailwind_mps = Settings{}.mission.max_tailwind_mps;
  f.energy_min = 20;
  f.energy_reserve_min = Settings{}.mission.energy_reserve_s / 60;
  f.energy_percent = 70;
  f.nav_error_m = 0.5;
  f.beside_m = 0;
  f.most_beside_m = 0.75;
  f.max_descent_rate_mps = 1.5;
  f.max_residual_sigma = 2;
  f.state = MissionState::kDescending;
  f.letter = 'A';
  return f;
}

}  // namespace palace
