// Watches when each input last arrived, how often it should, and what was lost.
#pragma once

#include <array>
#include <cmath>
#include <deque>
#include <vector>

#include "engine/model/frame_bundle.h"
#include "engine/model/snapshot.h"

namespace palace {

/// Fresh, late and stale as channel_age.h tells them. Ages are measured between an input's own
/// stamp and the bundle's time, both data time; a stamp that does not advance ages (a frozen sender
/// looks stale). Once two periods are missing, the rate is one message in the time since the last.
///
/// What is missing lately is told by the channel's own beat, the 0.4 quantile of its last 256
/// periods: up to six tenths of the messages may be lost and it still is the sender's period.
class ChannelMonitor {
 public:
  ChannelMonitor();
  void Reset();
  /// Without a vehicle (pictures alone) what only a vehicle sends is not expected, nor listed.
  void Add(const FrameBundle& bundle, bool has_vehicle);
  /// The station's own position estimate is watched like an input, by what it took in last: the
  /// filter itself goes on for ever. One that lands by GPS cannot be newer than the fixes.
  void AddEstimate(Timestamp last_measured, EstimateSource source);
  std::vector<ChannelHealth> Health(Timestamp now) const;

 private:
  struct Watch {
    double expected_hz = 0;
    Timestamp last;
    double mean_period_s = 0;
    std::uint64_t count = 0;
    std::uint64_t lost = 0;
    std::deque<double> periods_s;  ///< the last ones, newest last
    double LostShare() const;
  };
  void Saw(ChannelId channel, Timestamp stamp);
  Watch& Of(ChannelId channel) { return watches_[static_cast<std::size_t>(channel)]; }

  std::array<Watch, kChannelCount> watches_;
  double gps_sigma_m_ = 0;
  bool has_vehicle_ = true;
};

}  // namespace palace
