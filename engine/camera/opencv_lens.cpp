#include "engine/camera/opencv_lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/camera/polynomial.h"

namespace palace {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;

constexpr double kOnAxis_rad = 1e-8;

/// A distorted point of the unit image plane with its derivative by the undistorted one.
struct Distorted {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  Eigen::Matrix2d slope = Eigen::Matrix2d::Identity();
};

/// The radial factor g is a ratio N/D of polynomials in s = r^2.
std::array<double, 4> Numerator(const OpenCvModel& m) { return {1, m.k[0], m.k[1], m.k[4]}; }
std::array<double, 4> Denominator(const OpenCvModel& m) { return {1, m.k[5], m.k[6], m.k[7]}; }

double Value(const std::array<double, 4>& c, double s) {
  return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
}
double Slope(const std::array<double, 4>& c, double s) {
  return c[1] + s * (2 * c[2] + s * 3 * c[3]);
}

/// True when r N(r^2)/D(r^2) grows from the axis to s = r^2. Its derivative has the sign of
/// N D + 2 s (N' D - N D').
bool RadialIsMonotonic(const OpenCvModel& model, double s) {
  const std::array<double, 4> n = Numerator(model);
  if (model.coefficients < 8) {
    return PositiveOn(RadialSlope(n), s);
  }
  const std::array<double, 4> d = Denominator(model);
  std::array<double, 7> growth{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const double order = 1 + 2 * (static_cast<double>(i) - static_cast<double>(j));
      growth[i + j] += order * n[i] * d[j];
    }
  }
  return PositiveOn(d, s) && PositiveOn(growth, s);
}

/// The homography of a sensor that stands tilted by tau_x, tau_y (OpenCV's matTilt).
Eigen::Matrix3d TiltMatrix(double tau_x, double tau_y) {
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(-tau_y, Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(-tau_x, Eigen::Vector3d::UnitX()))
                                .toRotationMatrix();
  Eigen::Matrix3d project;
  project << R(2, 2), 0, -R(0, 2), 0, R(2, 2), -R(1, 2), 0, 0, 1;
  return project * R;
}

std::optional<Distorted> Distort(const OpenCvModel& model, const Eigen::Vector2d& u) {
  const double a = u.x();
  const double b = u.y();
  const double s = u.squaredNorm();
  if (!RadialIsMonotonic(model, s)) {
    return std::nullopt;
  }
  const auto& k = model.k;
  const std::array<double, 4> n = Numerator(model);
  const std::array<double, 4> d = Denominator(model);
  const double bottom = Value(d, s);
  const double g = Value(n, s) / bottom;
  const double g_slope = (Slope(n, s) - g * Slope(d, s)) / bottom;  // by s
  const double p1 = k[2];
  const double p2 = k[3];
  Distorted out;
  out.point = {a * g + 2 * p1 * a * b + p2 * (s + 2 * a * a) + s * (k[8] + s * k[9]),
               b * g + p1 * (s + 2 * b * b) + 2 * p2 * a * b + s * (k[10] + s * k[11])};
  const Eigen::Vector2d ds(2 * a, 2 * b);
  out.slope = g * Eigen::Matrix2d::Identity() + g_slope * u * ds.transpose();
  out.slope(0, 0) += 2 * p1 * b + 6 * p2 * a;
  out.slope(0, 1) += 2 * p1 * a + 2 * p2 * b;
  out.slope(1, 0) += 2 * p1 * a + 2 * p2 * b;
  out.slope(1, 1) += 6 * p1 * b + 2 * p2 * a;
  out.slope.row(0) += (k[8] + 2 * s * k[9]) * ds.transpose();
  out.slope.row(1) += (k[10] + 2 * s * k[11]) * ds.transpose();
  if (!(out.slope.determinant() > 0)) {
    return std::nullopt;
  }
  if (k[12] != 0 || k[13] != 0) {
    const Eigen::Vector3d tilted = TiltMatrix(k[12], k[13]) * out.point.homogeneous();
    if (!(tilted.z() > 0)) {
      return std::nullopt;
    }
    const Eigen::Vector2d seen = tilted.hnormalized();
    const Eigen::Matrix3d tilt = TiltMatrix(k[12], k[13]);
    const Eigen::Matrix2d tilt_slope =
        (tilt.topLeftCorner<2, 2>() - seen * tilt.block<1, 2>(2, 0)) / tilted.z();
    out.point = seen;
    out.slope = tilt_slope * out.slope;
  }
  return out.point.allFinite() ? std::optional<Distorted>(out) : std::nullopt;
}

