#include "engine/core/rotation_vector.h"

#include <numbers>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(RotationVector, GoesThereAndBack) {
  RandomStream random(1);
  for (int i = 0; i < 200; ++i) {
    const Vector3d axis = Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
    const Vector3d v = random.Uniform(1e-9, std::numbers::pi - 1e-6) * axis;
    const Matrix3d R = RotationFromVector(v);
    EXPECT_LT((R * R.transpose() - Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_LT((R * axis - axis).norm(), 1e-14);
    EXPECT_LT((VectorFromRotation(R) - v).norm(), 1e-6 + 1e-8 / (std::numbers::pi - v.norm()));
  }
}

TEST(RotationVector, OfASmallTurnIsTheCrossProduct) {
  const Vector3d v(1e-7, -2e-7, 3e-7), p(4, 5, 6);
  EXPECT_LT((RotationFromVector(v) * p - p - v.cross(p)).norm(), 1e-12);
  EXPECT_LT((CrossMatrix(v) * p - v.cross(p)).norm(), 1e-20);
  EXPECT_EQ(RotationFromVector(Vector3d::Zero()), Matrix3d(Matrix3d::Identity()));
  EXPECT_EQ(VectorFromRotation(Matrix3d::Identity()), Vector3d(Vector3d::Zero()));
}

}  // namespace
}  // namespace palace
