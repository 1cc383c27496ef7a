#include "engine/tracking/camera_resection.h"

#include <algorithm>
#include <cmath>

#include "engine/core/median.h"
#include "engine/core/rotation_vector.h"
#include "engine/tracking/view_geometry.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix26d = Eigen::Matrix<double, 2, 6>;

constexpr int kMinLandmarks = 4;
constexpr double kHuber = 1.345;
constexpr double kTukey = 4.685;
constexpr int kHuberIterations = 3;
constexpr double kMinDepth_m = 0.05;
constexpr double kBehind = 1e6;  // residual of a landmark behind the camera, in sigmas

/// One landmark under the present pose: residual and derivative, in sigmas.
struct Term {
  Vector2d residual = Vector2d::Zero();
  Matrix26d jacobian = Matrix26d::Zero();
  double size = kBehind;  ///< |residual|
  double sigma_px = 1;
};

Term Evaluate(const GroundLandmark& landmark, const PinholeCamera& camera,
              const RigidTransform& X_WC) {
  Term term;
  const Vector3d p_C = X_WC.R.transpose() * (landmark.p_WF - X_WC.p);
  if (!(p_C.z() > kMinDepth_m)) {
    return term;
  }
  const double u = p_C.x() / p_C.z();
  const double v = p_C.y() / p_C.z();
  const double spread = camera.fx_px * landmark.sigma_w_m / p_C.z();
  term.sigma_px = std::max(std::hypot(landmark.sigma_px, spread), 1e-6);
  const Vector2d predicted(camera.fx_px * u + camera.cx_px, camera.fy_px * v + camera.cy_px);
  term.residual = (landmark.pixel - predicted) / term.sigma_px;
  term.size = term.residual.norm();
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << camera.fx_px / p_C.z(), 0, -camera.fx_px * u / p_C.z(),  //
      0, camera.fy_px / p_C.z(), -camera.fy_px * v / p_C.z();
  by_point /= term.sigma_px;
  // p_C = R' (p - p_WC); turning R to R exp(d) moves p_C by p_C x d.
  term.jacobian.leftCols<3>() = -by_point * X_WC.R.transpose();
  term.jacobian.rightCols<3>() = by_point * CrossMatrix(p_C);
  return term;
}

/// Robust spread of 2-D residuals: the median of a Rayleigh variable is 1.1774 sigma. At least 1.
double Scale(const std::vector<Term>& terms) {
  std::vector<double> sizes;
  for (const Term& term : terms) {
    sizes.push_back(term.size);
  }
  return std::clamp(UpperMedian(sizes) / 1.1774, 1.0, 1e3);
}

double Weight(double size, double scale, bool settled) {
  const double r = size / scale;
  if (!settled) {
    return r <= kHuber ? 1.0 : kHuber / r;
  }
  const double t = 1 - (r / kTukey) * (r / kTukey);
  return t > 0 ? t * t : 0.0;
}

/// Known attitude: each ray is a line through the camera; the nearest point to all lines, weighted
/// against outliers by Cauchy's weight in several passes.
Result<Vector3d> LinearPosition(const std::vector<GroundLandmark>& landmarks,
                                const PinholeCamera& camera, const Matrix3d& R_WC) {
  std::vector<double> weight(landmarks.size(), 1.0);
  std::vector<double> miss(landmarks.size(), 0.0);
  Vector3d p_WC = Vector3d::Zero();
  for (int pass = 0; pass < 6; ++pass) {
    Matrix3d A = Matrix3d::Zero();
    Vector3d b = Vector3d::Zero();
    double total = 0;
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Vector3d u = (R_WC * RayFromPixel(camera, landmarks[i].pixel)).normalized();
      const Matrix3d across = weight[i] * (Matrix3d::Identity() - u * u.transpose());
      A += across;
      b += across * landmarks[i].p_WF;
      total += weight[i];
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(A);
    if (!(solver.eigenvalues().x() > 1e-7 * total)) {
      return InvalidError("landmarks lie in one direction: they do not fix the camera's position");
    }
    p_WC = A.ldlt().solve(b);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Vector3d u = (R_WC * RayFromPixel(camera, landmarks[i].pixel)).normalized();
      miss[i] = u.cross((landmarks[i].p_WF - p_WC).normalized()).norm();
    }
    std::vector<double> sorted = miss;
    const double scale = std::max(UpperMedian(sorted), 1e-9);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      weight[i] = 1 / (1 + miss[i] * miss[i] / (4 * scale * scale));
    }
  }
  return p_WC;
}

struct Normal {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
};