std::array<double, 5> FisheyeRadial(const OpenCvModel& m) {
  return {1, m.k[0], m.k[1], m.k[2], m.k[3]};
}

/// The fisheye's image point of p_C and its derivative.
std::optional<Eigen::Vector2d> Fisheye(const OpenCvModel& model, const Eigen::Vector3d& p,
                                       Matrix23* slope) {
  const double r = p.head<2>().norm();
  const double theta = std::atan2(r, p.z());
  if (!(theta < std::numbers::pi - kOnAxis_rad) ||
      !PositiveOn(RadialSlope(FisheyeRadial(model)), theta * theta)) {
    return std::nullopt;
  }
  if (theta < kOnAxis_rad) {
    if (slope != nullptr) {
      *slope << 1 / p.z(), 0, -p.x() / (p.z() * p.z()), 0, 1 / p.z(), -p.y() / (p.z() * p.z());
    }
    return p.head<2>() / p.z();
  }
  const double image = RadialValue(FisheyeRadial(model), theta);
  const Eigen::Vector2d across = p.head<2>() / r;
  if (slope != nullptr) {
    const std::array<double, 5> c = RadialSlope(FisheyeRadial(model));
    double image_slope = 0;
    for (std::size_t i = c.size(); i-- > 0;) {
      image_slope = image_slope * theta * theta + c[i];
    }
    const double square = p.squaredNorm();
    Eigen::Vector3d dtheta;
    dtheta << p.z() / square * across, -r / square;
    *slope = image_slope * across * dtheta.transpose();
    slope->leftCols<2>() += image / r * (Eigen::Matrix2d::Identity() - across * across.transpose());
  }
  return image * across;
}

std::optional<Eigen::Vector2d> ImagePoint(const OpenCvModel& model, const Eigen::Vector3d& p,
                                          Matrix23* slope) {
  if (model.lens == OpenCvLens::kFisheye) {
    return Fisheye(model, p, slope);
  }
  if (!(p.z() > 0)) {
    return std::nullopt;
  }
  const Eigen::Vector2d u = p.hnormalized();
  const auto distorted = u.allFinite() ? Distort(model, u) : std::nullopt;
  if (!distorted) {
    return std::nullopt;
  }
  if (slope != nullptr) {
    Matrix23 du;
    du << 1 / p.z(), 0, -u.x() / p.z(), 0, 1 / p.z(), -u.y() / p.z();
    *slope = distorted->slope * du;
  }
  return distorted->point;
}

std::optional<Eigen::Vector2d> Project(const OpenCvModel& model, const Eigen::Vector3d& p_FQ,
                                       Matrix23* dpixel_dp) {
  const Eigen::Vector3d p = model.R_CF * p_FQ + model.t_CF;
  if (!p.allFinite() || p.isZero(0)) {
    return std::nullopt;
  }
  const auto image = ImagePoint(model, p, dpixel_dp);
  if (!image) {
    return std::nullopt;
  }
  const PinholeCamera& K = model.pinhole;
  const Eigen::Vector2d pixel(K.fx_px * image->x() + K.cx_px, K.fy_px * image->y() + K.cy_px);
  if (!pixel.allFinite()) {
    return std::nullopt;
  }
  if (dpixel_dp != nullptr) {
    *dpixel_dp = Eigen::Vector2d(K.fx_px, K.fy_px).asDiagonal() * *dpixel_dp * model.R_CF;
  }
  return pixel;
}

