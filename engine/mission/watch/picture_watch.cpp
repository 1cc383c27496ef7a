#include "engine/mission/watch/picture_watch.h"

#include "engine/mission/limits.h"

namespace palace {
namespace {

/// "Left camera does", "Both cameras do"; empty when neither does.
std::string Of(bool left, bool right, const char* one, const char* both) {
  return left && right ? std::string("Both cameras ") + both
         : left        ? std::string("Left camera ") + one
         : right       ? std::string("Right camera ") + one
                       : std::string();
}

}  // namespace

std::string PictureFaults::frozen_words() const {
  return Of(left_frozen, right_frozen, "repeats its picture", "repeat their pictures");
}

std::string PictureFaults::blank_words() const {
  return Of(left_blank, right_blank, "shows nothing", "show nothing");
}

std::string PictureFaults::words() const {
  // A black picture repeats itself too: what it shows is the better name.
  return blank()      ? blank_words()
         : frozen()   ? frozen_words()
         : swapped    ? "Left and right camera look exchanged"
         : rows_apart ? "Rows of the pictures do not fit: not calibrated, or not exposed together"
                      : "";
}

PictureFaults JudgePictures(const StereoQuality& stereo, SessionRole role) {
  // A folder repeats its last pair for ever, and a paused film its picture.
  const bool live = !HasPicturesOnly(role);
  return {.left_frozen = live && stereo.left_frozen && !stereo.left_blank,
          .right_frozen = live && stereo.right_frozen && !stereo.right_blank,
          .left_blank = stereo.left_blank,
          .right_blank = stereo.right_blank,
          .swapped = stereo.suspect_swapped,
          .rows_apart = stereo.row_error_px > AlarmLimits::row_error_px};
}

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
