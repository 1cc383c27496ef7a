// InputWatch: age of what the mission depends on, and continuity of the vehicle's clock and boot.
//
// Age is the time since a message with an advancing stamp arrived, on the station's active clock: a
// log played into the bus looks live, a frozen sender looks stale. A step of the vehicle's clock
// makes it untrusted until three consistent samples came (I18).
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/model/frame_bundle.h"
#include "engine/model/snapshot.h"

namespace palace {

class InputWatch {
 public:
  void Update(const FrameBundle& bundle, const std::vector<ChannelHealth>& channels, Timestamp now);

  double LinkAge(Timestamp now) const { return link_.Age(now); }
  double PoseAge(Timestamp now) const;
  double LeftCameraAge(Timestamp now) const;
  double RightCameraAge(Timestamp now) const;
  bool heard_vehicle() const { return link_.stamp.has_value(); }
  bool clock_continuous() const { return consistent_samples_ >= kConsistentSamples; }
  bool clock_stepped() const { return clock_stepped_; }  ///< in the last Update
  bool rebooted() const { return rebooted_; }            ///< in the last Update
  const std::optional<VehicleStatus>& vehicle() const { return vehicle_; }
  std::uint64_t boot_id() const { return vehicle_ ? vehicle_->boot_id : 0; }
  /// The vehicle's clock, extrapolated from its last status.
  Timestamp VehicleTime(Timestamp now) const { return {now.us + offset_us_}; }
  const std::optional<GpsFix>& gps() const { return gps_; }

 private:
  static constexpr int kConsistentSamples = 3;
  /// Stamp of the newest message and when it arrived.
  struct Arrival {
    std::optional<Timestamp> stamp;
    Timestamp seen;
    void See(Timestamp message_stamp, Timestamp now);
    double Age(Timestamp now) const;
  };
  /// What the station's watch of one channel said last; NaN where it is not listed (I3).
  struct ChannelAge {
    double age_s = NAN;
    Timestamp at;
    double Age(Timestamp now) const { return age_s + SecondsBetween(at, now); }
  };
  void WatchVehicle(const VehicleStatus& status, Timestamp now);

  Arrival link_, pose_, stereo_;
  ChannelAge left_channel_, right_channel_, pose_channel_;
  std::optional<VehicleStatus> vehicle_;
  std::optional<GpsFix> gps_;
  std::int64_t offset_us_ = 0;
  int consistent_samples_ = 0;
  bool clock_stepped_ = false;
  bool rebooted_ = false;
};

}  // namespace palace
