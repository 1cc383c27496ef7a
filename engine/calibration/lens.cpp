#include "engine/calibration/lens.h"

#include <cmath>

#include "engine/camera/cahvor.h"

namespace palace {
namespace {

using Row3 = Eigen::RowVector3d;

/// A distorted point p' with its derivatives.
struct Distorted {
  Eigen::Vector3d point;
  Eigen::Matrix3d by_point;
  Eigen::Matrix<double, 3, 2> by_axis;  ///< by o1, o2
  Eigen::Matrix<double, 3, 2> by_rho;
};

/// Derivatives by hand, with lambda.O = 0:
///   d zeta = O.dp + p.dO,  d lambda = dp - O (O.dp) - (O p^T + zeta I) dO,
///   d tau = (2 / zeta^2) lambda.dp - (2 tau / zeta) O.dp - (2 / zeta) (lambda + tau p).dO.
/// Checked against central differences by the tests.
std::optional<Distorted> Distort(const Lens& lens, const Eigen::Vector3d& p) {
  const Eigen::Vector3d raw(lens[kO1], lens[kO2], 1);
  const double length = raw.norm();
  const Eigen::Vector3d O = raw / length;
  const double zeta = p.dot(O);
  if (!(zeta > 0)) {
    return std::nullopt;
  }
  const Eigen::Vector3d lambda = p - zeta * O;
  const double tau = lambda.squaredNorm() / (zeta * zeta);
  const double mu = tau * (lens[kRho1] + tau * lens[kRho2]);
  const double mu_by_tau = lens[kRho1] + 2 * tau * lens[kRho2];
  // Beyond the radius where the picture of a growing angle turns back the model says nothing.
  for (const double t : {tau, -3 * lens[kRho1] / (10 * lens[kRho2])}) {
    if (t > 0 && t <= tau && !(1 + t * (3 * lens[kRho1] + 5 * lens[kRho2] * t) > 0)) {
      return std::nullopt;
    }
  }
  Distorted out;
  out.point = p + mu * lambda;
  const Row3 tau_by_point =
      (2 / (zeta * zeta)) * lambda.transpose() - (2 * tau / zeta) * O.transpose();
  out.by_point = Eigen::Matrix3d::Identity() +
                 mu * (Eigen::Matrix3d::Identity() - O * O.transpose()) +
                 (mu_by_tau * lambda) * tau_by_point;
  const Row3 tau_by_O = (-2 / zeta) * (lambda + tau * p).transpose();
  const Eigen::Matrix3d by_O = -mu * (O * p.transpose() + zeta * Eigen::Matrix3d::Identity()) +
                               (mu_by_tau * lambda) * tau_by_O;
  const Eigen::Matrix3d O_by_raw = (Eigen::Matrix3d::Identity() - O * O.transpose()) / length;
  out.by_axis = by_O * O_by_raw.leftCols<2>();
  out.by_rho.col(0) = tau * lambda;
  out.by_rho.col(1) = tau * tau * lambda;
  return out;
}

}  // namespace

std::optional<LensProjection> ProjectThroughLens(const Lens& lens, const Eigen::Vector3d& p_CQ) {
  const auto distorted = Distort(lens, p_CQ);
  if (!distorted || !(distorted->point.z() > 0)) {
    return std::nullopt;
  }
  const Eigen::Vector3d& q = distorted->point;
  const double x = q.x() / q.z();
  const double y = q.y() / q.z();
  Eigen::Matrix<double, 2, 3> by_distorted;
  by_distorted << lens[kHs], 0, -lens[kHs] * x, 0, lens[kVs], -lens[kVs] * y;
  by_distorted /= q.z();
  LensProjection out;
  out.pixel = {lens[kHs] * x + lens[kHc], lens[kVs] * y + lens[kVc]};
  if (!out.pixel.allFinite()) {
    return std::nullopt;
  }
  out.by_point = by_distorted * distorted->by_point;
  out.by_lens.setZero();
  out.by_lens(0, kHs) = x;
  out.by_lens(0, kHc) = 1;
  out.by_lens(1, kVs) = y;
  out.by_lens(1, kVc) = 1;
  out.by_lens.middleCols<2>(kO1) = by_distorted * distorted->by_axis;
  out.by_lens.middleCols<2>(kRho1) = by_distorted * distorted->by_rho;
  return out;
}

std::optional<LensProjection> ProjectDot(const Lens& lens, const RigidTransform& X_CT,
                                         const Eigen::Vector3d& p_TQ, double diameter_m) {
  auto centre = ProjectThroughLens(lens, X_CT * p_TQ);
  if (!centre || !(diameter_m > 0)) {
    return centre;
  }
  const double step = diameter_m / 4;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weight = 0;
  for (const double dx : {-step, step}) {
    for (const double dy : {-step, step}) {
      const auto at = ProjectThroughLens(lens, X_CT * (p_TQ + Eigen::Vector3d(dx, dy, 0)));
      if (!at) {
        return std::nullopt;
      }
      const Eigen::Matrix2d by_plane = at->by_point * X_CT.R.leftCols<2>();
      const double area = std::abs(by_plane.determinant());
      sum += area * at->pixel;
      weight += area;
    }
  }
  if (weight > 0) {
    centre->pixel = sum / weight;
  }
  return centre;
}

CahvorModel CahvorFromLens(const Lens& lens, const RigidTransform& X_FC, int width, int height) {
  const PinholeCamera pinhole{width, height, lens[kHs], lens[kVs], lens[kHc], lens[kVc]};
  CahvorModel model = CahvFromPinhole(pinhole, X_FC.R.transpose(), X_FC.p);
  model.O = X_FC.R * Eigen::Vector3d(lens[kO1], lens[kO2], 1).normalized();
  model.R = {0, lens[kRho1], lens[kRho2]};
  return model;
}

Lens LensFromCahvor(const CahvorModel& model, RigidTransform& X_FC) {
  const CahvPinhole pinhole = PinholeFromCahv(model);
  X_FC = {pinhole.R_CF.transpose(), pinhole.p_FC};
  const Eigen::Vector3d O = pinhole.R_CF * model.O;
  Lens lens;
  lens << pinhole.camera.fx_px, pinhole.camera.cx_px, pinhole.camera.fy_px, pinhole.camera.cy_px,
      O.x() / O.z(), O.y() / O.z(), model.R[1], model.R[2];
  return lens;
}

}  // namespace palace
