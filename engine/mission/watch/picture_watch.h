// PictureWatch: what the pictures themselves say against the cameras (guard G3).
//
// A single pair may look wrong by chance: a fault stands after three pairs in a row, and goes the
// same way. No sensor gives one picture twice: three repeated ones of ten are a fault, and it
// stands until at most one of twenty is.
#pragma once

#include <string>

#include "engine/mission/watch/persistence.h"
#include "engine/mission/watch/recurrence.h"
#include "engine/model/mission/session_role.h"
#include "engine/model/range_map.h"

namespace palace {

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
PictureFaults JudgePictures(const StereoQuality& stereo, SessionRole role);

class PictureWatch {
 public:
  void Update(const PictureFaults& faults);
  PictureFaults standing() const;

 private:
  Recurrence left_frozen_, right_frozen_;
  Persistence left_blank_, right_blank_, swapped_, rows_apart_;
};

}  // namespace palace
