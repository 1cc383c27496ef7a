// FrozenCheck: does a camera repeat its picture?
//
// Two signs, each apart for the left and the right camera:
//
//   repeated   fewer than one pixel in a thousand differs from the picture before. No sensor gives
//              the same picture twice, and no ray caster does while the camera moves at all.
//   unmoved    since an earlier picture, at most 4 s old, the camera has moved so that the ground
//              must have shifted by 12 px or more in the mean, and yet the picture is that one: the
//              means of its 8x8 blocks differ by less than a quarter of what the same picture
//              shifted by 4 px would show. Noise of a grey level averages out of the means (0.15 of
//              a level), so that noise on a frozen picture does not hide it.
//
// Pictures are kept every half second; the newest that the camera has moved from is asked. A camera
// over still ground that does not move is judged by the first sign alone: without motion a picture
// that stays like itself is no fault (a hover in 3 m/s of wind moves by 8 px in about 2 s, by 15 in
// 4). Too little texture (a shift by 4 px changes the means by less than 1 level) leaves the second
// sign open. Once unmoved, a picture is so until it is seen to change by half of what the shift
// would show.
//
// The shift is that of the plane ground at the given depth, mean of nine points of the picture, for
// the turn and for what of the way is beyond 3 sigma of the position: an estimate that wanders over
// still ground has not moved.
// Pure: no clocks, no threads. Any one thread.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/frames.h"
#include "engine/core/time.h"
#include "engine/model/camera_models.h"
#include "engine/model/image.h"

namespace palace {

struct FrozenCameras {
  bool left = false, right = false;
};

/// One rectified pair, and where the left camera was by the vehicle's own word.
struct SeenPair {
  Timestamp time;
  std::shared_ptr<const ImageU8> left, right;
  RigidTransform X_WC;
  PinholeCamera camera;
  double depth_m = 0;    ///< to the ground along the axis; not finite: no motion is told
  double sigma_p_m = 0;  ///< of the camera's position; not finite: only turns count
};

class FrozenCheck {
 public:
  static constexpr double kRepeatedShare = 1e-3;
  static constexpr double kMoved_px = 12;
  static constexpr double kOldest_s = 4;
  static constexpr double kEvery_s = 0.5;
  static constexpr double kUnmovedShare = 0.25;
  static constexpr double kChangedShare = 0.5;
  static constexpr double kLeastTexture = 1;  ///< grey levels

  /// Call it with each pair once, in order of time.
  FrozenCameras Add(const SeenPair& pair);
  void Reset() { *this = FrozenCheck(); }

 private:
  /// Means of 8x8 blocks, and how much they change when the picture shifts by 4 px.
  struct Reference {
    std::vector<float> means;
    double change = 0;
  };
  /// What both cameras saw, and from where.
  struct Look {
    Timestamp time;
    RigidTransform X_WC;
    Reference left, right;
  };
  struct Eye {
    std::shared_ptr<const ImageU8> before;
    std::optional<Reference> unmoved;  ///< the picture that it repeats
  };
  static double SureShift_px(const SeenPair& pair, const RigidTransform& X_WBefore);
  static Reference Keep(const ImageU8& picture);
  /// `moved_from`: what it showed where the camera no longer is; null: it has not moved.
  static bool Judge(Eye& eye, const std::shared_ptr<const ImageU8>& picture,
                    const Reference* moved_from);

  Eye left_, right_;
  std::deque<Look> looks_;
};

/// Mean shift in pixels of plane ground at `depth_m` before the camera at X_WA, seen from X_WB.
double MeanShift_px(const PinholeCamera& camera, double depth_m, const RigidTransform& X_WA,
                    const RigidTransform& X_WB);

}  // namespace palace