/// Newton's method for Distort(u) = target from `u`; nothing when a step leaves the model's range.
std::optional<Eigen::Vector2d> Refine(const OpenCvModel& model, const Eigen::Vector2d& target,
                                      Eigen::Vector2d u) {
  for (int i = 0; i < 30; ++i) {
    const auto distorted = Distort(model, u);
    if (!distorted) {
      return std::nullopt;
    }
    const Eigen::Vector2d step = distorted->slope.inverse() * (distorted->point - target);
    u -= step;
    if (!u.allFinite()) {
      return std::nullopt;
    }
    if (step.norm() <= 1e-10 * (u.norm() + 1e-10)) {
      // Quadratic convergence: the error is below rounding; the result must be in range as well.
      return Distort(model, u) ? std::optional<Eigen::Vector2d>(u) : std::nullopt;
    }
  }
  return std::nullopt;
}

/// The undistorted point, followed from the axis to the target in ever smaller steps if need be.
std::optional<Eigen::Vector2d> Undistort(const OpenCvModel& model, const Eigen::Vector2d& target) {
  if (const auto direct = Refine(model, target, target)) {
    return direct;
  }
  const auto centre = Distort(model, Eigen::Vector2d::Zero());
  if (!centre) {
    return std::nullopt;
  }
  const Eigen::Vector2d way = target - centre->point;
  Eigen::Vector2d u = Eigen::Vector2d::Zero();
  double reached = 0;
  double step = 0.25;
  while (reached < 1 && step > 1e-6) {
    const double next = std::min(1.0, reached + step);
    if (const auto solved = Refine(model, centre->point + next * way, u)) {
      u = *solved;
      reached = next;
    } else {
      step /= 2;
    }
  }
  return reached >= 1 ? std::optional<Eigen::Vector2d>(u) : std::nullopt;
}

}  // namespace

std::optional<Eigen::Vector2d> ProjectOpenCv(const OpenCvModel& model,
                                             const Eigen::Vector3d& p_FQ) {
  return Project(model, p_FQ, nullptr);
}

std::optional<ProjectionJacobian> JacobianOfOpenCv(const OpenCvModel& model,
                                                   const Eigen::Vector3d& p_FQ) {
  ProjectionJacobian result;
  const auto pixel = Project(model, p_FQ, &result.dpixel_dp);
  if (!pixel) {
    return std::nullopt;
  }
  result.pixel = *pixel;
  return result;
}

std::optional<CameraRay> RayFromPixelOpenCv(const OpenCvModel& model,
                                            const Eigen::Vector2d& pixel) {
  const PinholeCamera& K = model.pinhole;
  const Eigen::Vector2d image((pixel.x() - K.cx_px) / K.fx_px, (pixel.y() - K.cy_px) / K.fy_px);
  if (!image.allFinite()) {
    return std::nullopt;
  }
  Eigen::Vector3d ray_C = Eigen::Vector3d::UnitZ();
  if (model.lens == OpenCvLens::kFisheye) {
    const double radius = image.norm();
    const auto theta = InvertRadial(FisheyeRadial(model), radius);
    if (!theta || !(*theta < std::numbers::pi - kOnAxis_rad)) {
      return std::nullopt;
    }
    const double across = radius > 0 ? std::sin(*theta) / radius : 1;
    ray_C << across * image, std::cos(*theta);
  } else {
    const auto u = Undistort(model, image);
    if (!u) {
      return std::nullopt;
    }
    ray_C = u->homogeneous();
  }
  const Eigen::Matrix3d R_FC = model.R_CF.transpose();
  return CameraRay{-(R_FC * model.t_CF), (R_FC * ray_C).normalized()};
}

}  // namespace palace
