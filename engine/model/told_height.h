// The height that a screen tells, and by whom, and whether it changes. One point of the vehicle: a
// source that changes moves it by what the sources differ, and by nothing else.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/model/snapshot.h"

namespace palace {

/// Of the skid centre, m, up-positive. NaN: nobody tells it.
struct ToldHeight {
  enum class By : std::uint8_t {
    kEstimate,  ///< in force: what limits and guards ask; above the site
    kGps,       ///< above the site
    kLaser,     ///< above the ground under the beam
    kPose,      ///< above the origin of W
  };
  /// Why it is not by the laser, of a height that is asked of it first.
  enum class NoLaser : std::uint8_t {
    kNone,      ///< it is by the laser, or the laser is not asked first
    kNever,     ///< no laser was ever heard
    kNoReturn,  ///< its messages come, and say that nothing came back
    kSilent,    ///< its messages do not come
  };
  By by = By::kEstimate;
  double height_m = std::numeric_limits<double>::quiet_NaN();
  /// By the laser: since the return that it rests on. Messages that came later had none. By others
  /// NaN: their channels tell it.
  double age_s = std::numeric_limits<double>::quiet_NaN();
  NoLaser no_laser = NoLaser::kNone;
};

/// Of a descent. By the estimate in force; where it is unknown (vision, and no pictures) by the
/// newest GPS, then by the laser: others still tell it.
ToldHeight HeightTold(const EngineSnapshot& snapshot);
/// Before one. By the laser, as in the plots, also for three seconds after its last return; then by
/// the vehicle's pose.
ToldHeight HoverHeightTold(const EngineSnapshot& snapshot);
/// Of the vehicle's pose, m/s, down; NaN while it does no more than a hover in gusts does, or
/// nobody tells it.
double VerticalSpeedTold(const EngineSnapshot& snapshot);

}  // namespace palace
