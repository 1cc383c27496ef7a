#include "engine/navigation/landmark_frame.h"

#include <algorithm>
#include <cmath>

#include "engine/core/rotation_vector.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMostSigmas = 3;
constexpr double kLeastSigma_rad = 1e-5;  // of the attitude that landmarks show

}  // namespace

void LandmarkFrame::Turns::Take(const Eigen::MatrixXd& H, const Eigen::VectorXd& y,
                                double variance) {
  const Eigen::MatrixXd S =
      H * P * H.transpose() + variance * Eigen::MatrixXd::Identity(y.size(), y.size());
  const Eigen::LDLT<Eigen::MatrixXd> solver(S);
  Eigen::VectorXd off = y - H * x;
  const double sigmas = std::sqrt(off.dot(solver.solve(off)) / static_cast<double>(y.size()));
  if (sigmas > kMostSigmas) {
    off *= kMostSigmas / sigmas;
  }
  const Eigen::MatrixXd K = solver.solve(H * P).transpose();
  x += K * off;
  P -= K * H * P;
  P = 0.5 * (P + P.transpose()).eval();
}

void LandmarkFrame::Place(const ToldAttitude& told, const AttitudeErrors& errors) {
  placed_ = true;
  placed_from_W_ = told.X_WC_resected.p;
  const double bias2 = errors.bias_rad * errors.bias_rad;
  seen_.P.block<3, 3>(0, 0) = errors.noise_rad * errors.noise_rad * Matrix3d::Identity();
  seen_.P.block<3, 3>(3, 3) = seen_.P.block<3, 3>(6, 6) = bias2 * Matrix3d::Identity();
  seen_.P.block<3, 3>(3, 6) = bias2 * told.R_WB;
  seen_.P.block<3, 3>(6, 3) = bias2 * told.R_WB.transpose();
}

void LandmarkFrame::Wander(double seconds, const AttitudeErrors& errors) {
  const double decay = std::exp(-std::max(seconds, 0.0) / errors.bias_time_s);
  seen_.x.tail<3>() *= decay;
  seen_.P.rightCols<3>() *= decay;
  seen_.P.bottomRows<3>() *= decay;
  seen_.P.bottomRightCorner<3, 3>() +=
      errors.bias_rad * errors.bias_rad * (1 - decay * decay) * Matrix3d::Identity();
}

void LandmarkFrame::Add(const ToldAttitude& told, const AttitudeErrors& errors) {
  if (!placed_) {
    Place(told, errors);
  } else {
    Wander(SecondsBetween(time_, told.time), errors);
    Eigen::Matrix<double, 3, 9> H;
    H << -Matrix3d::Identity(), -Matrix3d::Identity(), told.R_WB;
    seen_.Take(H, VectorFromRotation(told.R_WC * told.X_WC_resected.R.transpose()),
               errors.noise_rad * errors.noise_rad + kLeastSigma_rad * kLeastSigma_rad);
  }
  time_ = std::max(time_, told.time);
  told_ = seen_;
  if (told.felt) {
    // R_WB (f_B - bias) + g_W is the acceleration: a tilt t shows as a bias of -t x g_W.
    const double g = kStandardGravity_mps2;
    const Eigen::Vector2d tilt(told.felt->accel_W_mps2.y() / g, -told.felt->accel_W_mps2.x() / g);
    Eigen::Matrix<double, 2, 9> H = Eigen::Matrix<double, 2, 9>::Zero();
    H.rightCols<3>() = told.R_WB.topRows<2>();
    const double sigma_rad = std::hypot(errors.accel_bias_mps2, told.felt->sigma_mps2) / g;
    told_.Take(H, tilt, sigma_rad * sigma_rad + kLeastSigma_rad * kLeastSigma_rad);
  }
}

RigidTransform LandmarkFrame::Levelled(const RigidTransform& X_W, const Vector3d& p_WS) const {
  const Matrix3d R_n = RotationFromVector(-told_.x.head<3>());
  const Matrix3d R_b = RotationFromVector(-told_.x.segment<3>(3));
  const Vector3d& centre_W = placed_from_W_;
  Vector3d p_W = centre_W + R_n * (X_W.p - centre_W);
  p_W.z() += p_WS.z() - (centre_W + R_n * (p_WS - centre_W)).z();
  return {R_b * R_n * X_W.R, p_WS + R_b * (p_W - p_WS)};
}

}  // namespace palace
