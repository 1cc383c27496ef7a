// The hover from which a place is looked at.
#pragma once

#include <Eigen/Dense>

#include "engine/model/command.h"

namespace palace {

/// Level with p_WB and no farther back: from there cameras that look down by `slope_rad`, from 10
/// to 80 degrees, look at the place, which lies ahead. Heading along the way there. Both in W.
FlyTo HoverBefore(const Eigen::Vector3d& p_WB, const Eigen::Vector3d& place_W, double slope_rad);

}  // namespace palace
