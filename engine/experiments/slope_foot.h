// Where a vehicle's glide slope ends that goes down the axis of its left camera: the place of
// experiments that keep what they land on in the middle of the picture.
#pragma once

#include "engine/core/result.h"
#include "engine/simulation/vehicle_description.h"

namespace palace {

/// The point of the ground, which is at height 0, that the axis of the left camera meets from B at
/// p_WB, level and heading north. Error: cameras that look flatter than the vehicle flies down.
Result<Eigen::Vector3d> SlopeFoot(const VehicleDescription& vehicle, const Eigen::Vector3d& p_WB);

}  // namespace palace
