// Bus: one LCM bus, owned. The only place that talks to liblcm.
//
// Of a multicast bus liblcm only sends: its receiver trusts what datagrams claim. What comes is
// taken by our own receiver (receiver/bus_receiver.h), bounded by channel, counted by sender.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/mission/bus_traffic.h"
#include "engine/model/refused_datagram.h"
#include "engine/wire/bus_url.h"
#include "engine/wire/receiver/channel_limits.h"
#include "engine/wire/wire_message.h"

namespace palace {

/// Publish from any thread. Subscribe and Handle from one thread.
class Bus {
 public:
  using Handler = std::function<void(WireMessage)>;

  /// kUsage for what is no URL of a bus; kUnavailable when the bus cannot be joined, with the route
  /// command that helps.
  static Result<std::shared_ptr<Bus>> Open(const std::string& url);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  const std::string& url() const;
  /// What the operator should know, e.g. net.core.rmem_max too small, with the command to mend it.
  const std::vector<std::string>& warnings() const;

  Status Publish(const WireMessage& message);
  /// `channel` literally. The handler must not throw; it runs inside Handle. What is over the
  /// limits is dropped and counted. The message's time is its arrival on the wall clock.
  Status Subscribe(const std::string& channel, Handler handler, ChannelLimits limits = {});
  /// Handles at most one message, the oldest. True when one was handled, false after `timeout_ms`
  /// without.
  Result<bool> Handle(int timeout_ms);
  /// What was received and what was not. Empty for memq. Any thread.
  BusTraffic traffic() const;
  /// The beginnings of what was refused since the last call. Any thread.
  std::vector<RefusedDatagram> TakeRefused();

 private:
  struct Impl;
  explicit Bus(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palace
