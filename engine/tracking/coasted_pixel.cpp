#include "engine/tracking/coasted_pixel.h"

namespace palace {
namespace {

constexpr double kUnseenSigma_px = 10;     // of a place that was only ever predicted
constexpr double kAttitudeSigma_px = 1.5;  // 0.1 degree of an attitude system
constexpr double kSigmaV_mps = 0.1;        // of the inertial solution when vision ends

}  // namespace

void CoastedPixel::Start(const PredictedPixel& predicted) {
  *this = CoastedPixel();
  pixel_ = predicted_ = predicted.pixel;
  seen_ = predicted.time;
  seen_sigma_px_ = sigma_px_ = kUnseenSigma_px;
}

void CoastedPixel::See(const Eigen::Vector2d& pixel, double sigma_px,
                       const PredictedPixel& predicted) {
  pixel_ = pixel;
  predicted_ = predicted.pixel;
  sigma_px_ = seen_sigma_px_ = sigma_px;
  seen_ = predicted.time;
  state_ = pictures_lost_ > 0 ? FollowState::kReacquired : FollowState::kFollowed;
  pictures_lost_ = 0;
  lost_s_ = 0;
}

void CoastedPixel::Coast(const PredictedPixel& predicted) {
  pixel_ = CarriedTo(predicted.pixel);
  predicted_ = predicted.pixel;
  state_ = FollowState::kLost;
  ++pictures_lost_;
  lost_s_ = SecondsBetween(seen_, predicted.time);
  const double t = lost_s_, q = predicted.accel_noise_mps2;
  const double metres2 = kSigmaV_mps * kSigmaV_mps * t * t + q * q * t * t * t / 3;
  const double per_metre = predicted.pixels_per_metre;
  sigma_px_ = std::sqrt(seen_sigma_px_ * seen_sigma_px_ + kAttitudeSigma_px * kAttitudeSigma_px +
                        per_metre * per_metre * metres2);
}

void CoastedPixel::Tell(TrackerMember& member) const {
  member.state = state_;
  member.site_pixel = pixel_;
  member.sigma_px = sigma_px_;
  member.pictures_lost = pictures_lost_;
  member.lost_s = lost_s_;
}

}  // namespace palace
