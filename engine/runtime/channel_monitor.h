// Watches when each input last arrived, how often it should, and what was lost.
#pragma once

#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <vector>

#include "engine/model/frame_bundle.h"
#include "engine/model/snapshot.h"

namespace palace {

/// Fresh, late and stale as channel_age.h tells them. Ages are measured between an input's own
/// stamp and the bundle's time, both data time; a stamp that does not advance ages (a frozen sender
/// looks stale). Rates are counted by the stamps, so that they are the sender's however seldom this
/// station looks; what newer messages overtook here came, at times that are taken to be even.
///
/// What is missing lately is told by the channel's own beat, the 0.4 quantile of its last 256
/// periods: up to six tenths of the messages may be lost and it still is the sender's period.
class ChannelMonitor {
 public:
  ChannelMonitor();
  void Reset();
  /// After a jump in a record: when each channel was heard last before, by the record. It is told
  /// until the channel is heard again; figures of rate and loss are of what was seen here.
  void RestoreHeard(const std::array<std::optional<Timestamp>, kChannelCount>& heard);
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
    std::uint64_t count = 0;
    std::uint64_t lost = 0;
    int overtaken = 0;                      ///< since the last
    std::optional<Timestamp> heard_before;  ///< of the record
    std::deque<double> periods_s;           ///< the last ones, newest last
    double LostShare() const;
    /// Messages a second in the kRateWindow_s before the last one.
    double Rate_hz() const;
  };
  void Saw(ChannelId channel, Timestamp stamp);
  Watch& Of(ChannelId channel) { return watches_[static_cast<std::size_t>(channel)]; }

  std::array<Watch, kChannelCount> watches_;
  double gps_sigma_m_ = 0;
  bool has_vehicle_ = true;
};

}  // namespace palace
