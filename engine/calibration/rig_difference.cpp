#include "engine/calibration/rig_difference.h"

namespace palace {

RigEstimate RigFromModels(const CahvorModel& left, const CahvorModel& right) {
  RigEstimate rig;
  RigidTransform X_FC0, X_FC1;
  rig.lens = {LensFromCahvor(left, X_FC0), LensFromCahvor(right, X_FC1)};
  rig.X_C0C1 = X_FC0.Inverse() * X_FC1;
  return rig;
}

CameraVector RigDifference(const RigEstimate& a, const RigEstimate& b) {
  const Eigen::AngleAxisd turn(b.X_C0C1.R.transpose() * a.X_C0C1.R);
  CameraVector difference;
  difference << a.lens[0] - b.lens[0], a.lens[1] - b.lens[1], turn.angle() * turn.axis(),
      a.X_C0C1.p - b.X_C0C1.p;
  return difference;
}

}  // namespace palace
