// StereoCameras: what the two cameras of a vehicle deliver, with the errors of CameraFigures.
//
// A pair that comes now was exposed before: its stamp, the middle of what the left camera exposed,
// lies age_s() ago. It is drawn when it comes, at the poses of the history. Reads no clock; each
// error draws from a stream of its own, also for pairs that are dropped, so that switching one on
// changes no other. The left picture is read out while the right one is drawn.
#pragma once

#include <memory>

#include "engine/core/random.h"
#include "engine/core/result.h"
#include "engine/model/frame_bundle.h"
#include "engine/simulation/camera_figures.h"
#include "engine/simulation/camera_noise.h"
#include "engine/simulation/picture_tiles.h"
#include "engine/simulation/pose_history.h"
#include "engine/simulation/scene_camera.h"
#include "engine/simulation/vehicle_description.h"

namespace palace {

class StereoCameras {
 public:
  /// `start`: when what moves in the scene begins to.
  StereoCameras(const VehicleDescription& vehicle, Timestamp start, std::uint64_t seed);

  /// Other cameras from the next pair on, with the errors of those before.
  void SetRig(const StereoRig& rig);
  /// Of the stamp of a pair when it comes.
  double age_s() const;
  /// The pair that comes at `now`; null when it was dropped. The scene camera's error.
  Result<std::shared_ptr<const StereoFrame>> Deliver(SceneCamera& scene, const PoseHistory& history,
                                                     Timestamp now);

 private:
  struct Side {
    RigCamera camera;
    RigidTransform X_C0C;
    double late_s = 0;
    CameraNoise noise;
    RandomStream repeats;
    std::vector<PictureTile> tiles{};
    ImageU8 last{};
  };
  /// From the first moment of a camera's first row to the last one of its last row.
  double window_s() const;
  /// Light on the whole sensor; of the scene camera's thread.
  Result<ImageF> Expose(Side& side, SceneCamera& scene, const PoseHistory& history,
                        Timestamp stamp) const;
  /// What lens and sensor make of it. Touches nothing but this side.
  ImageU8 ReadOut(Side& side, ImageF light) const;
  /// Light on a tile, in the mean of its exposure about `middle`.
  Result<ImageF> Light(const Side& side, const PictureTile& tile, SceneCamera& scene,
                       const PoseHistory& history, Timestamp middle) const;

  CameraFigures figures_;
  RigidTransform X_BC0_;
  Timestamp start_;
  double clock_rate_;  ///< seconds of the vehicle's clock a second
  int rows_;
  Side left_;
  Side right_;
  RandomStream drops_;
};

}  // namespace palace
