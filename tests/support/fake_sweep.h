// A sweep of the roughness limit for panel tests: from 2 cm on there is a site, up to 5 cm a new
// place, then B, from 9 cm on A.
#pragma once

#include <memory>

#include "engine/model/landing_site.h"
#include "engine/model/limit_sweep.h"
#include "engine/model/snapshot.h"

namespace palace::fake {

inline std::shared_ptr<const LimitSweep> RoughnessSweep(const EngineSnapshot& snap) {
  auto sweep = std::make_shared<LimitSweep>();
  sweep->limit = "slad.max_deviation_m";
  sweep->map_time = AddSeconds(snap.time, -1.5);
  sweep->others = snap.session->preview_settings;
  for (int cm = 1; cm <= 12; ++cm) {
    SweptValue swept{.value = cm / 100.0, .safe_area_m2 = 10.0 * cm};
    if (cm >= 2) {
      swept.best_id = cm < 5 ? kFirstUnnamedSite + 1 : cm < 9 ? 2 : 1;
      swept.best = cm < 5 ? "+1" : cm < 9 ? "B" : "A";
      swept.best_clear_m = 3.4;
    }
    sweep->values.push_back(swept);
  }
  return sweep;
}

}  // namespace palace::fake
