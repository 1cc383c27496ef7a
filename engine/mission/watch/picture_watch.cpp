#include "engine/mission/watch/picture_watch.h"

namespace palace {

void PictureWatch::Update(const PictureFaults& faults) {
  left_frozen_.Add(faults.left_frozen);
  right_frozen_.Add(faults.right_frozen);
  left_blank_.Add(faults.left_blank);
  right_blank_.Add(faults.right_blank);
  swapped_.Add(faults.swapped);
  rows_apart_.Add(faults.rows_apart);
}

PictureFaults PictureWatch::standing() const {
  return {.left_frozen = left_frozen_.on(),
          .right_frozen = right_frozen_.on(),
          .left_blank = left_blank_.on(),
          .right_blank = right_blank_.on(),
          .swapped = swapped_.on(),
          .rows_apart = rows_apart_.on()};
}

}  // namespace palace
