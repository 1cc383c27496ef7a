#include "engine/calibration/bundle/bundle_equations.h"

#include <Eigen/Cholesky>

namespace palace {
namespace {

/// Parameters that may not move: a unit row, no gradient.
void Fix(const BundleOptions& options, CameraMatrix& S, CameraVector& gradient) {
  for (int i = 0; i < kCameraSize; ++i) {
    if (!options.free[static_cast<std::size_t>(i)]) {
      S.row(i).setZero();
      S.col(i).setZero();
      S(i, i) = 1;
      gradient[i] = 0;
    }
  }
}

}  // namespace

std::optional<BundleStep> SolveEquations(const NormalEquations& n, const BundleOptions& options,
                                         double damping) {
  CameraMatrix S = n.U;
  S.diagonal() *= 1 + damping;
  CameraVector g = n.gradient;
  std::vector<Eigen::LLT<Pose66>> pose_solvers;
  if (options.poses_free) {
    for (std::size_t v = 0; v < n.V.size(); ++v) {
      Pose66 V = n.V[v];
      V.diagonal() *= 1 + damping;
      pose_solvers.emplace_back(V);
      if (pose_solvers.back().info() != Eigen::Success) {
        return std::nullopt;
      }
      S -= n.W[v] * pose_solvers.back().solve(n.W[v].transpose());
      g -= n.W[v] * pose_solvers.back().solve(n.pose_gradient[v]);
    }
  }
  Fix(options, S, g);
  // Parameters differ by orders of magnitude (px, rad, m): scaled to a unit diagonal.
  const CameraVector scale = S.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::LLT<CameraMatrix> solver(scale.asDiagonal() * S * scale.asDiagonal());
  if (solver.info() != Eigen::Success) {
    return std::nullopt;
  }
  BundleStep step;
  step.camera = scale.asDiagonal() * solver.solve(scale.asDiagonal() * g);
  for (std::size_t v = 0; options.poses_free && v < n.V.size(); ++v) {
    step.poses.push_back(
        pose_solvers[v].solve(n.pose_gradient[v] - n.W[v].transpose() * step.camera));
    if (!step.poses.back().allFinite()) {
      return std::nullopt;
    }
  }
  return step.camera.allFinite() ? std::optional<BundleStep>(step) : std::nullopt;
}

std::optional<CameraMatrix> CameraCovariance(const NormalEquations& n, const BundleOptions& options,
                                             double sigma_px) {
  CameraMatrix S = n.U;
  for (std::size_t v = 0; options.poses_free && v < n.V.size(); ++v) {
    const Eigen::LLT<Pose66> solver(n.V[v]);
    if (solver.info() != Eigen::Success) {
      return std::nullopt;
    }
    S -= n.W[v] * solver.solve(n.W[v].transpose());
  }
  CameraVector unused = CameraVector::Zero();
  Fix(options, S, unused);
  const CameraVector scale = S.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::LLT<CameraMatrix> solver(scale.asDiagonal() * S * scale.asDiagonal());
  if (solver.info() != Eigen::Success) {
    return std::nullopt;
  }
  CameraMatrix covariance = scale.asDiagonal() * solver.solve(CameraMatrix(scale.asDiagonal()));
  covariance *= sigma_px * sigma_px;
  for (int i = 0; i < kCameraSize; ++i) {
    if (!options.free[static_cast<std::size_t>(i)]) {
      covariance.row(i).setZero();
      covariance.col(i).setZero();
    }
  }
  return covariance.allFinite() ? std::optional<CameraMatrix>(covariance) : std::nullopt;
}

}  // namespace palace
