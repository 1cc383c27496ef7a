#include "engine/simulation/vehicle_navigator.h"

#include "engine/core/units.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kHistory_s = 1.0;
constexpr double kAccelNoise = 0.01;  // m/s^2 per sqrt(Hz), attitude noise included
constexpr double kBiasWalk = 0.004;   // m/s^2 per sqrt(s)
constexpr double kVisionPositionGain = 0.5;
// Low, so that the velocity cross-fades to the station's filter over about a second.
constexpr double kVisionVelocityGain = 0.2;
constexpr double kVisionGate_m = 2.0;

}  // namespace

void InertialTrack::Propagate(Timestamp now, const Vector3d& a_W) {
  const Point& last = points_.back();
  const double dt = SecondsBetween(last.time, now);
  points_.push_back({now, last.p_WB + dt * last.v_WB + 0.5 * dt * dt * a_W, last.v_WB + dt * a_W});
  while (SecondsBetween(points_.front().time, now) > kHistory_s) {
    points_.pop_front();
  }
}

const InertialTrack::Point* InertialTrack::At(Timestamp time) const {
  if (time > points_.back().time || time < points_.front().time) {
    return nullptr;
  }
  const Point* found = &points_.front();
  for (const Point& point : points_) {
    if (point.time > time) {
      break;
    }
    found = &point;
  }
  return found;
}

void InertialTrack::Correct(Timestamp time, const Vector3d& dp, const Vector3d& dv) {
  for (Point& point : points_) {
    if (point.time >= time) {
      point.p_WB += dp + SecondsBetween(time, point.time) * dv;
      point.v_WB += dv;
    }
  }
}

Vector3d AccelerationInWorld(const ImuSample& imu, const Matrix3d& R_WB) {
  return R_WB * imu.specific_force_B + Vector3d(0, 0, kStandardGravity_mps2);
}

GpsNavigator::GpsNavigator(const InertialTrack::Point& start, double velocity_sigma_mps)
    : track_(start),
      velocity_sigma_mps_(velocity_sigma_mps),
      P_(Vector3d(0.01, 0.01, 0.01).asDiagonal()) {}

void GpsNavigator::Propagate(Timestamp now, const Vector3d& a_W) {
  const double dt = SecondsBetween(track_.now().time, now);
  track_.Propagate(now, a_W - bias_W_);
  Matrix3d F;
  F << 1, dt, -0.5 * dt * dt,  //
      0, 1, -dt,               //
      0, 0, 1;
  P_ = F * P_ * F.transpose();
  P_(1, 1) += kAccelNoise * kAccelNoise * dt;
  P_(2, 2) += kBiasWalk * kBiasWalk * dt;
}

void GpsNavigator::Fuse(Timestamp time, int row, const Vector3d& residual, double sigma) {
  const Vector3d gain = P_.col(row) / (P_(row, row) + sigma * sigma);
  track_.Correct(time, gain[0] * residual, gain[1] * residual);
  bias_W_ += gain[2] * residual;
  const Eigen::RowVector3d row_of_P = P_.row(row);
  P_ -= gain * row_of_P;
  P_ = (0.5 * (P_ + P_.transpose())).eval();
}

void GpsNavigator::Update(const GpsFix& fix) {
  const InertialTrack::Point* then = track_.At(fix.time);
  if (then == nullptr || !fix.p_WB.allFinite() || !fix.v_WB.allFinite()) {
    return;
  }
  Fuse(fix.time, 0, fix.p_WB - then->p_WB, fix.sigma_horizontal_m);
  Fuse(fix.time, 1, fix.v_WB - track_.At(fix.time)->v_WB, velocity_sigma_mps_);
}

VisionNavigator::VisionNavigator(Timestamp now, const PositionEstimate& first,
                                 const InertialTrack::Point& gps)
    : track_({now, first.p_WB + SecondsBetween(first.time, now) * gps.v_WB, gps.v_WB}) {}

void VisionNavigator::Propagate(Timestamp now, const Vector3d& a_W) { track_.Propagate(now, a_W); }

bool VisionNavigator::Update(const PositionEstimate& estimate) {
  const InertialTrack::Point* then = track_.At(estimate.time);
  if (then == nullptr || (estimate.p_WB - then->p_WB).norm() > kVisionGate_m) {
    return false;
  }
  track_.Correct(estimate.time, kVisionPositionGain * (estimate.p_WB - then->p_WB),
                 kVisionVelocityGain * (estimate.v_WB - then->v_WB));
  return true;
}

}  // namespace palace
