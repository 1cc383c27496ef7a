#include "engine/faults/vehicle_faults.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/units.h"
#include "engine/wire/bundle_assembler.h"

namespace palace {
namespace {

constexpr double kNearestPose_s = 0.1;
constexpr double kSpikeShare = 0.05;
constexpr double kMultipath_s = 5;      // correlation in time
constexpr double kFixesInCanyon = 0.5;  // of those under an open sky
constexpr std::uint64_t kOtherBoot = 0x5bd1e995a5a5a5a5;

void RollPoses(double angle_rad, FrameBundle& bundle) {
  const Eigen::Matrix3d R_BF =
      Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitX()).toRotationMatrix();
  for (VehiclePose& pose : bundle.poses) {
    pose.X_WB.R = pose.X_WB.R * R_BF;
  }
  if (bundle.pose_at_exposure) {
    bundle.pose_at_exposure->X_WB.R = bundle.pose_at_exposure->X_WB.R * R_BF;
  }
}

void MoveClock(std::int64_t offset_us, FrameBundle& bundle) {
  if (offset_us != 0) {
    bundle.authority.reset();  // sealed on the clock that was
  }
  const auto move = [&](Timestamp& time) { time.us += offset_us; };
  move(bundle.time);
  const auto move_all = [&](auto& samples) {
    for (auto& sample : samples) {
      move(sample.time);
    }
  };
  move_all(bundle.poses);
  move_all(bundle.imu);
  move_all(bundle.gps);
  move_all(bundle.laser);
  move_all(bundle.acks);
  move_all(bundle.truth);
  if (bundle.status) {
    move(bundle.status->time);
  }
  if (bundle.pose_at_exposure) {
    move(bundle.pose_at_exposure->time);
  }
  if (bundle.stereo) {
    auto moved = std::make_shared<StereoFrame>(*bundle.stereo);
    move(moved->time);
    bundle.stereo = std::move(moved);
  }
}

}  // namespace

void VehicleFaults::Apply(FrameBundle& bundle, const std::vector<Fault>& faults, double now_s) {
  double stamp_off_s = 0, late_s = 0;
  bool poses_moved = !waiting_.empty();
  bool laser_stuck = false, in_canyon = false;
  clock_offset_us_ = 0;
  const Timestamp true_time = bundle.time;
  for (const Fault& fault : faults) {
    if (!fault.ActsAt(now_s)) {
      continue;
    }
    const double value = fault.ValueOrDefault();
    switch (fault.kind) {
      case FaultKind::kAttitudeNan:
        bundle.pose_at_exposure.reset();  // the messages of the others: LinkFaults
        break;
      case FaultKind::kAttitudeLate:
        late_s += value;
        poses_moved = true;
        break;
      case FaultKind::kAttitudeShifted:
        stamp_off_s += value;
        poses_moved = true;
        break;
      case FaultKind::kAttitudeBias:
        RollPoses(Rad(value), bundle);
        break;
      case FaultKind::kImuGyroBias:
      case FaultKind::kImuAccelBias:
        for (ImuSample& sample : bundle.imu) {
          if (fault.kind == FaultKind::kImuGyroBias) {
            sample.angular_rate_B.x() += Rad(value);
          } else {
            sample.specific_force_B.x() += value;
          }
        }
        break;
      case FaultKind::kLaserStuck:
        laser_stuck = true;
        StrikeLaser(fault, bundle);
        break;
      case FaultKind::kLaserScaled:
      case FaultKind::kLaserSpikes:
      case FaultKind::kLaserNoReturn:
        StrikeLaser(fault, bundle);
        break;
      case FaultKind::kGpsJump:
      case FaultKind::kGpsDrift:
        for (GpsFix& fix : bundle.gps) {
          const double since_s =
              now_s + SecondsBetween(true_time, fix.time) - fault.from_s;  // of the fix itself
          const bool drifts = fault.kind == FaultKind::kGpsDrift;
          fix.p_WB.x() += drifts ? value * std::max(0.0, since_s) : value;
        }
        break;
      case FaultKind::kGpsCanyon:
        in_canyon = true;
        ScatterFixes(value, bundle);
        break;
      case FaultKind::kClockStep:
        clock_offset_us_ += std::llround(1e6 * value);
        break;
      case FaultKind::kClockDrift:
        clock_offset_us_ += std::llround(1e6 * value * (now_s - fault.from_s));
        break;
      case FaultKind::kNewBoot:
      case FaultKind::kRestart:
        Restart(fault, bundle);
        break;
      case FaultKind::kMissing:
        if (fault.Strikes(ChannelId::kVehiclePose)) {
          bundle.pose_at_exposure.reset();
        }
        break;
      default:
        break;
    }
  }
  if (!laser_stuck) {
    stuck_range_m_.reset();
  }
  if (!in_canyon) {
    multipath_time_.reset();
  }
  if (poses_moved) {
    DelayPoses(stamp_off_s, late_s, bundle);
    ReleasePoses(bundle);
  }
  if (!bundle.poses.empty()) {
    last_pose_ = bundle.poses.back();
  }
  if (clock_offset_us_ != 0) {
    MoveClock(clock_offset_us_, bundle);
  }
}

