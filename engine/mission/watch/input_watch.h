// InputWatch: age of what the mission depends on, and continuity of the vehicle's clock and boot.
//
// Age is the time since a message with an advancing stamp arrived, on the station's active clock: a
// log played into the bus looks live, a frozen sender looks stale. A step of the vehicle's clock
// makes it untrusted until three consistent samples came (I18). A live source knows of a step
// itself (ClockReading); elsewhere a status whose stamp leaves the active clock's shows it.
//
// A camera is heard when its picture comes, with or without its partner; that pictures pair has an
// age of its own.
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
  double PairAge(Timestamp now) const { return pair_.Age(now); }
  bool heard_vehicle() const { return link_.stamp.has_value(); }
  bool clock_continuous() const {
    return consistent_samples_ >= kConsistentSamples && !(clock_ && clock_->estimating);
  }
  bool clock_stepped() const { return clock_stepped_; }  ///< in the last Update
  double clock_step_s() const { return clock_step_s_; }  ///< the last; NaN: there was none
  /// Seconds since the clock stepped, since this machine stalled, since a vehicle pose was refused
  /// for its numbers; NaN: never.
  double SinceClockStep(Timestamp now) const { return Since(stepped_at_, now); }
  double SinceStall(Timestamp now) const { return Since(stalled_at_, now); }
  double SincePoseInvalid(Timestamp now) const { return Since(pose_invalid_at_, now); }
  /// Seconds for which poses have been refused so, with gaps of less than 1 s; NaN: they are not.
  double PosesInvalidFor(Timestamp now) const {
    return SincePoseInvalid(now) <= kInvalidGap_s ? Since(poses_invalid_from_, now) : NAN;
  }
  double stalled_s() const { return stalled_s_; }  ///< length of the last stall
  bool rebooted() const { return rebooted_; }      ///< in the last Update
  const std::optional<VehicleStatus>& vehicle() const { return vehicle_; }
  /// By the vehicle's own pose, as it was when its status was heard last; NaN before one.
  double climb_mps() const { return climb_mps_; }
  std::uint64_t boot_id() const { return vehicle_ ? vehicle_->boot_id : 0; }
  /// The vehicle's clock: of a live source `now` itself, else extrapolated from the last status.
  Timestamp VehicleTime(Timestamp now) const {
    return clock_ ? now : Timestamp{SaturatedSum(now.us, offset_us_)};
  }
  /// A jump in time: nothing is known any more but which boot of the vehicle was heard.
  InputWatch AfterJump() const;
  /// Another place of a record: what was heard, and when, is what the record's channels say.
  static InputWatch AsHeard(const std::vector<ChannelHealth>& channels, const FrameBundle& bundle,
                            Timestamp now);
  const std::optional<GpsFix>& gps() const { return gps_; }

 private:
  static constexpr int kConsistentSamples = 3;
  static constexpr double kInvalidGap_s = 1;
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
  static double Since(const std::optional<Timestamp>& then, Timestamp now) {
    return then && now >= *then ? SecondsBetween(*then, now) : NAN;
  }
  void SeeCameras(const FrameBundle& bundle, Timestamp now);
  void SeePoses(const FrameBundle& bundle, Timestamp now);
  void SeePose(const VehiclePose& pose, Timestamp now);
  void SeeClock(const std::optional<ClockReading>& clock, Timestamp now);
  void WatchVehicle(const VehicleStatus& status, Timestamp now);

  Arrival link_, pose_, left_, right_, pair_;
  ChannelAge left_channel_, right_channel_, pose_channel_;
  std::optional<VehicleStatus> vehicle_;
  std::optional<std::uint64_t> boot_before_jump_;
  std::optional<GpsFix> gps_;
  std::optional<ClockReading> clock_;
  std::optional<Timestamp> stepped_at_, stalled_at_, pose_invalid_at_, poses_invalid_from_;
  double clock_step_s_ = NAN, stalled_s_ = NAN, pose_climb_mps_ = NAN, climb_mps_ = NAN;
  std::int64_t offset_us_ = 0;
  int consistent_samples_ = 0;
  bool clock_stepped_ = false;
  bool rebooted_ = false;
};

}  // namespace palace