Normal BuildNormal(const std::vector<Term>& terms, double scale, bool settled,
                   const Vector3d& theta, double attitude_sigma_rad) {
  Normal normal;
  for (const Term& term : terms) {
    if (term.size >= kBehind) {
      continue;
    }
    const double w = Weight(term.size, scale, settled);
    normal.H += w * term.jacobian.transpose() * term.jacobian;
    normal.g += w * term.jacobian.transpose() * term.residual;
  }
  if (attitude_sigma_rad > 0) {
    const double information = 1 / (attitude_sigma_rad * attitude_sigma_rad);
    normal.H.bottomRightCorner<3, 3>() += information * Matrix3d::Identity();
    normal.g.tail<3>() -= information * theta;
  } else {
    normal.H.bottomRows<3>().setZero();
    normal.H.rightCols<3>().setZero();
    normal.H.bottomRightCorner<3, 3>().setIdentity();
    normal.g.tail<3>().setZero();
  }
  return normal;
}

std::vector<Term> EvaluateAll(const std::vector<GroundLandmark>& landmarks,
                              const PinholeCamera& camera, const RigidTransform& X_WC) {
  std::vector<Term> terms;
  terms.reserve(landmarks.size());
  for (const GroundLandmark& landmark : landmarks) {
    terms.push_back(Evaluate(landmark, camera, X_WC));
  }
  return terms;
}

Result<Resection> Summarise(const std::vector<Term>& terms, const RigidTransform& X_WC,
                            const Normal& normal, double scale, double attitude_sigma_rad) {
  Resection result;
  result.X_WC = X_WC;
  double sum_px2 = 0;
  double sum_sigma2 = 0;
  for (const Term& term : terms) {
    const bool inlier = term.size < kTukey * scale;
    result.inlier.push_back(inlier);
    if (inlier) {
      ++result.inliers;
      sum_px2 += term.size * term.size * term.sigma_px * term.sigma_px;
      sum_sigma2 += term.size * term.size;
    }
  }
  if (result.inliers < kMinLandmarks) {
    return InvalidError("only " + std::to_string(result.inliers) + " of " +
                        std::to_string(terms.size()) + " landmarks agree on a camera position");
  }
  result.rms_px = std::sqrt(sum_px2 / result.inliers);
  // Residuals larger than their sigmas say the sigmas were too small; smaller is luck.
  const int unknowns = attitude_sigma_rad > 0 ? 6 : 3;
  const double spare = std::max(2 * result.inliers - unknowns, 1);
  const double inflate = std::max(1.0, sum_sigma2 / spare);
  const Matrix6d covariance = normal.H.ldlt().solve(Matrix6d::Identity());
  result.covariance_m2 = inflate * covariance.topLeftCorner<3, 3>();
  if (!result.covariance_m2.allFinite() || !X_WC.p.allFinite()) {
    return InvalidError("the landmarks do not fix the camera's position");
  }
  return result;
}

}  // namespace

Result<Resection> ResectCamera(const std::vector<GroundLandmark>& landmarks,
                               const PinholeCamera& camera, const Matrix3d& R_WC_prior,
                               const ResectionOptions& options) {
  if (landmarks.size() < static_cast<std::size_t>(kMinLandmarks)) {
    return InvalidError(std::to_string(landmarks.size()) + " landmarks, at least 4 are needed");
  }
  const Result<Vector3d> start = LinearPosition(landmarks, camera, R_WC_prior);
  if (!start) {
    return start.error();
  }
  RigidTransform X_WC{R_WC_prior, *start};
  Normal normal;
  double scale = 1;
  for (int i = 0; i < options.max_iterations; ++i) {
    const std::vector<Term> terms = EvaluateAll(landmarks, camera, X_WC);
    scale = Scale(terms);
    const bool settled = i >= kHuberIterations;
    normal = BuildNormal(terms, scale, settled, VectorFromRotation(R_WC_prior.transpose() * X_WC.R),
                         options.attitude_sigma_rad);
    const Vector6d step = normal.H.ldlt().solve(normal.g);
    if (!step.allFinite()) {
      return InvalidError("the landmarks do not fix the camera's position");
    }
    X_WC.p += step.head<3>();
    X_WC.R = X_WC.R * RotationFromVector(step.tail<3>());
    if (settled && step.head<3>().norm() < 1e-10 && step.tail<3>().norm() < 1e-12) {
      break;
    }
  }
  const std::vector<Term> terms = EvaluateAll(landmarks, camera, X_WC);
  scale = Scale(terms);
  normal = BuildNormal(terms, scale, true, VectorFromRotation(R_WC_prior.transpose() * X_WC.R),
                       options.attitude_sigma_rad);
  return Summarise(terms, X_WC, normal, scale, options.attitude_sigma_rad);
}

}  // namespace palace
