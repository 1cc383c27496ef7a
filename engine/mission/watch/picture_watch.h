// PictureWatch: what the pictures themselves say against the cameras (guard G3).
//
// A single pair may look wrong by chance: a fault stands after three pairs in a row, and goes the
// same way. No sensor gives one picture twice: three repeated ones of ten are a fault, and it
// stands until at most one of twenty is.
#pragma once

#include "engine/mission/watch/persistence.h"
#include "engine/mission/watch/recurrence.h"
#include "engine/model/mission/picture_faults.h"

namespace palace {

class PictureWatch {
 public:
  void Update(const PictureFaults& faults);
  PictureFaults standing() const;

 private:
  Recurrence left_frozen_, right_frozen_;
  Persistence left_blank_, right_blank_, swapped_, rows_apart_;
};

}  // namespace palace