void VehicleFaults::DelayPoses(double stamp_off_s, double late_s, FrameBundle& bundle) {
  for (VehiclePose& pose : bundle.poses) {
    const Timestamp true_time = pose.time;
    pose.time = AddSeconds(pose.time, stamp_off_s);
    waiting_.push_back({std::max(pose.time, AddSeconds(true_time, late_s)), pose});
  }
  bundle.poses.clear();
  bundle.pose_at_exposure.reset();
}

void VehicleFaults::ReleasePoses(FrameBundle& bundle) {
  while (!waiting_.empty() && waiting_.front().due <= bundle.time) {
    bundle.poses.push_back(waiting_.front().pose);
    waiting_.pop_front();
  }
  if (!bundle.stereo) {
    return;
  }
  const VehiclePose* nearest = last_pose_ ? &*last_pose_ : nullptr;
  const auto away_s = [&](const VehiclePose& pose) {
    return std::abs(SecondsBetween(pose.time, bundle.stereo->time));
  };
  for (const VehiclePose& pose : bundle.poses) {
    nearest = nearest == nullptr || away_s(pose) < away_s(*nearest) ? &pose : nearest;
  }
  if (nearest != nullptr && away_s(*nearest) <= kNearestPose_s) {
    bundle.pose_at_exposure = CarryPose(*nearest, bundle.stereo->time);
  }
}

void VehicleFaults::StrikeLaser(const Fault& fault, FrameBundle& bundle) {
  const double value = fault.ValueOrDefault();
  for (LaserRange& range : bundle.laser) {
    if (fault.kind == FaultKind::kLaserScaled) {
      range.range_m *= value;
    } else if (fault.kind == FaultKind::kLaserSpikes) {
      range.range_m += random_.Uniform() < kSpikeShare ? value : 0;
    } else if (fault.kind == FaultKind::kLaserNoReturn) {
      range.range_m = NAN;
    } else {
      if (!stuck_range_m_ && std::isfinite(range.range_m)) {
        stuck_range_m_ = range.range_m;
      }
      range.range_m = stuck_range_m_.value_or(range.range_m);
    }
  }
}

void VehicleFaults::ScatterFixes(double sigma_m, FrameBundle& bundle) {
  std::vector<GpsFix> received;
  for (GpsFix& fix : bundle.gps) {
    const double kept =
        multipath_time_ ? std::exp(-SecondsBetween(*multipath_time_, fix.time) / kMultipath_s) : 0;
    for (double& axis : multipath_) {
      axis = kept * axis + std::sqrt(1 - kept * kept) * random_.Normal();
    }
    multipath_time_ = fix.time;
    fix.p_WB += sigma_m * multipath_;
    if (random_.Uniform() < kFixesInCanyon) {
      received.push_back(fix);
    }
  }
  bundle.gps = std::move(received);
}

void VehicleFaults::Restart(const Fault& fault, FrameBundle& bundle) {
  const bool whole = fault.kind == FaultKind::kRestart;
  if (whole) {
    clock_offset_us_ -= std::llround(1e6 * fault.from_s);
  }
  if (!bundle.status) {
    return;
  }
  bundle.status->boot_id ^= kOtherBoot;
  if (whole) {
    bundle.status->mode = VehicleMode::kHover;
    bundle.status->approval_id = 0;
    bundle.status->flies_on_vision = false;
  }
}

VehicleMessage OnClock(VehicleMessage message, std::int64_t offset_us) {
  if (auto* estimate = std::get_if<PositionEstimate>(&message)) {
    estimate->time.us += offset_us;
  }
  return message;
}

}  // namespace palace
