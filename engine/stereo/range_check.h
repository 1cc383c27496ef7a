// Self-check of the rig's scale: stereo depth against the laser at the laser's own spot.
//
//   q = Z_stereo / Z_laser,  the median over the last pairs,  sigma_q = 1.25 * 1.48 MAD / sqrt(n)
//
// A wrong focal length or baseline stretches every stereo depth by the same factor, whatever the
// height: f as the thesis prints it, (W/2) / atan(FoV/2), is 10.7 % too long at 45 degrees. A
// relative yaw of the cameras instead adds a constant disparity, which shows here as a q that
// changes with height. The factor is what the eye cannot see in a picture and the map cannot know
// by itself.
// Source: the thesis reports both failures (3.3, 5.1.2); Hampel 1974 (median, MAD).
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Dense>

#include "engine/model/range_map.h"

namespace palace {

/// Median stereo depth around the pixel that sees `p_CL`; nothing when it lies outside the picture
/// or half of the pixels around are unknown.
std::optional<double> DepthAtSpot(const RangeMap& range, const Eigen::Vector3d& p_CL);

class RangeCheck {
 public:
  void Reset() { ratios_.clear(); }
  /// `p_CL`: the laser's spot in the axes of the map's camera, metres, at the time of the map.
  /// Ignored when the spot lies outside the picture or stereo knows fewer than half of the pixels
  /// around it.
  void Add(const RangeMap& range, const Eigen::Vector3d& p_CL);
  /// NaN below kLeastPairs pairs.
  RangeAgreement agreement() const;

  static constexpr int kLeastPairs = 10;
  static constexpr int kMostPairs = 40;

 private:
  std::deque<double> ratios_;
};

}  // namespace palace
