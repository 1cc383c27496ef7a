// Pictures of before, from places apart: what the vehicle's own motion shows.
#pragma once

#include <deque>

#include "engine/slad/pictures/scene_ground.h"

namespace palace {

/// Binomial 1 4 6 4 1 both ways; the rim takes its nearest pixels.
ImageF SmoothedPicture(const ImageU8& picture);

/// A smoothed left picture.
struct OlderView {
  PinholeCamera camera;
  ViewPose pose;
  ImageF smooth;
};

/// Left pictures from places apart, oldest first; at most four.
class OlderViews {
 public:
  void Reset() { views_.clear(); }
  /// Keeps the view where it was taken elsewhere than the last one kept. Another camera starts
  /// afresh.
  void Remember(const SceneView& view);
  const std::deque<OlderView>& views() const { return views_; }

 private:
  std::deque<OlderView> views_;
};

}  // namespace palace
