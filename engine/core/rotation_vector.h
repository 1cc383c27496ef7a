// Rotation vectors: the axis of a turn, as long as its angle in radians.
//
//   R = exp([v]x),  v = log(R),  |v| <= pi
#pragma once

#include <Eigen/Dense>

namespace palace {

/// [v]x: [v]x p is the cross product of v and p.
Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v);
/// exp([v]x); the identity for a turn of less than 1e-15 rad.
Eigen::Matrix3d RotationFromVector(const Eigen::Vector3d& v);
/// Inverse of RotationFromVector; a turn by pi about either end of its axis.
Eigen::Vector3d VectorFromRotation(const Eigen::Matrix3d& R);

}  // namespace palace
