// Watches when each input last arrived, how often it should, and what was lost.
#pragma once

#include <array>
#include <vector>

#include "engine/model/frame_bundle.h"
#include "engine/model/snapshot.h"

namespace palace {

/// Fresh up to 2 expected periods, late up to 5, stale beyond 5 periods or 1 s, whichever is
/// larger. Ages are measured between an input's own stamp and the bundle's time, both data time; a
/// stamp that does not advance ages (a frozen sender looks stale).
class ChannelMonitor {
 public:
  ChannelMonitor();
  void Reset();
  /// Without a vehicle (pictures alone) what only a vehicle sends is not expected, nor listed.
  void Add(const FrameBundle& bundle, bool has_vehicle);
  /// The station's own position estimate is watched like an input.
  void AddEstimate(Timestamp estimate_time);
  std::vector<ChannelHealth> Health(Timestamp now) const;

 private:
  struct Watch {
    double expected_hz = 0;
    Timestamp last;
    double mean_period_s = 0;
    std::uint64_t count = 0;
    std::uint64_t lost = 0;
  };
  void Saw(ChannelId channel, Timestamp stamp);
  Watch& Of(ChannelId channel) { return watches_[static_cast<std::size_t>(channel)]; }

  std::array<Watch, kChannelCount> watches_;
  double gps_sigma_m_ = 0;
  bool has_vehicle_ = true;
};

}  // namespace palace
