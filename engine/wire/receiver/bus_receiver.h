// BusReceiver: the messages of our channels from an LCM multicast group, counted and bounded.
//
//   UdpSocket -> LcmReassembler -> ChannelSender -> MessageQueues -> Next
//
// A thread of its own empties the socket, whatever the reader does meanwhile: what waits is bounded
// by channel, so a flood of one pushes out nothing of another.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/mission/bus_traffic.h"
#include "engine/model/refused_datagram.h"
#include "engine/wire/receiver/channel_limits.h"
#include "engine/wire/receiver/channel_sender.h"
#include "engine/wire/receiver/message_queues.h"
#include "engine/wire/receiver/rate_meter.h"
#include "engine/wire/receiver/refusal_log.h"
#include "engine/wire/receiver/udp_socket.h"

namespace palace {

/// Everything between the socket and the reader, with no thread, clock or lock.
class BusInbox {
 public:
  void Open(const std::string& channel, const ChannelLimits& limits);
  /// Throws nothing: where memory is short the batch is dropped and counted.
  void Take(const std::vector<UdpSocket::Datagram>& datagrams, Timestamp wall, double now_s);
  bool empty() const { return queues_.empty(); }
  std::optional<QueuedMessage> Pop() { return queues_.Pop(); }
  /// All but `overrun`.
  BusTraffic Traffic(double now_s);
  std::vector<RefusedDatagram> TakeRefused() { return refusals_.Take(); }

 private:
  struct Channel {
    ChannelLimits limits{};
    ChannelSender sender{};
    RateMeter rate{};
    std::uint64_t of_other_senders = 0;
  };
  void Take(const UdpSocket::Datagram& datagram, Timestamp wall, double now_s);
  bool IsListenedTo(Channel& channel, SenderAddress from, double now_s) const;
  void Accept(Channel& channel, ReceivedMessage message, Timestamp wall, double now_s);
  void CountSenders(BusTraffic& traffic, double now_s) const;

  LcmReassembler reassembler_;
  MessageQueues queues_;
  RefusalLog refusals_;
  std::map<std::string, Channel, std::less<>> channels_;
  RateMeter rate_;
  std::uint64_t of_other_senders_ = 0;
  std::uint64_t dropped_ = 0;  ///< datagrams of batches for which memory was short
};

/// Open and Next from one thread, Traffic and TakeRefused from any.
class BusReceiver {
 public:
  explicit BusReceiver(UdpSocket socket);
  ~BusReceiver();
  BusReceiver(const BusReceiver&) = delete;
  BusReceiver& operator=(const BusReceiver&) = delete;

  void Open(const std::string& channel, const ChannelLimits& limits);
  /// The oldest message that waits; nothing after `timeout_ms` without one.
  std::optional<QueuedMessage> Next(int timeout_ms);
  BusTraffic Traffic() const;
  std::vector<RefusedDatagram> TakeRefused();

 private:
  void Run(std::stop_token stop);

  mutable std::mutex mutex_;  ///< guards all but the socket; held for one batch at most
  std::condition_variable arrived_;
  mutable BusInbox inbox_;
  std::uint64_t overrun_ = 0;
  UdpSocket socket_;
  std::jthread thread_;  // last: joined before the rest goes
};

}  // namespace palace
