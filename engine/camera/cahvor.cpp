#include "engine/camera/cahvor.h"

#include <array>
#include <cmath>

#include "engine/camera/polynomial.h"

namespace palace {
namespace {

constexpr double kLinearTolerance = 1e-12;

/// Coefficients of r (1 + R0 + R1 r^2 + R2 r^4), r = tan of the angle from O.
std::array<double, 3> Radial(const CahvorModel& model) {
  return {1 + model.R[0], model.R[1], model.R[2]};
}

std::optional<Eigen::Vector2d> Project(const CahvorModel& model, const Eigen::Vector3d& p_FQ,
                                       Eigen::Matrix<double, 2, 3>* dpixel_dp) {
  if (!p_FQ.allFinite()) {
    return std::nullopt;
  }
  Eigen::Vector3d q = p_FQ - model.C;
  Eigen::Matrix3d dq_dp = Eigen::Matrix3d::Identity();
  if (!model.R.isZero(0)) {
    const double zeta = q.dot(model.O);
    if (!(zeta > 0)) {
      return std::nullopt;
    }
    const Eigen::Vector3d lambda = q - zeta * model.O;
    const double tau = lambda.squaredNorm() / (zeta * zeta);
    if (!PositiveOn(RadialSlope(Radial(model)), tau)) {
      return std::nullopt;
    }
    const double mu = model.R[0] + tau * (model.R[1] + tau * model.R[2]);
    if (dpixel_dp != nullptr) {
      const double dmu_dtau = model.R[1] + 2 * tau * model.R[2];
      const Eigen::Vector3d dtau_dp = 2 / (zeta * zeta) * lambda - 2 * tau / zeta * model.O;
      dq_dp += mu * (Eigen::Matrix3d::Identity() - model.O * model.O.transpose()) +
               dmu_dtau * lambda * dtau_dp.transpose();
    }
    q += mu * lambda;
  }
  const double depth = q.dot(model.A);
  if (!(depth > 0)) {
    return std::nullopt;
  }
  const Eigen::Vector2d pixel(q.dot(model.H) / depth, q.dot(model.V) / depth);
  if (!pixel.allFinite()) {
    return std::nullopt;
  }
  if (dpixel_dp != nullptr) {
    dpixel_dp->row(0) = (model.H - pixel.x() * model.A).transpose() / depth * dq_dp;
    dpixel_dp->row(1) = (model.V - pixel.y() * model.A).transpose() / depth * dq_dp;
  }
  return pixel;
}

}  // namespace

bool IsLinear(const CahvorModel& model) {
  return model.R.isZero(0) && (model.O - model.A).norm() < kLinearTolerance;
}

std::optional<Eigen::Vector2d> ProjectCahvor(const CahvorModel& model,
                                             const Eigen::Vector3d& p_FQ) {
  return Project(model, p_FQ, nullptr);
}

std::optional<ProjectionJacobian> JacobianOfCahvor(const CahvorModel& model,
                                                   const Eigen::Vector3d& p_FQ) {
  ProjectionJacobian result;
  const auto pixel = Project(model, p_FQ, &result.dpixel_dp);
  if (!pixel) {
    return std::nullopt;
  }
  result.pixel = *pixel;
  return result;
}

Eigen::Vector3d LinearRayCahv(const CahvorModel& model, const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d down = model.V - pixel.y() * model.A;
  const Eigen::Vector3d across = model.H - pixel.x() * model.A;
  return down.cross(across) / model.V.cross(model.H).dot(model.A);
}

std::optional<CameraRay> RayFromPixelCahvor(const CahvorModel& model,
                                            const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d linear = LinearRayCahv(model, pixel);
  if (!linear.allFinite()) {
    return std::nullopt;
  }
  if (model.R.isZero(0)) {
    return CameraRay{model.C, linear.normalized()};
  }
  const double zeta = linear.dot(model.O);
  if (!(zeta > 0)) {
    return std::nullopt;
  }
  // The picture's ray zeta O + lambda' came from zeta O + u lambda': the distortion moves lambda
  // only, and by a factor that depends on its length.
  const Eigen::Vector3d lambda = linear - zeta * model.O;
  const double distorted = lambda.norm() / zeta;
  const auto tangent = InvertRadial(Radial(model), distorted);
  if (!tangent) {
    return std::nullopt;
  }
  const double u = distorted > 0 ? *tangent / distorted : 1;
  return CameraRay{model.C, (zeta * model.O + u * lambda).normalized()};
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

CahvorModel ScaleCahvor(CahvorModel model, double scale_x, double scale_y) {
  model.H *= scale_x;
  model.V *= scale_y;
  model.width = static_cast<int>(std::lround(model.width * scale_x));
  model.height = static_cast<int>(std::lround(model.height * scale_y));
  return model;
}

CahvorModel ShiftCahvor(CahvorModel model, double dx_px, double dy_px) {
  model.H -= dx_px * model.A;
  model.V -= dy_px * model.A;
  return model;
}

}  // namespace palace
