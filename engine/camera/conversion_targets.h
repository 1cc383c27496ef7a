// Parameters of each lens family for the refit of conversion.h.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/camera/conversion.h"

namespace palace {

/// A family as a function of parameters that are all of the order of 1.
struct ConversionTarget {
  std::function<CameraModel(const Eigen::VectorXd&)> camera;
  Eigen::VectorXd start;
  double focal_px = 1;
  double prior_weight = 1e-3;  ///< of turn and centre, in focal lengths
  bool only_refines = false;   ///< begins at the nested family's answer and nowhere else
};

/// True when the model already is of the family.
bool IsOfFamily(const CameraModel& model, LensFamily family);
/// The camera of the family that projects as `source` does, shear apart, where there is one by
/// form.
std::optional<CameraModel> ConvertedExactly(const CameraModel& source, LensFamily family);
/// Places to start from; the best result counts. Not for kCahv. Distortion terms are counted by
/// what they do at `widest_tangent`, the greatest distance from the axis in the unit image plane.
std::vector<ConversionTarget> ConversionTargets(const CameraModel& source, LensFamily family,
                                                double widest_tangent);
/// The next smaller family whose parameters are the first ones of `family`, the others at the
/// start of its first target being without effect; nothing for the smallest.
std::optional<LensFamily> NestedFamily(LensFamily family);

}  // namespace palace
