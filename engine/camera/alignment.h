// Linear (CAHV) models for pictures still to be resampled: of one camera, and of a stereo pair with
// rows along the epipolar lines.
//
// Extents follow JPL's library: a side of the picture is seen through its two corners and the point
// opposite the image centre (hc, vc); the tangent of that ray along rows or columns decides, the
// least one inside, the greatest one covering. Rays nearer than 15 degrees to the new image plane
// count as 15 degrees. Columns 0 and width - 1 (rows likewise) are put on the extents found.
// Distorted sides may bulge past the three points; JPL accepts that, and so do we.
//
// Source: NASA-AMMOS/VICAR, cahvor library, functions as named below; rules only, own code.
#pragma once

#include "engine/camera/camera_model.h"
#include "engine/core/result.h"

namespace palace {

/// Which rays the new picture keeps.
enum class FieldOfView {
  kInside,    ///< every pixel has a source (JPL minfov = 1)
  kCovering,  ///< every source pixel keeps a place (JPL minfov = 0)
};

/// The CAHV model with the centre, image plane and row and column directions of `camera`'s linear
/// part. CAHVORE: rays are taken as if the pupil stood still, which is exact for far points.
/// `size` is that of the new picture; 0 takes the camera's.
/// Refuses cameras without a size and picture borders without a ray.
/// Source: cmod_cahvor_warp_model, cmod_cahvore_warp_model.
Result<CahvorModel> LinearizeCamera(const CameraModel& camera,
                                    FieldOfView field = FieldOfView::kInside,
                                    PictureSize size = {});

/// Two CAHV models with the same A, H, V and their own C: rows are epipolar lines and
/// disparity = hs b / depth, exactly, however the cameras stood.
struct AlignedPair {
  CahvorModel left;
  CahvorModel right;
};

/// How JPL aligns a pair. Rows lie along the baseline in each.
enum class AlignmentForm {
  kNormals,  ///< newer: axis = mean of the two axes made perpendicular (cmod_cahvor_warp_models2)
  kColumns,  ///< older: columns = mean of the two column directions (cmod_cahvor_warp_models)
  kAverage,  ///< CAHV: mean scale and centre, no look at the pictures (cmod_cahv_warp_models)
};

struct AlignmentOptions {
  AlignmentForm form = AlignmentForm::kNormals;
  FieldOfView field = FieldOfView::kInside;  ///< not used by kAverage
  PictureSize size;                          ///< of the new pictures; 0 takes the left one's
};

/// Aligns a pair whose models share the frame F and the unit of length. Each camera's own size
/// counts. Refuses cameras without a size (kAverage needs none) or baseline, axes along the
/// baseline or more than 150 degrees apart, picture borders without a ray, and views that do not
/// overlap.
Result<AlignedPair> AlignPair(const CameraModel& left, const CameraModel& right,
                              const AlignmentOptions& options = {});

/// Greatest difference of rows over 1323 points in front of both cameras, 2 to 200 baselines away.
double WorstRowError(const AlignedPair& pair);

}  // namespace palace
