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
};

/// True when the model already is of the family.
bool IsOfFamily(const CameraModel& model, LensFamily family);
/// The camera of the family that projects as `source` does, shear apart, where there is one by
/// form.
std::optional<CameraModel> ConvertedExactly(const CameraModel& source, LensFamily family);
/// Places to start from; the best result counts. Not for kCahv.
std::vector<ConversionTarget> ConversionTargets(const CameraModel& source, LensFamily family);

}  // namespace palace
