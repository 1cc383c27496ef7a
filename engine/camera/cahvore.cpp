#include "engine/camera/cahvore.h"

#include <array>
#include <cmath>
#include <numbers>

#include "engine/camera/cahvor.h"
#include "engine/camera/polynomial.h"

namespace palace {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;

constexpr double kRightAngle = std::numbers::pi / 2;
constexpr double kOnAxis_rad = 1e-8;  // nearer than this the lens is its own derivative

/// chi and its derivative by theta; not finite beyond the range of the lens.
struct Chi {
  double value = 0;
  double slope = 0;
};

Chi ChiOf(double linearity, double theta) {
  const double angle = linearity * theta;
  if (!(std::abs(angle) < kRightAngle)) {
    return {NAN, NAN};
  }
  if (linearity > 0) {
    const double c = std::cos(angle);
    return {std::tan(angle) / linearity, 1 / (c * c)};
  }
  if (linearity < 0) {
    return {std::sin(angle) / linearity, std::cos(angle)};
  }
  return {theta, 1};
}

double ThetaOf(double linearity, double chi) {
  if (linearity > 0) {
    return std::atan(linearity * chi) / linearity;
  }
  if (linearity < 0) {
    return std::asin(linearity * chi) / linearity;  // NaN beyond the range
  }
  return chi;
}

std::array<double, 3> Radial(const CahvorModel& base) {
  return {1 + base.R[0], base.R[1], base.R[2]};
}

/// Angle of the ray that meets the moving pupil, with the slope of its equation.
struct Incidence {
  double theta = 0;
  double slope = 0;  ///< upsilon: derivative of the pupil equation by theta
};

std::optional<Incidence> SolveIncidence(const Eigen::Vector3d& E, double zeta, double lambda) {
  double theta = std::atan2(lambda, zeta);
  bool converged = E.isZero(0);  // a pupil at rest: the angle is known
  for (int i = 0; i < 100; ++i) {
    const double s = std::sin(theta);
    const double c = std::cos(theta);
    const double t2 = theta * theta;
    const double pupil = E[0] + t2 * (E[1] + t2 * E[2]);
    const double pupil_slope = theta * (2 * E[1] + 4 * t2 * E[2]);
    const double slope = zeta * c + lambda * s - (1 - c) * pupil - (theta - s) * pupil_slope;
    if (!(slope > 0)) {
      return std::nullopt;
    }
    if (converged) {
      return Incidence{theta, slope};
    }
    const double step = (zeta * s - lambda * c - (theta - s) * pupil) / slope;
    theta -= step;
    if (!(theta >= 0 && theta < std::numbers::pi)) {
      return std::nullopt;
    }
    converged = std::abs(step) <= 1e-9 * theta;  // quadratic: the error is below rounding
  }
  return std::nullopt;
}

/// P' of the point q = P - C, with its derivative where asked for.
std::optional<Eigen::Vector3d> Distort(const CahvoreModel& model, const Eigen::Vector3d& E,
                                       const Eigen::Vector3d& q, Eigen::Matrix3d* dq_dp) {
  const CahvorModel& base = model.base;
  const double zeta = q.dot(base.O);
  const Eigen::Vector3d lambda = q - zeta * base.O;
  const double distance = lambda.norm();
  if (zeta < 0 && distance < kOnAxis_rad * -zeta) {
    return std::nullopt;  // on the axis behind: its direction across is rounding
  }
  const auto incidence = SolveIncidence(E, zeta, distance);
  if (!incidence || !(incidence->theta < std::numbers::pi - kOnAxis_rad)) {
    return std::nullopt;
  }
  if (incidence->theta < kOnAxis_rad) {
    if (dq_dp != nullptr) {
      *dq_dp =
          (1 + base.R[0]) * Eigen::Matrix3d::Identity() - base.R[0] * base.O * base.O.transpose();
    }
    return zeta * base.O + (1 + base.R[0]) * lambda;
  }
  const Chi chi = ChiOf(model.linearity, incidence->theta);
  const double chi2 = chi.value * chi.value;
  if (!PositiveOn(RadialSlope(Radial(base)), chi2)) {
    return std::nullopt;
  }
  const double gain = 1 + base.R[0] + chi2 * (base.R[1] + chi2 * base.R[2]);
  if (dq_dp != nullptr) {
    // q' = (|lambda| / chi) O + gain lambda; theta moves with zeta and |lambda|.
    const Eigen::Vector3d across = lambda / distance;
    const double gain_slope = chi.value * (2 * base.R[1] + 4 * chi2 * base.R[2]) * chi.slope;
    const double dtheta_dzeta = -std::sin(incidence->theta) / incidence->slope;
    const double dtheta_dlambda = std::cos(incidence->theta) / incidence->slope;
    const double along_slope = -distance / chi2 * chi.slope;  // of |lambda| / chi by theta
    const Eigen::Vector3d along = along_slope * dtheta_dzeta * base.O +
                                  (1 / chi.value + along_slope * dtheta_dlambda) * across;
    const Eigen::Vector3d sideways = distance * gain_slope * dtheta_dzeta * base.O +
                                     (gain + distance * gain_slope * dtheta_dlambda) * across;
    *dq_dp = base.O * along.transpose() + across * sideways.transpose() +
             gain * (Eigen::Matrix3d::Identity() - base.O * base.O.transpose() -
                     across * across.transpose());
  }
  return distance / chi.value * base.O + gain * lambda;
}

std::optional<Eigen::Vector2d> Project(const CahvoreModel& model, const Eigen::Vector3d& E,
                                       const Eigen::Vector3d& q, Matrix23* dpixel_dp) {
  if (!q.allFinite() || q.isZero(0)) {
    return std::nullopt;
  }
  Eigen::Matrix3d dq_dp;
  const auto image = Distort(model, E, q, dpixel_dp != nullptr ? &dq_dp : nullptr);
  if (!image) {
    return std::nullopt;
  }
  const CahvorModel& base = model.base;
  const double depth = image->dot(base.A);
  if (!(depth > 0)) {
    return std::nullopt;
  }
  const Eigen::Vector2d pixel(image->dot(base.H) / depth, image->dot(base.V) / depth);
  if (!pixel.allFinite()) {
    return std::nullopt;
  }
  if (dpixel_dp != nullptr) {
    dpixel_dp->row(0) = (base.H - pixel.x() * base.A).transpose() / depth * dq_dp;
    dpixel_dp->row(1) = (base.V - pixel.y() * base.A).transpose() / depth * dq_dp;
  }
  return pixel;
}

}  // namespace

