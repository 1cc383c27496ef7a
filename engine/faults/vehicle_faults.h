// VehicleFaults: what failed sensors, a failed clock and a restart make of a bundle. Pure: the same
// seed, bundles and faults give the same bits.
//
// Poses that are late or carry wrong stamps come in the first bundle whose time has reached them,
// and the pose at exposure is the nearest of them within 0.1 s, carried over at constant rate, as
// for any vehicle that sends no such pose itself.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "engine/core/random.h"
#include "engine/faults/fault.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/vehicle_message.h"

namespace palace {

class VehicleFaults {
 public:
  explicit VehicleFaults(std::uint64_t seed) : random_(seed, "faults of the vehicle") {}

  /// Once a bundle, in order of time.
  void Apply(FrameBundle& bundle, const std::vector<Fault>& faults, double now_s);
  /// What the vehicle's clock shows more than it did without faults, since the last Apply.
  std::int64_t clock_offset_us() const { return clock_offset_us_; }

 private:
  struct WaitingPose {
    Timestamp due;
    VehiclePose pose;
  };
  void DelayPoses(double stamp_off_s, double late_s, FrameBundle& bundle);
  void ReleasePoses(FrameBundle& bundle);
  void StrikeLaser(const Fault& fault, FrameBundle& bundle);
  /// Multipath: a first-order Gauss-Markov error an axis.
  void ScatterFixes(double sigma_m, FrameBundle& bundle);
  void Restart(const Fault& fault, FrameBundle& bundle);

  RandomStream random_;
  std::deque<WaitingPose> waiting_;
  std::optional<VehiclePose> last_pose_;
  std::optional<double> stuck_range_m_;
  Eigen::Vector3d multipath_ = Eigen::Vector3d::Zero();  ///< in sigmas
  std::optional<Timestamp> multipath_time_;              ///< of the newest fix in the canyon
  std::int64_t clock_offset_us_ = 0;
};

/// A position estimate with its stamp moved to another clock, for the way to a vehicle whose clock
/// is off. Approvals are signed and stay as they are: the vehicle reads their times on its own
/// clock.
VehicleMessage OnClock(VehicleMessage message, std::int64_t offset_us);

}  // namespace palace
