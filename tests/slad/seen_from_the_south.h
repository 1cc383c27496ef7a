// Sites of a map as a vehicle to its south is offered them.
#pragma once

#include "engine/slad/hazards/hazard_maps.h"
#include "engine/slad/sites/site_selection.h"
#include "tests/slad/worlds.h"

namespace palace::testing {

/// Vehicle south of the map, on a 45 degree slope to its middle.
inline SiteContext Context() {
  SiteContext context;
  context.p_WB = {-15, 0, -15};
  context.X_WC = {CameraRotationFromTilt(Rad(-45)), context.p_WB};
  context.camera = ThesisCamera();
  return context;
}

inline SiteSelection Select(const ElevationMap& map, const SladSettings& settings = {},
                            const SiteContext& context = Context()) {
  return SelectSites(map, EvaluateHazards(map, settings), settings, context);
}

}  // namespace palace::testing
