// Coherence: how well the current picture still agrees with the anchor, 0 to 1.
//
// Zero-mean normalised cross-correlation of a patch of the anchor picture, warped into the current
// view, against the current picture; max(0, rho). Against the anchor, not against the picture
// before: successive pictures agree also while a track drifts (reference vision.md 4, erratum E26).
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Dense>

#include "engine/model/image.h"

namespace palace {

inline constexpr int kPatchSide_px = 64;

/// Three patches of kPatchSide_px squared: the anchor warped into the current view, the current
/// picture, and their difference (128 = equal, mean and contrast of the anchor matched).
struct PatchComparison {
  double coherence = 0;
  std::shared_ptr<const ImageU8> anchor;
  std::shared_ptr<const ImageU8> current;
  std::shared_ptr<const ImageU8> difference;
};

/// Compares around `centre`, a pixel of the current picture. Pixels outside either picture take the
/// nearest edge. Correlation is of patches smoothed by 5x5, so that sensor noise does not lower it.
PatchComparison ComparePatches(const ImageU8& anchor, const ImageU8& current,
                               const Eigen::Matrix3d& anchor_from_current,
                               const Eigen::Vector2d& centre);
/// From two patches of one size.
PatchComparison ComparePatches(ImageU8 anchor_patch, ImageU8 current_patch);

/// Where in the current picture the patch of the anchor around `centre` (a pixel of the current
/// picture, as predicted) lies really.
struct PatchSearch {
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();  ///< from the prediction
  double coherence = 0;
  double second_coherence = 0;  ///< of the best other place; 0 where there is none
};
PatchSearch SearchPatch(const ImageU8& anchor, const ImageU8& current,
                        const Eigen::Matrix3d& anchor_from_current, const Eigen::Vector2d& centre,
                        int radius_px);

}  // namespace palace
