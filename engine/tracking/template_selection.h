// Template selection: the places of a picture that one template can follow best, best first.
//
// Shi & Tomasi 1994, "Good features to track": the smaller eigenvalue of
//
//   sum over the template of w [gx gx, gx gy; gx gy, gy gy]
//
// is large where the picture changes in both directions. w is a Gaussian a quarter of the template
// wide, so that the texture lies in its middle; gx, gy are grey levels per pixel of the picture
// smoothed by one pixel. A place is refused where its template matches a second place within the
// search window by more than 0.8 (reference vision.md 4): on a fence or a field of furrows the
// tracker would jump by a period. Unlike SelectFeatures (feature_selection.h), which strews many
// points for flow, each of these stands alone.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/model/image.h"

namespace palace {

struct TemplateSelectionOptions {
  int template_px = 41;  ///< side, odd
  int search_px = 32;    ///< half side of the search beyond the template
  int max_count = 10;
  double spacing_px = 41;            ///< between any two
  double max_self_similarity = 0.8;  ///< of the second best place in the window
  int max_tried = 1000;              ///< places asked whether they repeat: 0.2 to 0.5 ms each
};

struct TemplateFeature {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double strength = 0;  ///< smaller eigenvalue, (grey levels per px) squared
  double self_similarity = 0;
};

/// Best first; empty where nothing is fit to be followed. `mask` has the picture's size, or is
/// empty: no feature where it is 0.
std::vector<TemplateFeature> SelectTemplates(const ImageU8& picture,
                                             const TemplateSelectionOptions& options,
                                             const ImageU8& mask = {});

/// Correlation with the best other place within `search_px`, 0 to 1. The template must fit into the
/// picture; the window ends at its edge.
double SelfSimilarity(const ImageU8& picture, const Eigen::Vector2i& pixel, int template_px,
                      int search_px);

}  // namespace palace
