// What moved between frames: people, animals, vehicles.
//
// The picture of half a second to a second ago is compared with the new one block by block: each
// block's point is looked up in the older view with the camera's pose then and now, and what the
// pose leaves over as a shift of the whole picture is taken out. A block moved when
//   - the older camera saw through the point: all it measured around it lies clearly behind; or
//   - the surface is the same, but its brightness is outside all of the older block's neighbours.
// Both forgive a block of misplacement either way, so leaves and grass in the wind rarely count.
// Ground that comes into view from behind an object is not compared.
#pragma once

#include <deque>

#include "engine/slad/pictures/scene_ground.h"

namespace palace {

class SceneMotion {
 public:
  void Reset() { views_.clear(); }
  /// Sets kFlagMotion in `flags`, a value a block, and remembers the view. False when there was no
  /// older view to compare with.
  bool Flag(const SceneView& view, const SceneGround& ground, ImageU8& flags);

 private:
  struct OldView {
    Timestamp time;
    RigidTransform X_WC;
    ImageF grey;     ///< block means
    ImageF depth_m;  ///< of blocks; NaN where unknown
  };
  void Remember(OldView view);

  std::deque<OldView> views_;  ///< at most two, oldest first
};

}  // namespace palace
