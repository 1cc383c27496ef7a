#include "engine/calibration/lens.h"

#include <cmath>

#include "engine/camera/cahvor.h"

namespace palace {
namespace {

using Row3 = Eigen::RowVector3d;

/// The terms of the distortion of one point.
struct Terms {
  Eigen::Vector3d O;
  Eigen::Vector3d lambda;
  double axis_length = 0;  ///< of (o1, o2, 1)
  double zeta = 0;
  double tau = 0;
  double mu = 0;
};

/// Nothing behind the camera, and beyond the radius where the picture of a growing angle turns
/// back.
std::optional<Terms> TermsOf(const Lens& lens, const Eigen::Vector3d& p) {
  Terms t;
  const Eigen::Vector3d raw(lens[kO1], lens[kO2], 1);
  t.axis_length = raw.norm();
  t.O = raw / t.axis_length;
  t.zeta = p.dot(t.O);
  if (!(t.zeta > 0)) {
    return std::nullopt;
  }
  t.lambda = p - t.zeta * t.O;
  t.tau = t.lambda.squaredNorm() / (t.zeta * t.zeta);
  t.mu = t.tau * (lens[kRho1] + t.tau * lens[kRho2]);
  for (const double at : {t.tau, -3 * lens[kRho1] / (10 * lens[kRho2])}) {
    if (at > 0 && at <= t.tau && !(1 + at * (3 * lens[kRho1] + 5 * lens[kRho2] * at) > 0)) {
      return std::nullopt;
    }
  }
  return t;
}

/// Derivatives of the distorted point p' = p + mu lambda.
struct Distorted {
  Eigen::Matrix3d by_point;
  Eigen::Matrix<double, 3, 2> by_axis;  ///< by o1, o2
  Eigen::Matrix<double, 3, 2> by_rho;
};

/// By hand, with lambda.O = 0:
///   d zeta = O.dp + p.dO,  d lambda = dp - O (O.dp) - (O p^T + zeta I) dO,
///   d tau = (2 / zeta^2) lambda.dp - (2 tau / zeta) O.dp - (2 / zeta) (lambda + tau p).dO.
/// Checked against central differences by the tests.
Distorted DerivativesOf(const Lens& lens, const Eigen::Vector3d& p, const Terms& t) {
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d lambda_by_tau = (lens[kRho1] + 2 * t.tau * lens[kRho2]) * t.lambda;
  const Row3 tau_by_point =
      (2 / (t.zeta * t.zeta)) * t.lambda.transpose() - (2 * t.tau / t.zeta) * t.O.transpose();
  const Row3 tau_by_O = (-2 / t.zeta) * (t.lambda + t.tau * p).transpose();
  const Eigen::Matrix3d by_O =
      -t.mu * (t.O * p.transpose() + t.zeta * identity) + lambda_by_tau * tau_by_O;
  const Eigen::Matrix3d across = identity - t.O * t.O.transpose();
  Distorted out;
  out.by_point = identity + t.mu * across + lambda_by_tau * tau_by_point;
  out.by_axis = by_O * (across.leftCols<2>() / t.axis_length);
  out.by_rho.col(0) = t.tau * t.lambda;
  out.by_rho.col(1) = t.tau * t.tau * t.lambda;
  return out;
}

/// The linear part: pixel of the distorted point q.
std::optional<Eigen::Vector2d> LinearPixel(const Lens& lens, const Eigen::Vector3d& q) {
  if (!(q.z() > 0)) {
    return std::nullopt;
  }
  const Eigen::Vector2d pixel(lens[kHs] * (q.x() / q.z()) + lens[kHc],
                              lens[kVs] * (q.y() / q.z()) + lens[kVc]);
  return pixel.allFinite() ? std::optional<Eigen::Vector2d>(pixel) : std::nullopt;
}

}  // namespace

std::optional<Eigen::Vector2d> PixelThroughLens(const Lens& lens, const Eigen::Vector3d& p_CQ) {
  const auto terms = TermsOf(lens, p_CQ);
  return terms ? LinearPixel(lens, p_CQ + terms->mu * terms->lambda) : std::nullopt;
}

std::optional<LensProjection> ProjectThroughLens(const Lens& lens, const Eigen::Vector3d& p_CQ) {
  const auto terms = TermsOf(lens, p_CQ);
  if (!terms) {
    return std::nullopt;
  }
  const Eigen::Vector3d q = p_CQ + terms->mu * terms->lambda;
  const auto pixel = LinearPixel(lens, q);
  if (!pixel) {
    return std::nullopt;
  }
  const Distorted distorted = DerivativesOf(lens, p_CQ, *terms);
  const double x = q.x() / q.z();
  const double y = q.y() / q.z();
  Eigen::Matrix<double, 2, 3> by_distorted;
  by_distorted << lens[kHs], 0, -lens[kHs] * x, 0, lens[kVs], -lens[kVs] * y;
  by_distorted /= q.z();
  LensProjection out;
  out.pixel = *pixel;
  out.by_point = by_distorted * distorted.by_point;
  out.by_lens.setZero();
  out.by_lens(0, kHs) = x;
  out.by_lens(0, kHc) = 1;
  out.by_lens(1, kVs) = y;
  out.by_lens(1, kVc) = 1;
  out.by_lens.middleCols<2>(kO1) = by_distorted * distorted.by_axis;
  out.by_lens.middleCols<2>(kRho1) = by_distorted * distorted.by_rho;
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
