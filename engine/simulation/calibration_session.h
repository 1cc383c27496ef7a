// A simulated calibration: a random rig of two CAHVOR cameras and the poses of a board before it.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/frames.h"
#include "engine/model/calibration_target.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"
#include "engine/simulation/target_view.h"

namespace palace {

/// F is the frame of both models: the left camera's own axes.
struct CalibrationSession {
  CalibrationTarget target;
  CahvorModel left;
  CahvorModel right;
  std::vector<RigidTransform> X_FT;
  TargetLook look;
};

/// 640 x 480, 33 to 60 degrees wide, baseline 0.2 to 1.2 m, lenses decentred, skewed (O) and
/// distorted, cameras turned by up to a degree; a 13 x 10 dot board as large as half the picture,
/// tilted by up to 40 degrees, wholly in both pictures; blur, noise, uneven light. The same seed
/// gives the same session.
CalibrationSession MakeCalibrationSession(std::uint64_t seed, int views);

/// The picture of one view. side: 0 left, 1 right. Noise differs from picture to picture.
ImageU8 RenderSessionView(const CalibrationSession& session, std::uint64_t seed, int view,
                          int side);

}  // namespace palace
