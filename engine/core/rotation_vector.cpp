#include "engine/core/rotation_vector.h"

namespace palace {

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Matrix3d RotationFromVector(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  return angle < 1e-15 ? Eigen::Matrix3d::Identity()
                       : Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
}

Eigen::Vector3d VectorFromRotation(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

}  // namespace palace
