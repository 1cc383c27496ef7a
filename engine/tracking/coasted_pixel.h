// CoastedPixel: where a point of the ground lies in the picture, seen or carried on unseen.
//
// While it is not seen it moves as the inertial solution predicts, and t seconds after it was seen
//
//   pixel = last seen + predicted now - predicted then
//   sigma^2 = sigma_seen^2 + sigma_attitude^2 + (pixels per metre)^2 ((sigma_v t)^2 + q^2 t^3 / 3)
//
// with q the acceleration noise of the vision filter: velocity known to sigma_v and white
// acceleration, as in position_filter.h.
#pragma once

#include <cmath>

#include <Eigen/Dense>

#include "engine/core/time.h"
#include "engine/model/follow_state.h"
#include "engine/model/tracker_set_status.h"

namespace palace {

/// What is predicted of the point in one picture.
struct PredictedPixel {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double pixels_per_metre = 0;  ///< at its distance
  double accel_noise_mps2 = 0;  ///< per sqrt(Hz)
  Timestamp time;
};

class CoastedPixel {
 public:
  /// Begins unseen, where it is predicted.
  void Start(const PredictedPixel& predicted);
  void See(const Eigen::Vector2d& pixel, double sigma_px, const PredictedPixel& predicted);
  void Coast(const PredictedPixel& predicted);
  /// Where it would be in that picture unseen.
  Eigen::Vector2d CarriedTo(const Eigen::Vector2d& predicted) const {
    return pixel_ + predicted - predicted_;
  }

  const Eigen::Vector2d& pixel() const { return pixel_; }
  double sigma_px() const { return sigma_px_; }
  FollowState state() const { return state_; }
  int pictures_lost() const { return pictures_lost_; }
  double lost_s() const { return lost_s_; }
  /// Writes state, site pixel, sigma and how long it is lost.
  void Tell(TrackerMember& member) const;

 private:
  Eigen::Vector2d pixel_ = Eigen::Vector2d::Constant(NAN);
  Eigen::Vector2d predicted_ = Eigen::Vector2d::Zero();  ///< of the same picture
  double sigma_px_ = NAN;
  double seen_sigma_px_ = 0;
  Timestamp seen_;
  FollowState state_ = FollowState::kLost;
  int pictures_lost_ = 0;
  double lost_s_ = 0;
};

}  // namespace palace
