// Where a camera stood when it took a picture, and how well that is known.
#pragma once

#include "engine/core/frames.h"
#include "engine/core/units.h"

namespace palace {

/// Errors of a pose from one picture to the next, one standard deviation of each axis: they move
/// the heights of one frame against those of another. What all poses of a flight share (an offset
/// of GPS) moves the map as a whole and is not meant here.
///
/// These are THE values of all poses whose source states none, and today no source does: no message
/// of a vehicle carries them, and what GPS and the position filter state is the error of the place,
/// not of its change between two pictures. Values: a differential GPS with an inertial unit on a
/// small helicopter.
struct PoseSigmas {
  double position_m = 0.03;
  double attitude_rad = 0.1 * kRadPerDeg;
};

struct ViewPose {
  RigidTransform X_WC;
  PoseSigmas sigmas{};
};

}  // namespace palace
