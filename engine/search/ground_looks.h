// What one look adds to the ground that was seen (model/mission/seen_ground.h).
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/model/command.h"
#include "engine/model/mission/seen_ground.h"
#include "engine/search/ground_view.h"

namespace palace {

/// Nothing was looked at yet around that place.
SeenGround NothingSeen(const Eigen::Vector2d& middle_W);

/// One map was made from there.
void AddLook(SeenGround& seen, const GroundView& view, const FlyTo& from);

/// Every square under the strip, so wide to both sides of the line, was looked at.
bool IsLookedAt(const SeenGround& seen, const Eigen::Vector2d& from_W, const Eigen::Vector2d& to_W,
                double half_width_m);

/// Squares that a hover shows, as steps from the square that it is over; it is taken to be over the
/// middle of that. Ground `below_m` under B.
std::vector<Cell> SquaresInView(const GroundView& view, double heading_rad, double below_m);

}  // namespace palace
