// LcmSource: a live vehicle on an LCM bus as a source of bundles.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "engine/core/time.h"
#include "engine/core/vehicle_clock.h"
#include "engine/model/snapshot.h"
#include "engine/runtime/source.h"
#include "engine/wire/bus.h"
#include "engine/wire/live_bundles.h"
#include "engine/wire/receiver/refusal_log.h"

namespace palace {

struct LcmSourceOptions {
  /// Without a completed bundle for this long, Next delivers one without pictures, so that ages
  /// grow and the mission notices silence. Its time is zero while nothing was ever heard.
  double heartbeat_s = 0.2;
  std::function<double()> now_s = MonotonicSeconds;  ///< the station's clock
  /// Given every message to the vehicle that is heard on the bus, on the thread of Next.
  std::function<void(const WireMessage&)> overheard{};
};

/// Next() works the bus itself; no thread of its own. What arrives becomes bundles as LiveBundles
/// says. A message whose utime does not advance is no news, so a frozen sender goes stale. After a
/// stall of this machine what waited is taken before silence is told.
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
  void NoticeStall(double now_s);
  void Take(const WireMessage& message);
  void Drain(const std::stop_token& stop, double limit_s);
  std::shared_ptr<const FrameBundle> Deliver();

  std::shared_ptr<Bus> bus_;
  std::shared_ptr<const bool> alive_ = std::make_shared<bool>(true);
  LcmSourceOptions options_;
  LiveBundles bundles_;
  RefusalLog refusals_;  ///< of messages that could not be decoded
  StallWatch stall_watch_;
  double last_stall_s_ = -std::numeric_limits<double>::infinity();
  double last_delivery_s_ = 0;
  std::optional<Timestamp> start_;
  mutable std::mutex mutex_;  ///< guards what Status and Lost read
  SourceStatus status_;
  Losses losses_;
};

}  // namespace palace