std::optional<Eigen::Vector2d> ProjectCahvore(const CahvoreModel& model,
                                              const Eigen::Vector3d& p_FQ) {
  return Project(model, model.E, p_FQ - model.base.C, nullptr);
}

std::optional<ProjectionJacobian> JacobianOfCahvore(const CahvoreModel& model,
                                                    const Eigen::Vector3d& p_FQ) {
  ProjectionJacobian result;
  const auto pixel = Project(model, model.E, p_FQ - model.base.C, &result.dpixel_dp);
  if (!pixel) {
    return std::nullopt;
  }
  result.pixel = *pixel;
  return result;
}

std::optional<Eigen::Vector2d> ProjectDirectionCahvore(const CahvoreModel& model,
                                                       const Eigen::Vector3d& direction) {
  return Project(model, Eigen::Vector3d::Zero(), direction, nullptr);
}

std::optional<CameraRay> RayFromPixelCahvore(const CahvoreModel& model,
                                             const Eigen::Vector2d& pixel) {
  const CahvorModel& base = model.base;
  const Eigen::Vector3d linear = LinearRayCahv(base, pixel);
  if (!linear.allFinite()) {
    return std::nullopt;
  }
  const double zeta = linear.dot(base.O);
  if (!(zeta > 0)) {
    return std::nullopt;
  }
  const Eigen::Vector3d lambda = linear - zeta * base.O;
  const double distance = lambda.norm();
  const auto chi = InvertRadial(Radial(base), distance / zeta);
  if (!chi) {
    return std::nullopt;
  }
  const double theta = ThetaOf(model.linearity, *chi);
  if (!(theta < std::numbers::pi - kOnAxis_rad)) {
    return std::nullopt;
  }
  if (theta < kOnAxis_rad) {
    return CameraRay{base.C, base.O};
  }
  const double t2 = theta * theta;
  const double shift =
      (theta / std::sin(theta) - 1) * (model.E[0] + t2 * (model.E[1] + t2 * model.E[2]));
  const Eigen::Vector3d direction = std::sin(theta) / distance * lambda + std::cos(theta) * base.O;
  return CameraRay{base.C + shift * base.O, direction.normalized()};
}

}  // namespace palace
