// Bus: one LCM bus, owned. The only place that talks to liblcm.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/wire/wire_message.h"

namespace palace {

/// `url` with recv_buf_size=4194304 and ttl=0 appended where it is udpm and does not say so itself.
/// An empty url is LCM's default multicast group.
std::string CompleteLcmUrl(const std::string& url);

/// Publish from any thread. Subscribe and Handle from one thread.
class Bus {
 public:
  using Handler = std::function<void(WireMessage)>;

  /// kUsage for what is no URL of a bus; kUnavailable when the bus cannot be joined, with the route command that helps.
  static Result<std::shared_ptr<Bus>> Open(const std::string& url);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  const std::string& url() const;
  /// What the operator should know, e.g. net.core.rmem_max too small, with the command to mend it.
  const std::vector<std::string>& warnings() const;

  Status Publish(const WireMessage& message);
  /// `channel` literally. The handler must not throw; it runs inside Handle. Messages over 64 MiB
  /// and channels that are not printable are dropped and counted. The message's time is its arrival
  /// on the wall clock.
  /// More than `queue_capacity` waiting messages push out the oldest.
  Status Subscribe(const std::string& channel, Handler handler, int queue_capacity = 256);
  /// Handles at most one message. True when one was handled, false after `timeout_ms` without.
  Result<bool> Handle(int timeout_ms);
  std::uint64_t dropped() const;

 private:
  struct Impl;
  explicit Bus(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palace
