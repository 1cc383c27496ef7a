#include "engine/model/mission/picture_faults.h"

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
          .rows_apart = stereo.row_error_px > kMostRowError_px};
}

}  // namespace palace
