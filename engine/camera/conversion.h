// A camera of one lens family as a camera of another.
//
// Where the families allow it the conversion is exact (CAHV to CAHVOR, CAHVOR to CAHVORE type 1, a
// pinhole to anything). Otherwise the target is refitted: pixels of a grid over the picture are
// back-projected through the source, and rotation, focal lengths, centre and distortion of the
// target are set so that it projects the same rays, taken from far away, to the same pixels:
//
//   minimise sum_i |project_target(ray_i) - pixel_i|^2      (Levenberg 1944, Marquardt 1963)
//
// Larger families begin at the answer of the smaller ones they contain and are never worse; weak
// priors keep turn and centre where pixels do not decide (conversion_fit.h). Rays that the target
// cannot reach are given up only where the rest of the picture gains more, and are counted.
//
// The projection centre stays. To CAHV the model of LinearizeCamera is taken, not a fit: its
// pictures are resampled ones, and the residual is how far pixels then move. The residual is
// measured on another, denser grid with the picture's corners; of several ends of the fit the one
// that is best there counts.
#pragma once

#include <optional>
#include <string>

#include "engine/camera/camera_model.h"
#include "engine/core/result.h"

namespace palace {

enum class LensFamily {
  kCahv,
  kCahvor,
  kCahvore,
  kTsai,
  kPinhole,
  kOpenCv4,
  kOpenCv5,
  kOpenCv8,
  kOpenCv12,
  kFisheye,
};

/// "cahv", "cahvor", "cahvore", "tsai", "pinhole", "opencv4", ... as palacectl names them.
const char* LensFamilyName(LensFamily family);
std::optional<LensFamily> LensFamilyFromName(const std::string& name);

/// How far two cameras place the same rays apart, over the pixels of the first.
struct Residual {
  double rms_px = 0;
  double max_px = 0;
  Eigen::Vector2d worst_pixel = Eigen::Vector2d::Zero();
  int pixels = 0;       ///< compared
  int without_ray = 0;  ///< pixels of the grid for which the first has no ray
  int unseen = 0;       ///< rays that the second does not project; not in rms and max

  /// Share of the picture, 0 to 1, that the second camera does not see.
  double UnseenShare() const { return unseen > 0 ? 1.0 * unseen / (unseen + pixels) : 0; }
};

/// Rays are taken from far away. The cameras share F and the unit of length; `from` has a size.
Residual ResidualOf(const CameraModel& from, const CameraModel& to);

struct ConvertedCamera {
  CameraModel model;
  Residual residual;
  double lost_shear_px = 0;  ///< row shear K(1,0) that the target family cannot hold
  double lost_pupil_m = 0;   ///< greatest way of the entrance pupil that the target cannot hold
};

/// Lengths of the result are metres unless the model already is of the family. Refuses cameras
/// without a size, pictures of which half has no ray, and rays at or behind the focal plane of a
/// family with one.
Result<ConvertedCamera> ConvertCamera(const CameraModel& source, LensFamily family);

}  // namespace palace
