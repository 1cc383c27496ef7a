// Health of a stereo pass, measured from the pictures themselves.
#pragma once

#include "engine/model/image.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"
#include "engine/stereo/stereo.h"

namespace palace {

/// Fills row_error_px, row_shift_px and row_spread_px: over textured points, the vertical shift at
/// which the right picture fits best; median of its absolute value, median and spread (1.48 times
/// the median distance from the median). A calibrated pair has a row error below 0.3 px. NaN below
/// 20 points. Each point compares a 9x9 patch at its own disparity, up to 2 rows up and down,
/// parabola through the least squared differences.
void MeasureRowError(const ImageU8& left, const ImageU8& right, const ImageF& disparity_px,
                     StereoQuality& quality);

/// Fills exposure_ratio (mean grey of the right picture over that of the left; NaN when the left
/// one is black), left_blank, right_blank, suspect_covered and suspect_same. Same size pictures.
/// Blank: less contrast than the camera's noise (3 grey levels), or more than half of the pixels
/// black or white to the end of the scale.
void SuspectPictures(const ImageU8& left, const ImageU8& right, StereoQuality& quality);

/// True when a band across the picture matches with left and right exchanged, and does not as
/// given.
bool LooksSwapped(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                  const StereoSettings& settings);

/// Coverage, median sigma and median depth (NaN when nothing matched).
void SummariseRange(const RangeMap& range, StereoQuality& quality);

}  // namespace palace
