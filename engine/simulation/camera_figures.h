// CameraFigures: what goes wrong in the cameras of a simulated vehicle, as its file says.
//
//   light   the scene through the lens (RigCamera), mean of `exposure_samples` moments of the
//           exposure, rows in `shutter_bands` each at the time of its middle
//   signal  gain * vignetting(blur(light)); the right camera's times brightness_gain_right
//   grey    round(signal + shot noise + offset + read noise), held at 0 and 255
//
// Stamps are the middle of what the left camera exposes; a pair comes once both have been exposed,
// and `latency_s` after that. All 0 here: an ideal camera, whose picture is of the moment it comes.
#pragma once

namespace palace {

struct CameraFigures {
  double noise_grey = 0;             ///< read noise, standard deviation, grey levels
  double brightness_gain_right = 1;  ///< of the right camera relative to the left
  double gain = 1;                   ///< of both
  double offset_left_grey = 0;       ///< black level
  double offset_right_grey = 0;
  double full_well_electrons = 0;  ///< that make grey 255: shot noise; 0: none
  double blur_px = 0;              ///< of the lens, standard deviation
  double vignetting = 0;           ///< share of light that the corners lack
  double exposure_s = 0;           ///< 0: an instant, no motion blur
  int exposure_samples = 4;        ///< of an exposure that is no instant
  double line_delay_s = 0;         ///< from a row to the next; 0: a global shutter
  int shutter_bands = 8;           ///< of a rolling shutter: rows drawn at one time
  double right_late_s = 0;         ///< the right camera begins so much after the left one
  double latency_s = 0;            ///< from the end of exposure until the station has the pair
  double dropped = 0;              ///< share of pairs that never come
  double repeated = 0;             ///< share of a camera's pictures that are the one before again
};

}  // namespace palace
