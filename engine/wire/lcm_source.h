// LcmSource: a live vehicle on an LCM bus as a source of bundles.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>

#include "engine/model/snapshot.h"
#include "engine/runtime/source.h"
#include "engine/wire/bundle_assembler.h"
#include "engine/wire/bus.h"
#include "engine/wire/receiver/refusal_log.h"

namespace palace {

struct LcmSourceOptions {
  /// Without a completed bundle for this long, Next delivers one without pictures, so that ages
  /// grow and the mission notices silence. Its time is zero while nothing was ever heard.
  double heartbeat_s = 0.2;
};

/// Next() works the bus itself; no thread of its own. Newest wins: when several bundles wait, the
/// older pictures are dropped and their samples joined to the newest. A message whose utime does
/// not advance is no news, so a frozen sender goes stale. Sequence numbers are this source's own.
class LcmSource final : public Source {
 public:
  static Result<std::unique_ptr<LcmSource>> Create(std::shared_ptr<Bus> bus,
                                                   ChannelNames channels = {},
                                                   LcmSourceOptions options = {});
  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override;
  bool IsLockstep() const override { return false; }
  SourceStatus Status() const override;
  void Control(const PlaybackControl&) override {}

  Losses Lost() const override;

 private:
  LcmSource(std::shared_ptr<Bus> bus, ChannelNames channels, LcmSourceOptions options);
  void Take(WireMessage message);
  void Drain();
  std::shared_ptr<const FrameBundle> TakeReady();
  Losses Count() const;
  std::shared_ptr<const FrameBundle> Deliver(std::shared_ptr<const FrameBundle> bundle);
  Timestamp ClockNow(double now_s) const;

  std::shared_ptr<Bus> bus_;
  ChannelNames channels_;
  LcmSourceOptions options_;
  BundleAssembler assembler_;
  RefusalLog refusals_;  ///< of messages that could not be decoded
  std::deque<std::shared_ptr<const FrameBundle>> ready_;
  std::optional<Timestamp> anchor_;  ///< newest data time ...
  double anchor_s_ = 0;              ///< ... and the monotonic second it arrived
  std::optional<Timestamp> last_time_;
  double last_delivery_s_ = 0;
  std::uint64_t sequence_ = 0;
  Losses joined_;             ///< what joining bundles that waited here left out
  mutable std::mutex mutex_;  ///< guards what Status and Lost read
  SourceStatus status_;
  Losses losses_;
};

}  // namespace palace
