#include "engine/simulation/calibration_session.h"

#include <cmath>
#include <numbers>
#include <string>

#include "engine/camera/cahvor.h"
#include "engine/core/check.h"
#include "engine/core/random.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kBoardShare = 0.45;      // of the picture's width, for the nearest board
constexpr double kNearestOverlap = 0.45;  // of the width: disparity of the nearest board
constexpr double kFarthest = 1.8;         // of the nearest distance
constexpr double kMostTilt_rad = Rad(40);
constexpr double kMostRoll_rad = Rad(25);
constexpr double kMargin_px = 10;
constexpr int kTries = 20000;

Eigen::Matrix3d SmallRotation(RandomStream& random, double most_rad) {
  const Eigen::Vector3d v(random.Uniform(-most_rad, most_rad), random.Uniform(-most_rad, most_rad),
                          random.Uniform(-most_rad, most_rad));
  return Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix();
}

CahvorModel RandomCamera(RandomStream& random, double focal_px, const RigidTransform& X_FC) {
  const PinholeCamera pinhole{kWidth,
                              kHeight,
                              focal_px * random.Uniform(0.995, 1.005),
                              focal_px * random.Uniform(0.995, 1.005),
                              (kWidth - 1) / 2.0 + random.Uniform(-12, 12),
                              (kHeight - 1) / 2.0 + random.Uniform(-12, 12)};
  CahvorModel model = CahvFromPinhole(pinhole, X_FC.R.transpose(), X_FC.p);
  const Eigen::Vector3d O(random.Uniform(-0.01, 0.01), random.Uniform(-0.01, 0.01), 1);
  model.O = X_FC.R * O.normalized();
  model.R = {0, random.Uniform(-0.25, -0.05), random.Uniform(0, 0.1)};
  return model;
}

bool WhollyInPicture(const CalibrationTarget& target, const CahvorModel& camera,
                     const RigidTransform& X_FT) {
  for (const int column : {-1, target.columns}) {
    for (const int row : {-1, target.rows}) {
      const Eigen::Vector3d p_T(target.pitch_m * column, target.pitch_m * row, 0);
      const auto at = ProjectCahvor(camera, X_FT * p_T);
      if (!at || !(at->x() > kMargin_px && at->y() > kMargin_px &&
                   at->x() < camera.width - kMargin_px && at->y() < camera.height - kMargin_px)) {
        return false;
      }
    }
  }
  return true;
}

RigidTransform RandomPose(RandomStream& random, const CalibrationTarget& target, double nearest_m,
                          double focal_px, bool tilted) {
  const double turn = random.Uniform(0, 2 * std::numbers::pi);
  const double tilt = tilted ? random.Uniform(Rad(15), kMostTilt_rad) : random.Uniform(0, Rad(5));
  const Eigen::Vector3d axis(std::cos(turn), std::sin(turn), 0);
  RigidTransform X_FT;
  X_FT.R =
      Eigen::AngleAxisd(tilt, axis).toRotationMatrix() *
      Eigen::AngleAxisd(random.Uniform(-kMostRoll_rad, kMostRoll_rad), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  const double depth_m = nearest_m * random.Uniform(1, kFarthest);
  const Eigen::Vector3d middle_C(depth_m * random.Uniform(-0.5, 0.5) * kWidth / focal_px,
                                 depth_m * random.Uniform(-0.5, 0.5) * kHeight / focal_px, depth_m);
  X_FT.p = middle_C - X_FT.R * ((target.p_TQ(0) + target.p_TQ(target.point_count() - 1)) / 2);
  return X_FT;
}

}  // namespace

CalibrationSession MakeCalibrationSession(std::uint64_t seed, int views) {
  PALACE_CHECK(views > 0, views);
  RandomStream random(seed, "calibration session");
  CalibrationSession session;
  const double focal_px = random.Uniform(560, 1080);
  const double baseline_m = random.Uniform(0.2, 1.2);
  RigidTransform X_FC1;
  X_FC1.R = SmallRotation(random, Rad(1));
  X_FC1.p = {baseline_m, baseline_m * random.Uniform(-0.02, 0.02),
             baseline_m * random.Uniform(-0.02, 0.02)};
  session.left = RandomCamera(random, focal_px, RigidTransform{});
  session.right = RandomCamera(random, focal_px, X_FC1);
  const double nearest_m = baseline_m * focal_px / (kNearestOverlap * kWidth);
  session.target.columns = 13;
  session.target.rows = 10;
  session.target.pitch_m = kBoardShare * kWidth / 13 * nearest_m / focal_px;
  session.target.dot_diameter_m = session.target.pitch_m / 2;
  session.look.blur_sigma_px = random.Uniform(0.5, 1.0);
  session.look.noise_sigma = random.Uniform(1, 3);
  session.look.light_right = random.Uniform(-0.2, 0.2);
  session.look.light_down = random.Uniform(-0.2, 0.2);
  session.look.vignetting = random.Uniform(0, 0.2);
  for (int tries = 0; static_cast<int>(session.X_FT.size()) < views; ++tries) {
    PALACE_CHECK(tries < kTries, seed, views);
    const bool tilted = session.X_FT.size() % 8 != 0;
    const RigidTransform X_FT = RandomPose(random, session.target, nearest_m, focal_px, tilted);
    if (WhollyInPicture(session.target, session.left, X_FT) &&
        WhollyInPicture(session.target, session.right, X_FT)) {
      session.X_FT.push_back(X_FT);
    }
  }
  return session;
}

ImageU8 RenderSessionView(const CalibrationSession& session, std::uint64_t seed, int view,
                          int side) {
  RandomStream noise(seed, "picture " + std::to_string(view) + (side == 0 ? " left" : " right"));
  return RenderTarget(session.target, side == 0 ? session.left : session.right,
                      session.X_FT[static_cast<std::size_t>(view)], session.look, noise);
}

}  // namespace palace
