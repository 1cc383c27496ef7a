#include "engine/camera/opencv_lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <type_traits>

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

/// Product of polynomials.
template <std::size_t A, std::size_t B>
std::array<double, A + B - 1> Times(const std::array<double, A>& a,
                                    const std::array<double, B>& b) {
  std::array<double, A + B - 1> product{};
  for (std::size_t i = 0; i < A; ++i) {
    for (std::size_t j = 0; j < B; ++j) {
      product[i + j] += a[i] * b[j];
    }
  }
  return product;
}

/// Adds `factor` t^shift b to the polynomial a.
template <std::size_t A, std::size_t B>
void AddTo(std::array<double, A>& a, const std::array<double, B>& b, double factor,
           std::size_t shift = 0) {
  static_assert(A >= B);
  for (std::size_t i = 0; i < B; ++i) {
    a[i + shift] += factor * b[i];
  }
}

/// In s: N D + 2 s (N' D - N D'), which is D^2 times the slope of r N(r^2)/D(r^2).
std::array<double, 7> RadialGrowth(const std::array<double, 4>& n, const std::array<double, 4>& d) {
  std::array<double, 7> growth{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const double order = 1 + 2 * (static_cast<double>(i) - static_cast<double>(j));
      growth[i + j] += order * n[i] * d[j];
    }
  }
  return growth;
}

/// True when the radial slope is over `margin` from the axis to s = r^2; a margin over 0 is bounded
/// roughly, so that false then only means unknown.
bool RadialSlopeExceeds(const OpenCvModel& model, double s, double margin) {
  const std::array<double, 4> n = Numerator(model);
  if (model.coefficients < 8) {
    std::array<double, 4> slope = RadialSlope(n);
    slope[0] -= margin;
    return PositiveOn(slope, s);
  }
  const std::array<double, 4> d = Denominator(model);
  std::array<double, 7> growth = RadialGrowth(n, d);
  const double most = 1 + s * (std::abs(d[1]) + s * (std::abs(d[2]) + s * std::abs(d[3])));
  growth[0] -= margin * most * most;  // D is at most that
  return PositiveOn(d, s) && PositiveOn(growth, s);
}

/// T, the part of the derivative that the tangential and the thin-prism terms make, is at the
/// point t u of the segment from the axis to u: t T1 + t^3 T3.
struct SidewaysSlope {
  Eigen::Matrix2d T1;
  Eigen::Matrix2d T3;
};

SidewaysSlope SidewaysSlopeAt(const OpenCvModel& m, const Eigen::Vector2d& u) {
  const double p1 = m.k[2];
  const double p2 = m.k[3];
  SidewaysSlope slope;
  slope.T1 << 2 * p1 * u.y() + 6 * p2 * u.x(), 2 * p1 * u.x() + 2 * p2 * u.y(),
      2 * p1 * u.x() + 2 * p2 * u.y(), 6 * p1 * u.y() + 2 * p2 * u.x();
  slope.T1 += 2 * Eigen::Vector2d(m.k[8], m.k[10]) * u.transpose();
  slope.T3 = 4 * u.squaredNorm() * Eigen::Vector2d(m.k[9], m.k[11]) * u.transpose();
  return slope;
}

/// True when the derivative J keeps orientation on the whole segment from the axis to u.
///   J = g I + 2 g' u u^T + T,  det J = g h + h tr T - 2 g' u^T T u + det T,  h = g + 2 s g'
/// With g = N/D, h = G/D^2 and g' = W/D^2 the product D^3 det J is a polynomial of t:
///   N G + D (G tr T - 2 W u^T T u) + D^3 det T
bool SegmentKeepsOrientation(const OpenCvModel& model, const Eigen::Vector2d& u) {
  const double s = u.squaredNorm();
  const auto in_t = [s](const auto& c) {  // from s to t: the square of t u is t^2 s
    std::array<double, 2 * std::tuple_size_v<std::decay_t<decltype(c)>> - 1> out{};
    double power = 1;
    for (std::size_t i = 0; i < c.size(); ++i, power *= s) {
      out[2 * i] = c[i] * power;
    }
    return out;
  };
  const std::array<double, 4> n = Numerator(model);
  const std::array<double, 4> d =
      model.coefficients < 8 ? std::array<double, 4>{1, 0, 0, 0} : Denominator(model);
  const auto slope_of = [](const std::array<double, 4>& c) {
    return std::array<double, 3>{c[1], 2 * c[2], 3 * c[3]};
  };
  std::array<double, 6> w = Times(slope_of(n), d);
  AddTo(w, Times(n, slope_of(d)), -1);
  const auto N = in_t(n);
  const auto D = in_t(d);
  const auto G = in_t(RadialGrowth(n, d));
  const auto W = in_t(w);
  const SidewaysSlope T = SidewaysSlopeAt(model, u);
  const std::array<double, 4> trace = {0, T.T1.trace(), 0, T.T3.trace()};
  const std::array<double, 4> quadratic = {0, u.dot(T.T1 * u), 0, u.dot(T.T3 * u)};
  const double mixed = T.T1(0, 0) * T.T3(1, 1) + T.T3(0, 0) * T.T1(1, 1) - T.T1(0, 1) * T.T3(1, 0) -
                       T.T3(0, 1) * T.T1(1, 0);
  const std::array<double, 7> determinant = {0,     0, T.T1.determinant(), 0,
                                             mixed, 0, T.T3.determinant()};
  std::array<double, 25> all{};
  AddTo(all, Times(N, G), 1);
  AddTo(all, Times(D, Times(G, trace)), 1);
  AddTo(all, Times(D, Times(W, quadratic)), -2, 2);  // u^T T u at t u
  AddTo(all, Times(D, Times(D, Times(D, determinant))), 1);
  constexpr int kHalvings = 10;  // poles of D make the product flat
  return PositiveOn(all, 1, kHalvings);
}

/// True when nothing folds between the axis and u. Cheap where the sideways terms are small: |T|
/// is at most 6 |p| r + 2 r |prism|, and J is regular while the radial slope, of which g is the
/// mean, exceeds that.
bool IsInRange(const OpenCvModel& model, const Eigen::Vector2d& u) {
  const double s = u.squaredNorm();
  const auto& k = model.k;
  const double tangential = std::abs(k[2]) + std::abs(k[3]);
  const double prism =
      std::abs(k[8]) + std::abs(k[10]) + 2 * s * (std::abs(k[9]) + std::abs(k[11]));
  const double sideways = (1 + s) * (3 * tangential + prism);  // 2 r <= 1 + s: no roots
  if (RadialSlopeExceeds(model, s, sideways)) {
    return true;
  }
  return sideways > 0 && RadialSlopeExceeds(model, s, 0) && SegmentKeepsOrientation(model, u);
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
  if (!IsInRange(model, u)) {
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
    const Eigen::Matrix3d tilt = TiltMatrix(k[12], k[13]);
    const Eigen::Vector3d tilted = tilt * out.point.homogeneous();
    if (!(tilted.z() > 0)) {
      return std::nullopt;
    }
    const Eigen::Vector2d seen = tilted.hnormalized();
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
