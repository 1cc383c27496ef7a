// Health of a stereo pass, measured from the pictures themselves.
#pragma once

#include "engine/model/image.h"
#include "engine/model/range_map.h"
#include "engine/model/settings.h"
#include "engine/stereo/stereo.h"

namespace palace {

/// Median over textured points of the vertical shift at which the right picture fits best, as an
/// absolute value in pixels; a calibrated pair has less than 0.3. NaN below 20 points. Each point
/// compares a 9x9 patch at its own disparity, up to 2 rows up and down, parabola through the least
/// squared differences.
double MedianRowError(const ImageU8& left, const ImageU8& right, const ImageF& disparity_px);

/// Mean grey of the right picture over mean grey of the left; NaN when the left one is black.
double ExposureRatio(const ImageU8& left, const ImageU8& right);

/// True when a band across the picture matches with left and right exchanged, and does not as
/// given.
bool LooksSwapped(const ImageU8& left, const ImageU8& right, const DisparityWindow& window,
                  const StereoSettings& settings);

/// Coverage, median sigma and median depth (NaN when nothing matched).
void SummariseRange(const RangeMap& range, StereoQuality& quality);

}  // namespace palace
