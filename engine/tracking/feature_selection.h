// Feature selection: the points of a picture that can be tracked best, spread over it.
//
// Shi & Tomasi 1994: both eigenvalues of the gradient matrix large. The smaller eigenvalue is
// computed at half resolution (the exact pixel of a feature does not matter, its texture does),
// then the best point of each neighbourhood is kept, strongest first. What can be followed is set
// by the sensor's noise, not by the strongest point of the picture: beside one tree all of a field
// of snow is faint.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/model/image.h"

namespace palace {

struct FeatureSelectionOptions {
  int max_count = 120;
  double spacing_px = 16;  ///< between any two, the given ones included
  double border_px = 14;   ///< no feature nearer to the edge
};

/// Pixels of the features, strongest first. `taken` are pixels to keep clear of.
std::vector<Eigen::Vector2d> SelectFeatures(const ImageU8& picture,
                                            const std::vector<Eigen::Vector2d>& taken,
                                            const FeatureSelectionOptions& options);

}  // namespace palace
