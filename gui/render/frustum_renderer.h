// Lines of the 3-D view: frustum and its footprint, drop line, paths and site rings.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "gui/render/line_batch.h"
#include "gui/render/view3d_renderer.h"

namespace palace {

/// Where the corner rays of a picture meet the level ground, in order round the picture. A ray that
/// meets it beyond 80 m, or not at all, ends there.
std::vector<Eigen::Vector3d> FrustumFootprint(const PinholeCamera& camera,
                                              const RigidTransform& X_WC, double ground_height_m);

/// Grid of 5 m round a point, fading outwards.
void AddGroundGrid(LineBatch& batch, const Eigen::Vector3d& centre_W, double ui_scale);
/// Edges grey with faces filled 10 %, footprint white.
void AddFrustum(LineBatch& batch, const View3dInput& input, double ground_height_m);
/// Dashed line from the skids to the ground with its ticks; returns the labels.
std::vector<View3dLabel> AddDropLine(LineBatch& batch, const View3dInput& input,
                                     double ground_height_m, double vehicle_size);
/// Trail, planned path and rings of all sites.
void AddPaths(LineBatch& batch, const View3dInput& input);
void AddSites(LineBatch& batch, const View3dInput& input);

}  // namespace palace
