// Range map: what stereo knows about each pixel of the rectified left image, and from where.
#pragma once

#include <limits>
#include <optional>

#include "engine/core/time.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"
#include "engine/model/view_pose.h"

namespace palace {

/// All images have the size of the rectified left image. NaN where unknown.
struct RangeMap {
  Timestamp time;
  PinholeCamera camera;       ///< rectified left camera the pixels belong to
  ImageF disparity_px;        ///< left x minus right x, sub-pixel
  ImageF disparity_sigma_px;  ///< one standard deviation
  ImageF depth_m;             ///< along the optical axis: f b / disparity
  ImageF depth_sigma_m;       ///< depth^2 sigma_d / (f b)
  double baseline_m = std::numeric_limits<double>::quiet_NaN();  ///< between the two cameras
  /// Of the rectified left camera at `time`; nothing where it is unknown: such ranges make no map.
  std::optional<ViewPose> pose{};

  /// f b, pixels times metres: depth times disparity.
  double FocalTimesBaseline() const { return camera.fx_px * baseline_m; }
};

/// Stereo depth over laser depth, from the last pairs. NaN while too few pairs were compared.
struct RangeAgreement {
  double ratio = std::numeric_limits<double>::quiet_NaN();  ///< 1 when the rig's scale is right
  double sigma = std::numeric_limits<double>::quiet_NaN();  ///< of the ratio
  int pairs = 0;
};

/// Health of one stereo pass.
struct StereoQuality {
  double coverage = 0;  ///< share of pixels with a depth, 0..1
  /// Median |row difference| of matches; NaN when not measured.
  double row_error_px = std::numeric_limits<double>::quiet_NaN();
  double exposure_ratio = 1;  ///< mean brightness right / left
  double median_sigma_px = 0;
  double median_depth_m = 0;     ///< NaN when nothing matched
  bool suspect_swapped = false;  ///< left and right look exchanged
  bool left_frozen = false;      ///< the camera repeats its picture: stereo/frozen_check.h
  bool right_frozen = false;
  bool left_blank = false;  ///< the camera shows nothing: dark, covered or washed out
  bool right_blank = false;
  bool suspect_covered = false;  ///< one picture shows nothing while the other does
  bool suspect_same = false;     ///< left and right are one picture
  /// Median row difference, right minus left, and its spread (1.48 MAD); NaN when not measured.
  double row_shift_px = std::numeric_limits<double>::quiet_NaN();
  double row_spread_px = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace palace
