// PictureWatch: what the pictures themselves say against the cameras (guard G3).
//
// A single pair may look wrong by chance: a fault stands after three pairs in a row, and goes the
// same way.
#pragma once

#include <cstdint>

#include "engine/mission/watch/persistence.h"
#include "engine/model/mission/session_role.h"
#include "engine/model/range_map.h"

namespace palace {

/// What one pair looks like.
struct PictureFaults {
  bool frozen = false;      ///< a camera repeats its picture to the last grey level
  bool swapped = false;     ///< left and right look exchanged
  bool rows_apart = false;  ///< the calibration does not fit: AlarmLimits::row_error_px
};
PictureFaults JudgePictures(const StereoQuality& stereo, SessionRole role);

enum class CameraProblem : std::uint8_t { kNone, kFrozen, kSwapped, kRowsApart };

class PictureWatch {
 public:
  void Update(const PictureFaults& faults);
  PictureFaults standing() const { return {frozen_.on(), swapped_.on(), rows_apart_.on()}; }
  /// The first that stands, in the order of the enum.
  CameraProblem problem() const;

 private:
  Persistence frozen_, swapped_, rows_apart_;
};

}  // namespace palace
