#include "engine/mission/watch/picture_watch.h"

#include "engine/mission/limits.h"

namespace palace {

PictureFaults JudgePictures(const StereoQuality& stereo, SessionRole role) {
  // A folder repeats its last pair for ever, and a paused film its picture.
  return {stereo.suspect_frozen && !HasPicturesOnly(role), stereo.suspect_swapped,
          stereo.row_error_px > AlarmLimits::row_error_px};
}

void PictureWatch::Update(const PictureFaults& faults) {
  frozen_.Add(faults.frozen);
  swapped_.Add(faults.swapped);
  rows_apart_.Add(faults.rows_apart);
}

CameraProblem PictureWatch::problem() const {
  return frozen_.on()       ? CameraProblem::kFrozen
         : swapped_.on()    ? CameraProblem::kSwapped
         : rows_apart_.on() ? CameraProblem::kRowsApart
                            : CameraProblem::kNone;
}

}  // namespace palace
