#include "engine/camera/cahvor.h"

#include <algorithm>
#include <cmath>

namespace palace {
namespace {

constexpr double kLinearTolerance = 1e-12;
constexpr int kMaxNewtonSteps = 100;
constexpr double kNewtonTolerance = 1e-15;

/// True when r (1 + mu(r^2)) grows with r all the way from the axis to tau = r^2, so that the
/// distortion can be inverted: 1 + R0 + 3 R1 t + 5 R2 t^2 > 0 on [0, tau].
bool DistortionIsMonotonic(const Eigen::Vector3d& R, double tau) {
  const auto slope = [&](double t) { return 1 + R[0] + t * (3 * R[1] + 5 * R[2] * t); };
  double least = std::min(slope(0), slope(tau));
  if (R[2] != 0) {
    const double turning = -3 * R[1] / (10 * R[2]);
    if (turning > 0 && turning < tau) {
      least = std::min(least, slope(turning));
    }
  }
  return least > 0;
}

/// Root u of k5 u^5 + k3 u^3 + k1 u = 1 near `start`.
std::optional<double> SolveQuintic(double k1, double k3, double k5, double start) {
  double u = start;
  for (int i = 0; i < kMaxNewtonSteps; ++i) {
    const double square = u * u;
    const double value = ((k5 * square + k3) * square + k1) * u - 1;
    const double slope = (5 * k5 * square + 3 * k3) * square + k1;
    if (!(slope > 1e-12)) {
      return std::nullopt;
    }
    const double step = value / slope;
    u -= step;
    if (std::abs(step) <= kNewtonTolerance * std::max(1.0, std::abs(u))) {
      return u;
    }
  }
  // Newton's steps may alternate in the last bit; a residual of rounding size is a solution.
  const double square = u * u;
  const double residual = ((k5 * square + k3) * square + k1) * u - 1;
  return std::abs(residual) < 1e-13 ? std::optional<double>(u) : std::nullopt;
}

Eigen::Vector3d LinearRay(const CahvorModel& model, const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d down = model.V - pixel.y() * model.A;
  const Eigen::Vector3d across = model.H - pixel.x() * model.A;
  Eigen::Vector3d ray = down.cross(across);
  if (model.V.cross(model.H).dot(model.A) < 0) {
    ray = -ray;
  }
  return ray.normalized();
}

}  // namespace

bool IsLinear(const CahvorModel& model) {
  return model.R.isZero(0) && (model.O - model.A).norm() < kLinearTolerance;
}

std::optional<Eigen::Vector2d> ProjectCahvor(const CahvorModel& model,
                                             const Eigen::Vector3d& p_FQ) {
  if (!p_FQ.allFinite()) {
    return std::nullopt;
  }
  Eigen::Vector3d q = p_FQ - model.C;
  if (!model.R.isZero(0)) {
    const double zeta = q.dot(model.O);
    if (!(zeta > 0)) {
      return std::nullopt;
    }
    const Eigen::Vector3d lambda = q - zeta * model.O;
    const double tau = lambda.squaredNorm() / (zeta * zeta);
    if (!DistortionIsMonotonic(model.R, tau)) {
      return std::nullopt;
    }
    q += (model.R[0] + tau * (model.R[1] + tau * model.R[2])) * lambda;
  }
  const double depth = q.dot(model.A);
  if (!(depth > 0)) {
    return std::nullopt;
  }
  const Eigen::Vector2d pixel(q.dot(model.H) / depth, q.dot(model.V) / depth);
  return pixel.allFinite() ? std::optional<Eigen::Vector2d>(pixel) : std::nullopt;
}

std::optional<CahvorRay> RayFromPixelCahvor(const CahvorModel& model,
                                            const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d linear = LinearRay(model, pixel);
  if (!linear.allFinite()) {
    return std::nullopt;
  }
  if (model.R.isZero(0)) {
    return CahvorRay{model.C, linear};
  }
  const double zeta = linear.dot(model.O);
  if (!(zeta > 0)) {
    return std::nullopt;
  }
  // The picture's ray r' = zeta O + lambda' came from zeta O + u lambda' with u (1 + mu(u^2 tau'))
  // = 1: the distortion moves lambda only, and by a factor that depends on its length.
  const Eigen::Vector3d lambda = linear - zeta * model.O;
  const double tau = lambda.squaredNorm() / (zeta * zeta);
  const double k3 = model.R[1] * tau;
  const double k5 = model.R[2] * tau * tau;
  const auto u = SolveQuintic(1 + model.R[0], k3, k5, 1 - (model.R[0] + k3 + k5));
  if (!u || !DistortionIsMonotonic(model.R, *u * *u * tau)) {
    return std::nullopt;
  }
  return CahvorRay{model.C, (linear - (1 - *u) * lambda).normalized()};
}

CahvInternals InternalsOf(const CahvorModel& model) {
  CahvInternals internals;
  internals.hs_px = model.A.cross(model.H).norm();
  internals.hc_px = model.A.dot(model.H);
  internals.vs_px = model.A.cross(model.V).norm();
  internals.vc_px = model.A.dot(model.V);
  const Eigen::Vector3d across = (model.H - internals.hc_px * model.A) / internals.hs_px;
  const Eigen::Vector3d down = (model.V - internals.vc_px * model.A) / internals.vs_px;
  internals.theta_rad = -std::atan2(down.dot(model.A.cross(across)), down.dot(across));
  return internals;
}

CahvPinhole PinholeFromCahv(const CahvorModel& model) {
  const CahvInternals internals = InternalsOf(model);
  CahvPinhole pinhole;
  const Eigen::Vector3d x = (model.H - internals.hc_px * model.A) / internals.hs_px;
  const Eigen::Vector3d y = model.A.cross(x);
  pinhole.R_CF.row(0) = x;
  pinhole.R_CF.row(1) = y;
  pinhole.R_CF.row(2) = model.A;
  pinhole.p_FC = model.C;
  pinhole.shear_px = model.V.dot(x);
  pinhole.camera = {model.width,    model.height,    internals.hs_px,
                    model.V.dot(y), internals.hc_px, internals.vc_px};
  return pinhole;
}

CahvorModel CahvFromPinhole(const PinholeCamera& camera, const Eigen::Matrix3d& R_CF,
                            const Eigen::Vector3d& p_FC) {
  CahvorModel model;
  model.width = camera.width;
  model.height = camera.height;
  model.C = p_FC;
  model.A = R_CF.row(2);
  model.H = camera.fx_px * R_CF.row(0) + camera.cx_px * R_CF.row(2);
  model.V = camera.fy_px * R_CF.row(1) + camera.cy_px * R_CF.row(2);
  model.O = model.A;
  return model;
}

}  // namespace palace
