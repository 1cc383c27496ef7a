// What the 3-D view shows of a snapshot.
#pragma once

#include "engine/model/snapshot.h"
#include "gui/render/orbit_camera.h"
#include "gui/render/view3d_renderer.h"

namespace palace {

/// `highlighted` is the site whose ring is drawn when none is armed; 0: the best one that is not
/// refused.
View3dInput MakeView3dInput(const EngineSnapshot& snapshot, std::uint64_t highlighted,
                            double ui_scale);
/// Keeps vehicle, map and site in view.
void FrameView3d(const View3dInput& input, OrbitCamera& camera);

}  // namespace palace
