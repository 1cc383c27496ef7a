// A field seen from a hover: rendered pairs, stereo, fusion and sites exactly as in flight, beside
// the truth of the field. What site experiments share.
//
//   World -> frames of drawn pairs -> StereoMatcher -> Slad -> TerrainDecision
//
// The camera hovers with drift and attitude motion. SLAD is given poses with errors, as a vehicle's
// navigation has them, never the true ones. Same world, view and seed: same bits.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "engine/core/frames.h"
#include "engine/core/result.h"
#include "engine/model/settings/settings.h"
#include "engine/model/snapshot.h"
#include "engine/slad/slad.h"
#include "engine/world/ray_pictures.h"

namespace palace {

/// The rig and how it hovers. Heights are above the origin of W.
struct HoverView {
  double height_m = 15.24;
  double north_m = 0;  ///< of the left camera's mean place
  double east_m = 0;
  double heading_rad = 0;
  double ground_height_m = 0;             ///< above the origin of W: about where stereo is to look
  double tilt_rad = -1.5707963267948966;  ///< of the camera, negative down
  double field_of_view_rad = 1.0471975511965976;
  int width_px = 640;
  int height_px = 480;
  double baseline_m = 1;
  int frames = 10;
  double frame_interval_s = 0.1;
  // Motion between frames, standard deviations.
  double drift_m = 0.2;                ///< each axis; half of it in height
  double attitude_motion_rad = 0.017;  ///< each of roll, pitch, yaw: 1 degree
  // Errors of the poses SLAD is given, independent per frame, standard deviations.
  double attitude_error_rad = 0.00175;  ///< each of roll, pitch, yaw: 0.1 degree
  double position_error_m = 0.03;       ///< each axis
  double noise_grey = 2;                ///< of the sensor
};

/// One frame as stereo hands it to SLAD, believed pose included.
struct FieldFrame {
  SladInput input;
  RigidTransform X_WC_true;
};

/// The picture that a camera takes there, at so many seconds.
using TakePicture =
    std::function<Result<ImageU8>(const RigidTransform& X_WCamera, bool right, double time_s)>;
/// All frames of one hover, left picture before right. Errors are stereo's refusals and the
/// pictures' own.
Result<std::vector<FieldFrame>> LookFromHover(const HoverView& view, const PinholeCamera& camera,
                                              const TakePicture& take,
                                              const StereoSettings& settings, std::uint64_t seed);
/// The same of a plain world by its own exposure; what has a velocity moves from frame to frame.
/// One bake of the ground serves all frames; `ground` may hold one made for the same world and a
/// wider view, or null.
Result<std::vector<FieldFrame>> LookAtField(const World& world, const HoverView& view,
                                            const StereoSettings& settings, std::uint64_t seed,
                                            const BakedGround* ground = nullptr);
/// True left camera poses of that hover, as LookAtField draws them.
std::vector<RigidTransform> HoverPoses(const HoverView& view, std::uint64_t seed);
/// Ground that serves both cameras of these poses.
BakedGround BakeForHover(const World& world, const HoverView& view,
                         const std::vector<RigidTransform>& X_WCs);

/// What SLAD holds after the first `count` frames (all when 0), given to it as in flight.
Slad MapOfField(const std::vector<FieldFrame>& frames, const SladSettings& settings, int count = 0);
/// Its decision.
std::shared_ptr<const TerrainDecision> DecideOnField(const std::vector<FieldFrame>& frames,
                                                     const Settings& settings, int count = 0);

}  // namespace palace
