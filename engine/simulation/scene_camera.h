// SceneCamera: the one small interface through which the simulator asks for pictures.
#pragma once

#include "engine/core/frames.h"
#include "engine/core/result.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"

namespace palace {

class SceneCamera {
 public:
  virtual ~SceneCamera() = default;
  /// Renders what an ideal pinhole camera at X_WC sees of the world it was made for, at a time
  /// after the start, for what moves. Grey, without sensor noise. Called from the simulator's
  /// thread only.
  virtual Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform& X_WC,
                                 double time_s = 0) = 0;
};

}  // namespace palace
