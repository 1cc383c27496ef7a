// LaserWatch: is the laser range finder alive, does it move, and does it tell the truth?
//
//   lost    no return for more than 0.5 s, after there were some
//   stuck   the same range to the last digit for 0.8 s, where before most ranges differed from the
//           one before (noise never repeats), or where the height changed by 0.3 m meanwhile
//   wrong   height over the spot stepped by more than 1 m and 15 % in three ranges in a row, and
//           stereo at the spot still sees the ground where it was; or over 2 m of climb or descent
//           the laser changed by more than 20 % too much or too little and stereo did not
//
// A step that stereo sees too is the edge of something. One or two ranges beyond a step are spikes
// and are not used. A calibration that is wrong moves stereo, not the laser: the third witness, the
// vehicle's own vertical motion, tells them apart. What was wrong stands until the laser agrees
// with stereo within 10 % five times in a row.
// Heights of the camera are above the origin of W, up-positive. Source: reliability.md F07-F09.
#pragma once

#include <deque>
#include <optional>

#include "engine/model/navigation_status.h"
#include "engine/model/vehicle_state.h"

namespace palace {

/// Where the beam started: X_WC's height, and the part of the beam's direction that points down.
struct BeamPose {
  double camera_height_m = NAN;
  double beam_down = NAN;  ///< cosine between beam and down
};

class LaserWatch {
 public:
  /// In order of time; NaN is no return.
  void AddRange(const LaserRange& range, const BeamPose& beam);
  /// Depth that stereo sees along the beam.
  void AddStereo(Timestamp time, double depth_m, const BeamPose& beam);
  /// Once a bundle, after what came with it.
  void Update(Timestamp now);
  const LaserHealth& status() const { return status_; }
  /// The newest range may be used for heights.
  bool usable() const { return status_.state == LaserHealth::State::kFine && step_run_ == 0; }
  void Reset() { *this = LaserWatch(); }

 private:
  struct Seen {
    Timestamp time;
    double over_spot_m = NAN;  ///< height of the camera over the beam's spot
    double camera_height_m = NAN;
  };
  void FollowRepeats(const LaserRange& range, const BeamPose& beam);
  void FollowLevel(const LaserRange& range, const Seen& seen);
  void CompareScale(const Seen& laser);
  /// What the laser should read over a spot as high as the last that was believed.
  double Expected(const Seen& seen) const;
  bool StereoIsFresh(Timestamp now) const;
  void CallWrong(double ratio);

  LaserHealth status_;
  std::optional<Timestamp> last_return_;
  std::optional<LaserRange> previous_;
  int returns_ = 0, repeats_ = 0;
  std::optional<Timestamp> same_since_;
  int same_run_ = 0;
  double same_height_m_ = NAN;
  bool stuck_ = false;
  std::optional<Seen> level_;   ///< the newest that was believed
  std::optional<Seen> stereo_;  ///< newest
  std::optional<Timestamp> step_since_;
  int step_run_ = 0;
  bool wrong_ = false;
  double wrong_ratio_ = NAN;
  int agree_run_ = 0;
  struct Reference {
    Seen laser, stereo;
  };
  std::optional<Reference> reference_;
};

}  // namespace palace
