// When the scale has changed so much that an anchor is cut anew: the texture that a template, a
// patch or a keyframe was cut from is then no longer what the picture shows.
#pragma once

namespace palace {

/// Pixels now per pixel of the anchor, or the other way round: half an octave. From here on a new
/// one is cut, if what is seen is good enough to be an anchor.
inline constexpr double kNewAnchorZoom = 1.4;
/// An octave, nearly: there is nothing left to compare, and a poor anchor is better than this one.
inline constexpr double kForcedAnchorZoom = 1.9;

}  // namespace palace
