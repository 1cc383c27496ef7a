// Worlds with a known answer for calibration tests: what the cameras of a session would observe,
// and how far a calibration is from the truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/calibration/calibration.h"
#include "engine/calibration/lens.h"
#include "engine/calibration/rig_difference.h"
#include "engine/core/check.h"
#include "engine/core/random.h"
#include "engine/simulation/calibration_session.h"

namespace palace::calibration_world {

/// The session's rig and board poses in the form that is fitted.
inline RigEstimate TruthOf(const CalibrationSession& session) {
  RigEstimate truth = RigFromModels(session.left, session.right);
  RigidTransform X_FC0;
  LensFromCahvor(session.left, X_FC0);
  for (const RigidTransform& X_FT : session.X_FT) {
    truth.X_C0T.push_back(X_FC0.Inverse() * X_FT);
  }
  return truth;
}

/// The dots' centroids with normal noise, no pictures in between.
inline std::vector<TargetView> Observe(const CalibrationTarget& target, const RigEstimate& truth,
                                       double noise_px, std::uint64_t seed) {
  RandomStream random(seed, "observations");
  std::vector<TargetView> views;
  for (std::size_t v = 0; v < truth.X_C0T.size(); ++v) {
    TargetView view;
    view.name = "view " + std::to_string(v);
    for (const int side : {0, 1}) {
      const RigidTransform X_CT =
          side == 0 ? truth.X_C0T[v] : truth.X_C0C1.Inverse() * truth.X_C0T[v];
      for (int k = 0; k < target.point_count(); ++k) {
        const auto at = ProjectDot(truth.lens[static_cast<std::size_t>(side)], X_CT, target.p_TQ(k),
                                   target.DotDiameter_m(k));
        PALACE_CHECK(at.has_value());
        (side == 0 ? view.left : view.right)
            .push_back(
                {k, at->pixel + noise_px * Eigen::Vector2d(random.Normal(), random.Normal())});
      }
    }
    views.push_back(view);
  }
  return views;
}

inline CalibrationOptions Options() {
  CalibrationOptions options;
  options.width = 640;
  options.height = 480;
  return options;
}

inline int CountInside(const CameraVector& error, const CameraMatrix& covariance, double sigmas) {
  int inside = 0;
  for (int i = 0; i < kCameraSize; ++i) {
    inside += std::abs(error[i]) <= sigmas * std::sqrt(covariance(i, i)) ? 1 : 0;
  }
  return inside;
}

}  // namespace palace::calibration_world
