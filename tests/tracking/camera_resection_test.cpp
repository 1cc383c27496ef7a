#include "engine/tracking/camera_resection.h"

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/tracking/view_geometry.h"

namespace palace {
namespace {

const PinholeCamera kCamera{640, 480, 772.548, 772.548, 319.5, 239.5};

Eigen::Vector3d RandomVector(RandomStream& random, double sigma) {
  return {sigma * random.Normal(), sigma * random.Normal(), sigma * random.Normal()};
}

Eigen::Matrix3d Turn(const Eigen::Vector3d& v) {
  return Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix();
}

/// A camera above level ground, and what it sees of it.
struct View {
  RigidTransform X_WC;
  std::vector<GroundLandmark> landmarks;
};

View RandomView(RandomStream& random, int count, double sigma_px) {
  View view;
  const EulerAngles attitude{random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3),
                             random.Uniform(-3.1, 3.1)};
  const double tilt_rad = Rad(random.Uniform(-75, -45));
  view.X_WC.R = RotationFromEuler(attitude) * CameraRotationFromTilt(tilt_rad);
  view.X_WC.p = {random.Uniform(-50, 50), random.Uniform(-50, 50), random.Uniform(-30, -2)};
  const GroundPlane plane{Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ()};
  while (static_cast<int>(view.landmarks.size()) < count) {
    const Eigen::Vector2d pixel(random.Uniform(0, 639), random.Uniform(0, 479));
    const auto depth_m = PlaneDepth(kCamera, view.X_WC, plane, pixel);
    if (!depth_m) {
      continue;
    }
    const Eigen::Vector3d p_WF = view.X_WC * (*depth_m * RayFromPixel(kCamera, pixel));
    const Eigen::Vector2d noise(sigma_px * random.Normal(), sigma_px * random.Normal());
    view.landmarks.push_back({p_WF, pixel + noise, std::max(sigma_px, 0.3), 0});
  }
  return view;
}

TEST(CameraResection, ReturnsTheExactPoseWithoutNoise) {
  const std::uint64_t seed = 4711;
  SCOPED_TRACE(seed);
  RandomStream random(seed);
  for (int i = 0; i < 200; ++i) {
    const View view = RandomView(random, 4 + random.Index(60), 0);
    const auto found = ResectCamera(view.landmarks, kCamera, view.X_WC.R);
    ASSERT_TRUE(found.ok()) << i << ": " << found.error().message;
    EXPECT_LT((found->X_WC.p - view.X_WC.p).norm(), 1e-9) << i;
    EXPECT_LT((found->X_WC.R - view.X_WC.R).norm(), 1e-9) << i;
    EXPECT_LT(found->rms_px, 1e-8) << i;
    EXPECT_EQ(found->inliers, static_cast<int>(view.landmarks.size()));
  }
}

TEST(CameraResection, CorrectsAWrongAttitudeWhenThePriorIsLoose) {
  RandomStream random(12);
  for (int i = 0; i < 100; ++i) {
    const View view = RandomView(random, 40, 0);
    const Eigen::Matrix3d R_prior = view.X_WC.R * Turn(RandomVector(random, Rad(1.0)));
    const auto found = ResectCamera(view.landmarks, kCamera, R_prior, {Rad(1e4), 30});
    ASSERT_TRUE(found.ok()) << i;
    EXPECT_LT((found->X_WC.p - view.X_WC.p).norm(), 1e-6) << i;
    EXPECT_LT((found->X_WC.R - view.X_WC.R).norm(), 1e-7) << i;
  }
}

TEST(CameraResection, KeepsTheAttitudeWhenItsSigmaIsZero) {
  RandomStream random(13);
  const View view = RandomView(random, 40, 0.5);
  const auto found = ResectCamera(view.landmarks, kCamera, view.X_WC.R, {0.0, 12});
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(found->X_WC.R, view.X_WC.R);
  EXPECT_LT((found->X_WC.p - view.X_WC.p).norm(), 0.05);
}

// The mean of e' P^-1 e over many trials is 3 when P tells the truth.
TEST(CameraResection, ErrorAgreesWithItsCovariance) {
  RandomStream random(99);
  double sum = 0;
  const int trials = 400;
  for (int i = 0; i < trials; ++i) {
    const View view = RandomView(random, 60, 0.5);
    const Eigen::Matrix3d R_prior = view.X_WC.R * Turn(RandomVector(random, Rad(0.3)));
    const auto found = ResectCamera(view.landmarks, kCamera, R_prior);
    ASSERT_TRUE(found.ok());
    const Eigen::Vector3d error = found->X_WC.p - view.X_WC.p;
    sum += error.dot(found->covariance_m2.ldlt().solve(error));
  }
  EXPECT_GT(sum / trials, 2.3);
  EXPECT_LT(sum / trials, 3.5);
}

TEST(CameraResection, LeavesOutAThirdOfFalseLandmarks) {
  RandomStream random(5);
  for (int i = 0; i < 50; ++i) {
    View view = RandomView(random, 60, 0.3);
    for (std::size_t k = 0; k < 20; ++k) {
      view.landmarks[k].pixel += Eigen::Vector2d(random.Uniform(20, 60), random.Uniform(20, 60));
    }
    const auto found = ResectCamera(view.landmarks, kCamera, view.X_WC.R);
    ASSERT_TRUE(found.ok()) << i;
    EXPECT_LT((found->X_WC.p - view.X_WC.p).norm(), 0.004 * -view.X_WC.p.z() + 0.002) << i;
    for (std::size_t k = 0; k < 20; ++k) {
      EXPECT_FALSE(found->inlier[k]) << i << ' ' << k;
    }
    EXPECT_GE(found->inliers, 36);
  }
}

TEST(CameraResection, RefusesWhatDoesNotFixThePosition) {
  RandomStream random(6);
  View view = RandomView(random, 3, 0);
  EXPECT_FALSE(ResectCamera(view.landmarks, kCamera, view.X_WC.R).ok());
  view = RandomView(random, 1, 0);
  const std::vector<GroundLandmark> same(8, view.landmarks.front());
  EXPECT_FALSE(ResectCamera(same, kCamera, view.X_WC.R).ok());
  view = RandomView(random, 10, 0);
  view.landmarks[2].pixel.x() = NAN;
  EXPECT_FALSE(ResectCamera(view.landmarks, kCamera, view.X_WC.R).ok());
}

TEST(ViewGeometry, HomographyMovesPixelsOfThePlane) {
  RandomStream random(31);
  for (int i = 0; i < 100; ++i) {
    const View view = RandomView(random, 20, 0);
    const GroundPlane plane{Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ()};
    RigidTransform X_WB = view.X_WC;
    X_WB.p += RandomVector(random, 0.3);
    X_WB.R = X_WB.R * Turn(RandomVector(random, 0.05));
    const auto b_from_a = PlaneHomography(kCamera, view.X_WC, X_WB, plane);
    ASSERT_TRUE(b_from_a);
    for (const GroundLandmark& landmark : view.landmarks) {
      const auto seen = PixelFromWorldPoint(kCamera, X_WB, landmark.p_WF);
      ASSERT_TRUE(seen);
      EXPECT_LT((MapPixel(*b_from_a, landmark.pixel) - *seen).norm(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace palace
