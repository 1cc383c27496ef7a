// What a stereo pair itself says against its cameras: for the mission, for tracking, and for panels
// that show the pair.
#pragma once

#include <string>

#include "engine/model/mission/session_role.h"
#include "engine/model/range_map.h"

namespace palace {

/// Rows of a pair that lie farther apart fit no calibration, or no common exposure.
inline constexpr double kMostRowError_px = 0.5;  // a good calibration has 0.2

/// What one pair looks like.
struct PictureFaults {
  bool left_frozen = false, right_frozen = false;  ///< the camera repeats its picture
  bool left_blank = false, right_blank = false;    ///< dark, covered or washed out
  bool swapped = false;                            ///< left and right look exchanged
  bool rows_apart = false;                         ///< not calibrated, or not exposed together

  bool frozen() const { return left_frozen || right_frozen; }
  bool blank() const { return left_blank || right_blank; }
  /// The first of them in words: "Right camera shows nothing"; empty when there is none.
  std::string words() const;
  std::string frozen_words() const;
  std::string blank_words() const;
};
/// A black picture is blank, not frozen; pictures on disk and paused film may stand still.
PictureFaults JudgePictures(const StereoQuality& stereo, SessionRole role);

}  // namespace palace
